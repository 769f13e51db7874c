import { useSignal } from '@preact/signals';
import { ChevronDown, Download } from 'lucide-preact';
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { fileKinds, type FileKind } from '../state/files';
import { demandFile } from '../state/runner';
import { entry, engine, known, notice, outcome, run, type FileLink, type Outcome, type Run } from '../state/store';
import { timeLeft } from './time-left';

/** Made at once, however many pieces there are. */
const kAtOnce = new Set(['png', 'job']);
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
      <span class="bar-time">{duration(milliseconds)}</span>
    </>
  );
}

const duration = (milliseconds: number) =>
  milliseconds < 95 ? `${Math.max(1, Math.round(milliseconds))} ms` : `${seconds.format(milliseconds / 1000)} s`;

const Waiting = () => <span>{notice.value || 'Ready'}</span>;

function Downloads() {
  const made = new Set([...(known.value?.formats ?? []), 'job', ...Object.keys(files())]);
  const offered = fileKinds.value.filter(({ format }) => made.has(format));
  return (
    <div class="downloads">
      {offered.map((kind) => kind.more || <Offered key={kind.format} kind={kind} />)}
      <More>{offered.map((kind) => kind.more && <Offered key={kind.format} kind={kind} />)}</More>
    </div>
  );
}

const files = () => (run.value ? {} : (outcome.value?.files ?? {}));

function Offered({ kind }: { kind: FileKind }) {
  const done = run.value ? null : outcome.value;
  const asked = kind.onDemand || (done?.onDemand && !kAtOnce.has(kind.format));
  return asked && done && !done.reduced ? <DownloadButton kind={kind} /> : <DownloadLink kind={kind} />;
}

/** Makes the file first. */
function DownloadButton({ kind: { format, title, short = title } }: { kind: FileKind }) {
  const busy = useSignal(false);
  const press = async () => {
    if (busy.value) return;
    busy.value = true;
    const file = await demandFile(format);
    busy.value = false;
    if (file) save(file);
  };
  return (
    <button
      type="button"
      class="download"
      aria-label={`Download ${title}`}
      aria-busy={busy.value}
      onClick={() => void press()}
    >
      <Download size={15} aria-hidden />
      {busy.value ? 'Making…' : short}
    </button>
  );
}

export function save({ address, name }: Pick<FileLink, 'address' | 'name'>): void {
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
}

function DownloadLink({ kind: { format, title, short = title } }: { kind: FileKind }) {
  const file = files()[format];
  const inside = (
    <>
      <Download size={15} aria-hidden />
      {short}
    </>
  );
  return file ? (
    <a class="download" href={file.address} download={file.name} aria-label={`Download ${title}`} title={file.name}>
      {inside}
    </a>
  ) : (
    <span class="download pending" aria-hidden="true">
      {inside}
    </span>
  );
}

/** The rest, in a small box above the bar; a press beside it or Escape folds it away. */
function More({ children }: { children: ComponentChildren }) {
  const open = useSignal(false);
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!open.value) return;
    const aborter = new AbortController();
    const outside = (event: Event) => {
      if (!box.current?.contains(event.target as Node)) open.value = false;
    };
    addEventListener('pointerdown', outside, { signal: aborter.signal });
    return () => aborter.abort();
  }, [open.value]);
  return (
    <div
      ref={box}
      class="more-files"
      onKeyDown={(event) => {
        if (event.key !== 'Escape') return;
        open.value = false;
        box.current?.querySelector('button')?.focus();
      }}
    >
      <button
        type="button"
        class="download"
        aria-label="More downloads"
        aria-expanded={open.value}
        aria-controls="more-files"
        onClick={() => (open.value = !open.value)}
      >
        More
        <ChevronDown size={15} aria-hidden />
      </button>
      <div id="more-files" class="more-files-list tool-group" hidden={!open.value}>
        {children}
      </div>
    </div>
  );
}
