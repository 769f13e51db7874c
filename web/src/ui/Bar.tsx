import { Download } from 'lucide-preact';
import { entry, engine, known, notice, outcome, run, type Outcome, type Run } from '../state/store';
import { timeLeft } from './time-left';

const kFormats = ['svg', 'dxf', 'png', 'glb', 'zip'];
const kStages: Record<string, string> = { picture: 'Opening the picture' };
const seconds = new Intl.NumberFormat('en', { maximumFractionDigits: 1 });

/** Below the stage: how far the run is, what came of it, and its files. */
export function Bar() {
  const { value: running } = run;
  const { value: done } = outcome;
  const percent = running ? Math.round(running.fraction * 100) : done ? 100 : 0;
  return (
    <div class="bar" data-busy={running !== null}>
      <div
        class="progress"
        role="progressbar"
        aria-label="Progress"
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={percent}
      >
        <div style={{ width: `${percent}%` }} />
      </div>
      <p class="bar-text">{running ? <Going run={running} /> : done ? <Done outcome={done} /> : <Waiting />}</p>
      <p class="unseen" role="status">
        {!running && (notice.value || (done && entry.value.facts(done.result).join(', ')))}
      </p>
      <Downloads />
    </div>
  );
}

function Going({ run: { stage, iteration, fraction, since, reduced } }: { run: Run }) {
  const word = entry.value.stages[stage] ?? kStages[stage] ?? (engine.value ? 'Starting' : 'Loading the engine');
  const left = timeLeft(fraction, performance.now() - since);
  return (
    <>
      <strong>{reduced ? `Quick look: ${word.toLowerCase()}` : word}</strong>
      {iteration && stage === 'diagram' && iteration.last > 0 && (
        <span>
          {iteration.index} of {iteration.last}
        </span>
      )}
      {left && <span>{left}</span>}
    </>
  );
}

function Done({ outcome: { result, milliseconds } }: { outcome: Outcome }) {
  const [first, ...others] = entry.value.facts(result);
  return (
    <>
      {notice.value && <span class="notice">{notice.value}</span>}
      <strong>{first}</strong>
      {others.map((fact) => (
        <span key={fact}>{fact}</span>
      ))}
      <span class="bar-time">{seconds.format(milliseconds / 1000)} s</span>
    </>
  );
}

const Waiting = () => <span>{notice.value || 'Ready'}</span>;

function Downloads() {
  const formats = [...kFormats.filter((format) => known.value?.formats.includes(format)), 'job'];
  const files = run.value ? {} : (outcome.value?.files ?? {});
  return (
    <div class="downloads">
      {formats.map((format) => {
        const word = format === 'job' ? format : format.toUpperCase();
        const file = files[format];
        return file ? (
          <a key={format} class="download" href={file.address} download={file.name} aria-label={`Download ${word}`}>
            <Download size={15} aria-hidden />
            {word}
          </a>
        ) : (
          <span key={format} class="download pending" aria-hidden="true">
            <Download size={15} aria-hidden />
            {word}
          </span>
        );
      })}
    </div>
  );
}
