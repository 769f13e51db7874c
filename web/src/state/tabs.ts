// Going from one technique to another. Each keeps what was edited; a picture of the visitor's own comes along.

import { batch } from '@preact/signals';
import { dropCorrections, dropDrawn } from './edits';
import { sampleNamed, useSample } from './pictures';
import { forgetOutcome, generate } from './runner';
import { entryOf } from '../techniques/index';
import { edits, entry, freshEdits, inputRole, picture, problems, technique, tool, type PictureInfo } from './store';

/** What each tab was left with. */
const left = new Map<string, { edits: typeof edits.value; picture: PictureInfo | null }>();

/** Without a run. */
export function switchTo(name: string): void {
  if (name === technique.value) return;
  left.set(technique.value, { edits: edits.value, picture: picture.value });
  batch(() => {
    technique.value = name;
    edits.value = left.get(name)?.edits ?? freshEdits(entryOf(name)?.panels && entryOf(name)?.samples[0]?.params);
    problems.value = {};
    tool.value = null;
    forgetOutcome();
  });
}

export async function openTab(name: string): Promise<void> {
  if (name === technique.value) return;
  switchTo(name);
  const before = left.get(name);
  if (!inputRole.value) return generate();
  if (picture.value && picture.value.sample === null) {
    if (before?.picture !== picture.value) {
      dropDrawn();
      dropCorrections();
    }
    return generate();
  }
  const sample = sampleNamed(before?.picture?.sample ?? null) ?? entry.value.samples[0];
  if (sample) await useSample(sample, before !== undefined);
}
