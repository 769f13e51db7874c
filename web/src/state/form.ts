// The form's fields, made from the job's JSON Schema alone.

import type { JobSchema, ParameterSchema, ParameterValue } from 'tessera-wasm';

interface FieldBase {
  key: string;
  title: string;
  help: string;
  /** "px", "°"; may be empty. */
  unit: string;
  /** The paper's symbol, in parts: "s_x" is s with x below. */
  symbol: { base: string; sub: string } | null;
  advanced: boolean;
}

export interface NumberField extends FieldBase {
  kind: 'number';
  whole: boolean;
  fallback: number;
  /** What the engine takes. */
  min: number;
  max: number;
  /** What the slider spans. */
  low: number;
  high: number;
  step: number;
}

export interface ChoiceField extends FieldBase {
  kind: 'choice';
  fallback: string;
  choices: { value: string; help: string }[];
}

export interface ToggleField extends FieldBase {
  kind: 'toggle';
  fallback: boolean;
}

export interface TextField extends FieldBase {
  kind: 'text';
  fallback: string;
}

export type Field = NumberField | ChoiceField | ToggleField | TextField;

/** Parameters that differ from their defaults. */
export type Params = Readonly<Record<string, ParameterValue>>;

/** `without`: choices that are not offered, by parameter. */
export function fieldsOf(
  schema: JobSchema,
  technique: string,
  without: Readonly<Record<string, readonly string[]>> = {},
): Field[] {
  const properties = schema.$defs[technique]?.properties ?? {};
  return Object.entries(properties).map(([key, property]) => {
    const field = fieldOf(key, property);
    if (field.kind !== 'choice') return field;
    return { ...field, choices: field.choices.filter(({ value }) => !without[key]?.includes(value)) };
  });
}

function fieldOf(key: string, property: ParameterSchema): Field {
  const [base = '', sub = ''] = greek(property['x-symbol'] ?? '').split('_');
  const unit = property['x-unit'] ?? '';
  const common: FieldBase = {
    key,
    title: property.title,
    help: property.description,
    unit: unit === 'deg' ? '°' : unit,
    symbol: base ? { base, sub } : null,
    advanced: property['x-advanced'] ?? false,
  };
  if (property.enum) {
    const choices = property.enum.map((value, i) => ({ value, help: property['x-enum-descriptions']?.[i] ?? '' }));
    return { ...common, kind: 'choice', fallback: String(property.default), choices };
  }
  if (property.type === 'boolean') return { ...common, kind: 'toggle', fallback: property.default === true };
  if (property.type === 'string') return { ...common, kind: 'text', fallback: String(property.default) };
  return { ...common, kind: 'number', ...rangeOf(property) };
}

const kGreek: Readonly<Record<string, string>> = {
  alpha: 'α',
  beta: 'β',
  delta: 'δ',
  lambda: 'λ',
  mu: 'μ',
  Sigma: 'Σ',
  '^2': '²',
};

const greek = (symbol: string) =>
  symbol.replace(/alpha|beta|delta|lambda|mu|Sigma|\^2/g, (word) => kGreek[word] ?? word);

function rangeOf(property: ParameterSchema) {
  const whole = property.type === 'integer';
  const min = property.minimum ?? -Infinity;
  const max = property.maximum ?? Infinity;
  const fallback = Number(property.default);
  const low = property['x-ui-minimum'] ?? (Number.isFinite(min) ? min : Math.min(0, fallback));
  const high = property['x-ui-maximum'] ?? (Number.isFinite(max) ? max : Math.max(low + 1, 4 * fallback));
  return { whole, fallback, min, max, low, high, step: stepOf(high - low, whole) };
}

/** A round step of which the slider has between a hundred and a thousand, or whole numbers. */
export function stepOf(span: number, whole: boolean): number {
  const step = 10 ** Math.floor(Math.log10(span / 100));
  return whole ? Math.max(1, step) : Number(step.toPrecision(1));
}

export const valueOf = (field: Field, params: Params): ParameterValue => params[field.key] ?? field.fallback;

/** `params` with one of them changed; a default is left out. */
export function withValue(params: Params, field: Field, value: ParameterValue): Params {
  const { [field.key]: _, ...others } = params;
  return value === field.fallback ? others : { ...others, [field.key]: value };
}

/** A parameter's value from text, or undefined where it is none. The engine checks ranges. */
export function parseValue(field: Field, text: string): ParameterValue | undefined {
  switch (field.kind) {
    case 'number': {
      const value = Number(text);
      return text.trim() === '' || !Number.isFinite(value) ? undefined : value;
    }
    case 'toggle':
      return text === 'true' ? true : text === 'false' ? false : undefined;
    default:
      return text;
  }
}

/** Only what differs from the defaults, of parameters that the technique has. */
export function differing(fields: readonly Field[], params: Params): Params {
  let result: Params = {};
  for (const field of fields) {
    const value = params[field.key];
    if (value !== undefined) result = withValue(result, field, value);
  }
  return result;
}

export function sameParams(a: Params, b: Params): boolean {
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => a[key] === b[key]);
}
