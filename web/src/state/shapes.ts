// A file that says what the pieces of a parquetry are: a label picture, or an SVG of closed shapes.

import { kLabels } from '../worker/protocol';
import { changeShapes } from './edits';
import { sendPicture } from './sent';
import { alertWith, entry, known, params, picture } from './store';

const kOff = 0.01; // as the engine is about proportions
const kPosterize = 'posterize'; // another way to make pieces, which cannot go with it

export const takesShapes = () =>
  entry.value.panels !== undefined && (known.value?.inputs.some(({ name }) => name === kLabels) ?? false);

/** The run follows; an alert says where it cannot be used, and everything stays as it was. */
export async function useShapes(file: File): Promise<void> {
  const { name: technique } = entry.value;
  const { value: target } = picture;
  try {
    const { width, height } = await sendPicture(kLabels, file.name, file);
    if (technique !== entry.value.name || target !== picture.value) return;
    if (target && Math.abs((width * target.height) / (height * target.width) - 1) > kOff)
      throw new Error(
        `“${file.name}” is ${width} × ${height}, expected the proportions of the target, ${target.width} × ` +
          `${target.height}. Make it as wide and as high, or choose another file.`,
      );
  } catch (error) {
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  const { [kPosterize]: _, ...others } = params.value;
  changeShapes({ name: file.name, blob: file }, others);
}

export const leaveShapes = () => changeShapes(null, params.value);
