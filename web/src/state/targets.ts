// More pictures that are made of the same wood, and how they lie on the stage: side by side, as the engine's sheet has them.

import { computed, signal } from '@preact/signals';
import type { Size } from '../stage/view';
import { targetRole, type PictureFile } from './drawn';
import { changeDrawn, endStep } from './edits';
import { sendPicture } from './sent';
import { alertWith, currentParams, drawn, entry, picture } from './store';

const sizes = signal<ReadonlyMap<Blob, Size>>(new Map());

export const targets = () => drawn.value.targets;

export async function addTargets(files: readonly File[]): Promise<void> {
  const added: PictureFile[] = [];
  const refused: string[] = [];
  const first = targets().length;
  for (const file of files) {
    try {
      const { width, height } = await sendPicture(targetRole(first + added.length), file.name, file);
      sizes.value = new Map(sizes.value).set(file, { width, height });
      added.push({ name: file.name, blob: file });
    } catch (error) {
      refused.push(error instanceof Error ? error.message : String(error));
    }
  }
  if (added.length) changeDrawn({ targets: [...targets(), ...added] });
  endStep();
  if (refused.length) alertWith(...refused);
}

export function removeTarget(target: PictureFile): void {
  changeDrawn({ targets: targets().filter((one) => one !== target) });
  endStep();
}

/** All targets, each copy after the other; all as long along their shorter sides as the first is. */
export function sideBySide(all: readonly Size[], copies: number): Size {
  const [first = { width: 1, height: 1 }] = all;
  const side = Math.min(first.width, first.height);
  const scaled = all.map(({ width, height }) => {
    const scale = side / Math.min(width, height);
    return { width: width * scale, height: height * scale };
  });
  const width = copies * scaled.reduce((sum, one) => sum + one.width, 0);
  return { width, height: Math.max(...scaled.map(({ height }) => height)) };
}

/** What there is to see of a picture on the stage, px of it: more than itself where several are made. */
export const extent = computed<Size | null>(() => {
  const { value: first } = picture;
  if (!first || !entry.value.panels) return first;
  const others = targets().flatMap(({ blob }) => sizes.value.get(blob) ?? []);
  const copies = Math.max(1, Number(currentParams()['copies']) || 1);
  return others.length || copies > 1 ? sideBySide([first, ...others], copies) : first;
});
