// A label picture that was made elsewhere, in place of the search for pebbles.

import { kLabels } from '../worker/protocol';
import { changeValues, endStep } from './edits';
import { runSoon } from './runner';
import { sendPicture } from './sent';
import { alertWith, byLabels, entry, fields, known, kByLabels, kSegmenter, labels } from './store';

export const takesLabels = () =>
  (known.value?.inputs.some(({ name }) => name === kLabels) ?? false) &&
  fields.value.some(({ key }) => key === kSegmenter);

/** The run follows; an alert says where it cannot be used, and everything stays as it was. */
export async function useLabels(file: File): Promise<void> {
  const { name: technique } = entry.value;
  try {
    await sendPicture(kLabels, file.name, file);
  } catch (error) {
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  if (technique !== entry.value.name) return;
  labels.value = { name: file.name, blob: file };
  if (byLabels.value) return runSoon(); // another one
  changeValues({ [kSegmenter]: kByLabels });
  endStep();
}

/** Back to the search. The picture is kept for undo. */
export function leaveLabels(): void {
  const fallback = fields.value.find(({ key }) => key === kSegmenter)?.fallback;
  if (fallback !== undefined) changeValues({ [kSegmenter]: fallback });
  endStep();
}
