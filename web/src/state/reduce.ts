// A job on a smaller copy of its picture, to answer at once while the whole takes its time.

import type { Job, JobSchema } from 'tessera-wasm';

const kLargePixels = 2_500_000;
const kReducedPixels = 500_000;

/** The side of the smaller copy as a part of the picture's, or 1 where the picture is small enough as it is. */
export function reductionFor(width: number, height: number): number {
  const pixels = width * height;
  return pixels > kLargePixels ? Math.sqrt(kReducedPixels / pixels) : 1;
}

/** The job with every length in pixels scaled, as far as the parameter may go. */
export function reducedJob(job: Job, schema: JobSchema, scale: number): Job {
  const params = { ...job.params };
  for (const [key, property] of Object.entries(schema.$defs[job.technique]?.properties ?? {})) {
    if (property['x-unit'] !== 'px') continue;
    const length = Number(params[key] ?? property.default) * scale;
    params[key] = Math.min(property.maximum ?? Infinity, Math.max(property.minimum ?? 0, length));
  }
  return { ...job, params };
}
