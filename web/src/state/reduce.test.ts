import type { Job, JobSchema } from 'tessera-wasm';
import { expect, test } from 'vitest';
import { reducedJob, reductionFor } from './reduce';

const length = { title: '', description: '', type: 'number' as const, 'x-unit': 'px' };
const schema: JobSchema = {
  $defs: {
    paving: {
      title: '',
      description: '',
      properties: {
        size: { ...length, default: 4, minimum: 1, maximum: 512 },
        gap: { ...length, default: 0.5, minimum: 0 },
        colors: { title: '', description: '', type: 'integer', default: 2 },
      },
    },
  },
};
const job: Job = { schemaVersion: 1, technique: 'paving', seed: 1, params: { gap: 1, colors: 3 }, inputs: {} };

test('small pictures are not reduced', () => expect(reductionFor(1024, 1024)).toBe(1));

test('large ones come down to the same size', () => {
  const scale = reductionFor(6000, 4000);
  expect(6000 * scale * 4000 * scale).toBeCloseTo(500_000);
});

test('lengths in pixels shrink with the picture, within their range', () => {
  expect(reducedJob(job, schema, 0.5).params).toEqual({ size: 2, gap: 0.5, colors: 3 });
  expect(reducedJob(job, schema, 0.1).params).toEqual({ size: 1, gap: 0.1, colors: 3 });
});
