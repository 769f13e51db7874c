import { changeValue, endStep } from '../state/edits';
import { valueOf } from '../state/form';
import { entry, fields, params } from '../state/store';

/** What people call a value of the pictured choice. */
export const worded = (value: string) =>
  entry.value.titles?.[value] ?? value.charAt(0).toUpperCase() + value.slice(1).replace('-', ' ');

/** A choice by its pictures; other parameters stay as they are. */
export function ModelChoice() {
  const field = fields.value.find(({ key }) => key === entry.value.pictured);
  if (field?.kind !== 'choice') return null;
  const chosen = valueOf(field, params.value);
  return (
    <section class="group" aria-labelledby="models-title">
      <h2 id="models-title">{field.title}</h2>
      <div class="presets" role="group" aria-labelledby="models-title">
        {field.choices.map(({ value, help }) => (
          <button
            type="button"
            key={value}
            class="preset"
            title={help}
            aria-pressed={value === chosen}
            onClick={() => {
              changeValue(field, value);
              endStep();
            }}
          >
            <img src={`models/${value}.png`} alt="" width={76} height={57} decoding="async" draggable={false} />
            {worded(value)}
          </button>
        ))}
      </div>
    </section>
  );
}
