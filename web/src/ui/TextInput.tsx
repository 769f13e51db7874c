import { changeValue, endStep } from '../state/edits';
import type { TextField } from '../state/form';

/** Attributes that tie a control to its label, help and problem. */
export interface Ties {
  'aria-describedby': string;
  'aria-invalid': boolean;
}

export const TextInput = ({ field, value, ties }: { field: TextField; value: string; ties: Ties }) => (
  <input
    id={`field-${field.key}`}
    type="text"
    value={value}
    onInput={(event) => changeValue(field, event.currentTarget.value)}
    onChange={endStep}
    {...ties}
  />
);
