// Opening a job, from JSON or from an SVG that Tessera made.

import { entryOf } from '../techniques/index';
import { targetRole } from './drawn';
import { changeParams, dropDrawn } from './edits';
import { differing } from './form';
import { takesLabels } from './labels';
import { client } from './page';
import { panels } from './panels';
import { sampleNamed, useSample } from './pictures';
import { generate } from './runner';
import { kEdgeMask, kLabels, kMask, kPanel, maskFileOf } from '../worker/protocol';
import { alerts, alertWith, drawn, entry, fields, inputRole, kSegmenter, labels, picture } from './store';
import { switchTo } from './tabs';

export async function openJob(file: File): Promise<void> {
  const answer = await client.readJob(await file.text());
  if (!('technique' in answer)) {
    const why = answer.map((p) => [p.field, p.message].filter(Boolean).join(' ')).join('; ');
    const hint = 'Choose a job saved here or by the command line, or an SVG that Tessera made.';
    return alertWith(`“${file.name}” is not a job that can be opened: ${why}. ${hint}`);
  }
  if (!entryOf(answer.technique))
    return alertWith(`“${file.name}” is a job of ${answer.technique}, which is not there yet.`);
  switchTo(answer.technique);
  const { [inputRole.value]: path, ...besides } = answer.inputs;
  const { labelPath, others } = takesLabels() ? withoutLabels(besides) : { labelPath: undefined, others: besides };
  const labelsLost = labelPath !== undefined && nameOf(labelPath) !== labels.value?.name;
  const { [kSegmenter]: segmenter, ...params } = differing(fields.value, answer.params);
  changeParams(segmenter === undefined || labelsLost ? params : { ...params, [kSegmenter]: segmenter }, answer.seed);
  const { drawnOnes, wood } = apart(others);
  if (!sameDrawn(drawnOnes)) dropDrawn();
  await findPicture(path);
  const elsewhere = wood.filter((name) => !haveWood(name)).map((name) => `“${name}”`);
  if (elsewhere.length)
    alertWith(
      ...alerts.value,
      `The job is cut from ${elsewhere.join(' and ')}, which a page cannot open by itself: it runs on the wood that is ` +
        'here. Choose those files as the panels, under the same names.',
    );
  if (labelsLost)
    alertWith(
      ...alerts.value,
      `The job was made with the label picture “${nameOf(labelPath)}”, which a page cannot open by itself: it searches ` +
        'for the pebbles. Choose that file as the segmentation.',
    );
  const lost = sameDrawn(drawnOnes) ? [] : Object.values(drawnOnes).map((other) => `“${nameOf(other)}”`);
  if (lost.length)
    alertWith(
      ...alerts.value,
      `The job was made with ${lost.join(' and ')}, which a page cannot open by itself: it runs without. Draw again what ` +
        'was there, or run the job with the command line.',
    );
}

function withoutLabels({ [kLabels]: labelPath, ...others }: Readonly<Record<string, string>>) {
  return { labelPath, others };
}

/** Panels and their masks are no drawings. */
function apart(inputs: Readonly<Record<string, string>>) {
  const isWood = (role: string) => role.startsWith(kPanel) || role.startsWith(kMask);
  const all = Object.entries(inputs);
  return {
    drawnOnes: Object.fromEntries(all.filter(([role]) => !isWood(role))),
    wood: all.flatMap(([role, path]) => (isWood(role) ? [nameOf(path) ?? ''] : [])),
  };
}

const haveWood = (file: string) =>
  panels().some(
    ({ name, mask, strokes, ...panel }) =>
      panel.file === file || mask?.file === file || (strokes.length > 0 && maskFileOf(name) === file),
  ) ||
  (drawn.value.panels === null && entry.value.panels?.some((panel) => panel.file === file));

/** Whether the job was made with what is drawn here now. */
function sameDrawn(inputs: Readonly<Record<string, string>>): boolean {
  const { edges, regions, density, [kEdgeMask]: mask, [kLabels]: labelPath, ...others } = inputs;
  const { guides, regions: strokes, density: file, edgeMask, shapes, targets } = drawn.value;
  return (
    Object.keys(others).length === targets.length &&
    targets.every(({ name }, i) => nameOf(others[targetRole(i)]) === name) &&
    Boolean(edges) === guides.length > 0 &&
    Boolean(regions) === strokes.length > 0 &&
    Boolean(mask) === edgeMask.length > 0 &&
    nameOf(labelPath) === shapes?.name &&
    nameOf(density) === file?.name
  );
}

const nameOf = (path: string | undefined) => path?.split(/[\\/]/).at(-1);

/** A page cannot open a path; but it may have the picture already, or among its samples. */
async function findPicture(path: string | undefined): Promise<void> {
  const name = nameOf(path);
  if (!name || name === picture.value?.name) return generate();
  const sample = sampleNamed(name);
  if (sample) return useSample(sample, true);
  const [first] = entry.value.samples;
  if (picture.value || !first) generate();
  else await useSample(first, true);
  alertWith(
    `The job was made from “${name}”, which a page cannot open by itself: it runs on “${picture.value?.name ?? ''}” ` +
      'for now. Choose that file as the picture.',
  );
}
