// What the native program makes of a job that the page gave away.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { root } from './root.mjs';

const tessera = join(root, 'build/native-release/bin/tessera');

/** What it writes to standard output. */
export const nativeOutput = (...words) => execFileSync(tessera, words, { maxBuffer: Infinity });
export const native = (...words) => nativeOutput(...words, '--backend', 'cpu', '--quiet');

export async function inFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
  try {
    return await use(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** What the native program makes of a job. `pictures`: the bytes for each role; they are put where the job says. */
export function nativeFile(folder, job, pictures, ending) {
  const { inputs } = JSON.parse(job);
  for (const [role, name] of Object.entries(inputs)) writeFileSync(join(folder, name), pictures[role]);
  writeFileSync(join(folder, 'job.json'), job);
  const output = join(folder, `native.${ending}`);
  native('run', join(folder, 'job.json'), '-o', output);
  return readFileSync(output);
}

export const nativeSvg = (folder, job, pictures) => nativeFile(folder, job, pictures, 'svg').toString('utf8');
