import { useSignal } from '@preact/signals';
import { CircleHelp } from 'lucide-preact';
import type { ComponentChildren } from 'preact';
import type { ParameterValue } from 'tessera-wasm';
import { changeValue, endStep } from '../state/edits';
import { valueOf, type ChoiceField, type Field as FieldModel, type NumberField, type TextField } from '../state/form';
import { params, problems } from '../state/store';
import { ColourEditor, ColoursEditor } from './ColoursEditor';
import { PaletteEditor } from './PaletteEditor';
import { TextInput, type Ties } from './TextInput';

interface ControlProps<F extends FieldModel> {
  field: F;
  value: ParameterValue;
  ties: Ties;
}

export function Field({ field }: { field: FieldModel }) {
  const id = `field-${field.key}`;
  const value = valueOf(field, params.value);
  const problem = problems.value[field.key];
  const ties = {
    'aria-describedby': problem ? `${id}-problem ${id}-help` : `${id}-help`,
    'aria-invalid': problem !== undefined,
  };
  return (
    <div class="field" data-kind={field.kind}>
      <div class="field-head">
        <label id={`${id}-label`} for={id}>
          {field.title}
          {field.symbol && <Symbol {...field.symbol} />}
        </label>
        {value !== field.fallback && <ResetDot field={field} />}
        <Help id={`${id}-help`} title={field.title}>
          {field.help}.
          {field.kind === 'choice' &&
            field.choices.map((c) => c.help && <span key={c.value}>{`${c.value}: ${c.help}`}</span>)}
        </Help>
      </div>
      {field.kind === 'number' && <NumberControl field={field} value={value} ties={ties} />}
      {field.kind === 'choice' && <ChoiceControl field={field} value={value} ties={ties} />}
      {field.kind === 'toggle' && (
        <input
          id={id}
          type="checkbox"
          role="switch"
          checked={value === true}
          onChange={(event) => changeValue(field, event.currentTarget.checked)}
          {...ties}
        />
      )}
      {field.kind === 'text' && <TextControl field={field} value={value} ties={ties} />}
      {problem && (
        <p id={`${id}-problem`} class="field-problem">
          {problem}
        </p>
      )}
    </div>
  );
}

function Symbol({ base, sub }: { base: string; sub: string }) {
  return (
    <i class="symbol">
      {base}
      {sub && <sub>{sub}</sub>}
    </i>
  );
}

function ResetDot({ field }: { field: FieldModel }) {
  return (
    <button
      type="button"
      class="reset"
      aria-label={`Reset ${field.title.toLowerCase()}`}
      title={`Back to ${String(field.fallback)}`}
      onClick={() => {
        changeValue(field, field.fallback);
        endStep();
      }}
    />
  );
}

/** A bubble on hover and focus; a press keeps it open, for those who can do neither. */
export function Help({ id, title, children }: { id: string; title: string; children: ComponentChildren }) {
  const open = useSignal(false);
  return (
    <>
      <button
        type="button"
        class="help-button"
        aria-label={`About ${title.toLowerCase()}`}
        aria-expanded={open.value}
        aria-controls={id}
        onClick={() => (open.value = !open.value)}
        onBlur={() => (open.value = false)}
        onKeyDown={(event) => event.key === 'Escape' && (open.value = false)}
      >
        <CircleHelp size={15} aria-hidden />
      </button>
      <p id={id} class="help">
        {children}
      </p>
    </>
  );
}

function NumberControl({ field, value, ties }: ControlProps<NumberField>) {
  const id = `field-${field.key}`;
  const change = (text: string) => {
    const typed = Number(text);
    if (text.trim() !== '' && Number.isFinite(typed)) changeValue(field, typed);
  };
  const filled = Math.min(1, Math.max(0, (Number(value) - field.low) / (field.high - field.low)));
  return (
    <div class="number">
      <input
        type="range"
        min={field.low}
        max={field.high}
        step={field.step}
        value={Number(value)}
        style={{ '--filled': `${filled * 100}%` }}
        aria-labelledby={`${id}-label`}
        onInput={(event) => change(event.currentTarget.value)}
        onChange={endStep}
        {...ties}
      />
      <span class="number-box">
        <input
          id={id}
          type="number"
          inputMode="decimal"
          min={Number.isFinite(field.min) ? field.min : undefined}
          max={Number.isFinite(field.max) ? field.max : undefined}
          step={field.whole ? 1 : field.step}
          value={Number(value)}
          onInput={(event) => change(event.currentTarget.value)}
          onChange={endStep}
          {...ties}
        />
        {field.unit && <span class="unit">{field.unit}</span>}
      </span>
    </div>
  );
}

const kColour = /^#[0-9a-f]{6}$/i;

function TextControl({ field, value, ties }: ControlProps<TextField>) {
  if (field.key === 'palette') return <PaletteEditor field={field} value={value} ties={ties} />;
  const text = String(value);
  if (field.key === 'colors') return <ColoursEditor field={field} value={text} ties={ties} />;
  if (kColour.test(field.fallback)) return <ColourEditor field={field} value={text} ties={ties} />;
  return <TextInput field={field} value={text} ties={ties} />;
}

function ChoiceControl({ field, value, ties }: ControlProps<ChoiceField>) {
  const id = `field-${field.key}`;
  return (
    <select
      id={id}
      value={String(value)}
      onChange={(event) => changeValue(field, event.currentTarget.value)}
      {...ties}
    >
      {field.choices.map((choice) => (
        <option key={choice.value} value={choice.value} title={choice.help}>
          {choice.value}
        </option>
      ))}
    </select>
  );
}
