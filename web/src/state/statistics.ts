// Statistics of the pattern that is shown, beside its model's closed forms: taken once there is peace after a run, and
// given up for the next one.

import { computed, effect, signal } from '@preact/signals';
import type { Job, Measured } from 'tessera-wasm';
import { version } from 'tessera-wasm/description';
import { client } from './page';
import { entry, outcome, run } from './store';

const kPeace = 400; // ms; a slider may still be moved
const kLargeWindow = '(min-width: 1181px) and (min-height: 800px)';

export const unfolded = signal(matchMedia(kLargeWindow).matches);
/** Something else has the engine. */
export const engineTaken = signal(false);
export const statistics = signal<{ job: Job; measured: Measured } | null>(null);
/** Why there are none. */
export const statisticsProblem = signal('');

/** What is to be measured now, if anything. */
const wanted = computed(() => {
  if (!unfolded.value || !entry.value.measurable || run.value || engineTaken.value) return null;
  return outcome.value?.job ?? null;
});
export const upToDate = computed(() => statistics.value !== null && statistics.value.job === outcome.value?.job);

async function measure(job: Job): Promise<void> {
  const answer = await client.measure(entry.value.measurable?.(job.params) ?? 'svg');
  if (!answer || outcome.value?.job !== job) return;
  if ('report' in answer) {
    statistics.value = { job, measured: answer };
    return;
  }
  const told = answer.filter(({ code }) => code !== 'cancelled');
  statisticsProblem.value = told
    .map(({ message }) => `There is nothing to measure: the pattern ${message}.`)
    .join(' ');
}

export function bindStatistics(): void {
  let timer = 0;
  effect(() => {
    const { value: job } = wanted;
    clearTimeout(timer);
    if (!job || statistics.peek()?.job === job) return;
    statisticsProblem.value = '';
    timer = window.setTimeout(() => void measure(job), kPeace);
  });
}

/** As `tessera measure --report` writes them. */
export const reportText = ({ job, measured }: { job: Job; measured: Measured }): string =>
  `${JSON.stringify({ tessera: version, technique: 'measure', job, ...measured.report }, null, 1)}\n`;
