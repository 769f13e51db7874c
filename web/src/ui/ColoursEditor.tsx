import { Plus, X } from 'lucide-preact';
import { changeValue, changeValues, endStep } from '../state/edits';
import {
  coloursText,
  kMostColours,
  partsOf,
  readColours,
  sharesText,
  withColour,
  withNewColour,
  withoutColour,
  type ColourList,
} from '../state/colours';
import type { TextField } from '../state/form';
import { entry, params } from '../state/store';
import { percent } from '../techniques/facts';
import { TextInput, type Ties } from './TextInput';

interface Props {
  field: TextField;
  value: string;
  ties: Ties;
}

const kShares = 'probabilities';

/** A text that is a list of colours: a patch of each, and the text itself for those who have one to paste. */
export function ColoursEditor({ field, value, ties }: Props) {
  const list = readColours(value, String(params.value[kShares] ?? ''));
  return (
    <>
      {list && <Patches list={list} field={field} />}
      <TextInput field={field} value={value} ties={ties} />
    </>
  );
}

function Patches({ list, field }: { list: ColourList; field: TextField }) {
  const names = entry.value.colourNames?.(params.value);
  const shown = names ? list.colours.slice(0, names.length) : list.colours;
  const parts = partsOf(list);
  const nameOf = (i: number) => names?.[i] ?? `Colour ${i + 1}`;
  const change = (next: ColourList) => {
    changeValues({ [field.key]: coloursText(next), [kShares]: sharesText(next) });
    endStep();
  };
  return (
    <ul class="patches" aria-label={field.title}>
      {shown.map((colour, i) => (
        <li key={i} title={`${nameOf(i)}: ${colour}${names ? '' : `, ${percent.format(parts[i]!)} of all`}`}>
          <Patch
            label={nameOf(i)}
            colour={colour}
            change={(next) => changeValue(field, coloursText(withColour(list, i, next)))}
          />
          {!names && list.colours.length > 1 && (
            <button
              type="button"
              class="patch-remove"
              aria-label={`Remove ${nameOf(i).toLowerCase()}`}
              onClick={() => change(withoutColour(list, i))}
            >
              <X size={12} aria-hidden />
            </button>
          )}
        </li>
      ))}
      {list.colours.length < (names?.length ?? kMostColours) && (
        <li>
          <button
            type="button"
            class="patch-add"
            aria-label="Add a colour"
            title="Add a colour"
            onClick={() => change(withNewColour(list, list.colours.at(-1)!))}
          >
            <Plus size={16} aria-hidden />
          </button>
        </li>
      )}
    </ul>
  );
}

interface PatchProps {
  label: string;
  colour: string;
  change(colour: string): void;
}

const Patch = ({ label, colour, change }: PatchProps) => (
  <input
    type="color"
    aria-label={label}
    value={colour}
    onInput={(event) => change(event.currentTarget.value)}
    onChange={endStep}
  />
);

/** A text that is one colour. */
export function ColourEditor({ field, value, ties }: Props) {
  const [colour] = readColours(value, '')?.colours ?? [];
  return (
    <div class="patches single">
      {colour && <Patch label={field.title} colour={colour} change={(next) => changeValue(field, next)} />}
      <TextInput field={field} value={value} ties={ties} />
    </div>
  );
}
