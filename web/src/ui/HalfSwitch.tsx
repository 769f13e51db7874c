import { half } from '../state/pebbles';
import { entry } from '../state/store';

const kSolid = [
  ['photo', 'Photo'],
  ['field', '3D'],
  ['sizes', 'Sizes'],
] as const;
const kWood = [
  ['photo', 'Picture'],
  ['field', 'Wood'],
] as const;

/** In narrow windows, which have room for one of them only. */
export const HalfSwitch = () => (
  <div class="half-switch tool-group" role="group" aria-label="What is shown">
    {(entry.value.panels ? kWood : kSolid).map(([name, title]) => (
      <button
        type="button"
        key={name}
        class="chip"
        aria-pressed={half.value === name}
        onClick={() => (half.value = name)}
      >
        {title}
      </button>
    ))}
  </div>
);
