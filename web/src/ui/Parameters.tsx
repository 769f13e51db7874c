import { Dices } from 'lucide-preact';
import { changeSeed, choosePreset, endStep } from '../state/edits';
import { sameParams, type Field as FieldModel } from '../state/form';
import { seedOf } from '../state/hash';
import { backend, entry, fields, graphics, params, problems, seed } from '../state/store';
import { generate } from '../state/runner';
import type { Backend } from '../worker/protocol';
import { Field, Help } from './Field';

export function Presets() {
  if (entry.value.presets.length === 0) return null;
  return (
    <section class="group" aria-labelledby="presets-title">
      <h2 id="presets-title">Presets</h2>
      <div class="presets">
        {entry.value.presets.map((preset) => (
          <button
            type="button"
            key={preset.title}
            class="preset"
            title={preset.hint}
            aria-pressed={sameParams(preset.params, params.value)}
            onClick={() => choosePreset(preset.params)}
          >
            <img src={preset.picture} alt="" width={76} height={56} decoding="async" draggable={false} />
            {preset.title}
          </button>
        ))}
      </div>
    </section>
  );
}

export function Parameters() {
  const { front, pictured, matters } = entry.value;
  const isShown = ({ key }: FieldModel) =>
    key !== pictured && (!matters || matters(key, params.value) || key in problems.value);
  const isSimple = ({ key, advanced }: FieldModel) => (front ? front.includes(key) : !advanced);
  const shown = fields.value.filter(isShown);
  const simple = shown.filter(isSimple);
  const advanced = shown.filter((field) => !isSimple(field));
  return (
    <section class="group" aria-labelledby="parameters-title">
      <h2 id="parameters-title">Parameters</h2>
      {simple.map((field) => (
        <Field key={field.key} field={field} />
      ))}
      <SeedField />
      <details class="more">
        <summary>More parameters</summary>
        {advanced.map((field) => (
          <Field key={field.key} field={field} />
        ))}
        <BackendField />
      </details>
    </section>
  );
}

function SeedField() {
  return (
    <div class="field">
      <div class="field-head">
        <label for="seed">Seed</label>
        {seed.value !== 1 && (
          <button
            type="button"
            class="reset"
            aria-label="Reset seed"
            title="Back to 1"
            onClick={() => changeSeed(1)}
          />
        )}
        <Help id="seed-help" title="seed">
          Start of the random numbers. The same seed lays the same {entry.value.pieces}.
        </Help>
      </div>
      <div class="seed">
        <input
          id="seed"
          type="number"
          inputMode="numeric"
          min={0}
          max={Number.MAX_SAFE_INTEGER}
          step={1}
          value={seed.value}
          aria-describedby="seed-help"
          onInput={(event) => {
            const typed = seedOf(event.currentTarget.value);
            if (typed !== null) changeSeed(typed);
          }}
          onChange={endStep}
        />
        <button
          type="button"
          class="button"
          title="Another seed"
          aria-label="Roll the dice for another seed"
          onClick={() => {
            changeSeed(1 + Math.floor(Math.random() * 999_999));
            endStep();
          }}
        >
          <Dices size={18} aria-hidden />
        </button>
      </div>
    </div>
  );
}

const kBackends: Record<Backend, string> = { auto: 'Automatic', cpu: 'Processor', gl: 'Graphics card' };

function BackendField() {
  const { value: gl } = graphics;
  return (
    <div class="field">
      <div class="field-head">
        <label for="backend">Drawn by</label>
        <Help id="backend-help" title="drawn by">
          What draws the diagram. Automatic takes a graphics card where there is one.
          {gl && <span>{`Here: ${gl.renderer}`}</span>}
        </Help>
      </div>
      <select
        id="backend"
        value={backend.value}
        aria-describedby="backend-help"
        onChange={(event) => {
          backend.value = event.currentTarget.value as Backend;
          generate();
        }}
      >
        {Object.entries(kBackends).map(([value, title]) => (
          <option key={value} value={value} disabled={value === 'gl' && gl?.works === false}>
            {title}
          </option>
        ))}
      </select>
    </div>
  );
}
