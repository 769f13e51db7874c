// Opening a job, from JSON or from an SVG that Tessera made.

import { batch } from '@preact/signals';
import { entryOf } from '../techniques/index';
import { changeParams } from './edits';
import { differing } from './form';
import { client } from './page';
import { sampleNamed, useSample } from './pictures';
import { generate } from './runner';
import { alertWith, fields, inputRole, picture, technique } from './store';

export async function openJob(file: File): Promise<void> {
  const answer = await client.readJob(await file.text());
  if (!('technique' in answer)) {
    const why = answer.map((p) => [p.field, p.message].filter(Boolean).join(' ')).join('; ');
    const hint = 'Choose a job saved here or by the command line, or an SVG that Tessera made.';
    return alertWith(`“${file.name}” is not a job that can be opened: ${why}. ${hint}`);
  }
  if (!entryOf(answer.technique))
    return alertWith(`“${file.name}” is a job of ${answer.technique}, which is not there yet.`);
  batch(() => {
    technique.value = answer.technique;
    changeParams(differing(fields.value, answer.params), answer.seed);
  });
  await findPicture(answer.inputs[inputRole.value]);
}

/** A page cannot open a path; but it may have the picture already, or among its samples. */
async function findPicture(path: string | undefined): Promise<void> {
  const name = path?.split(/[\\/]/).at(-1);
  const sample = name ? sampleNamed(name) : undefined;
  if (!name || name === picture.value?.name) return generate();
  if (sample) return useSample(sample, true);
  generate();
  alertWith(
    `The job was made from “${name}”, which a page cannot open by itself: it runs on “${picture.value?.name ?? ''}” ` +
      'for now. Choose that file as the picture.',
  );
}
