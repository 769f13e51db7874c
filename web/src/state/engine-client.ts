// The page's end of the engine's worker: starts it, asks it, stops it, and starts another where it does not stop. The
// worker opens pictures from the first moment on; the engine is downloaded meanwhile, but starts only when something is
// asked of it: that takes all the cores of a small machine, which the page and its first picture need before.

import type { Fit, Job, Measured, Problem, RunResult } from 'tessera-wasm';
import EngineWorker from '../worker/engine.worker?worker';
import type { Pieces } from '../worker/pieces';
import { kLabels } from '../worker/protocol';
import type {
  Asking,
  ColourCount,
  Drag,
  EngineInfo,
  FromEngine,
  Graphics,
  Measurable,
  RunRequest,
  ToEngine,
  ToPainter,
  Wood,
  WoodPiece,
} from '../worker/protocol';

// ms that a run may take to stop. The page shows it as cancelled at once; a fresh engine would take longer than this.
const kPatience = 300;
const kPaintPatience = 1000; // ms; in a tab that is not seen nothing is painted
const kMaxThreads = 8;

export interface RunEvents {
  stage(stage: string): void;
  progress(fraction: number): void;
  iteration(index: number, last: number): void;
  warning(message: string): void;
  forecast(text: string): void;
  laid(pieces: readonly WoodPiece[]): void;
  file(format: string, blob: Blob): void;
}

export type RunEnd =
  | {
      kind: 'done';
      result: RunResult;
      milliseconds: number;
      colours: readonly ColourCount[];
      pieces: Pieces | null;
      wood: Wood | null;
      onDemand: boolean;
    }
  | { kind: 'problems'; problems: readonly Problem[] }
  | { kind: 'cancelled' };

/** What goes on in the engine and can be stopped. */
interface Running {
  id: number;
  /** It is over before a fresh engine would be there. */
  brief?: boolean;
  end: (end: RunEnd) => void;
  stopped: () => void;
  ended?: Promise<RunEnd>;
}

type Answer = Extract<FromEngine, { id: number }>;
type Question = Extract<ToEngine, { id: number }>;

export type PictureFacts = Pick<Extract<FromEngine, { type: 'picture' }>, 'width' | 'height' | 'panel'>;

interface Picture {
  slot: string;
  name: string;
  blob: Blob;
}

export class EngineClient {
  private worker!: Worker;
  private stopFlag: Int32Array | null = null;
  private threads = globalThis.crossOriginIsolated ? Math.min(navigator.hardwareConcurrency || 1, kMaxThreads) : 1;
  private graphics: Graphics | null = null;
  private state: 'idle' | 'booting' | 'up' | 'broken' = 'idle';
  private download = this.fetchEngine();
  private wasm: Promise<WebAssembly.Module | undefined> | null = null;
  /** What is asked of the engine before it is up. */
  private queue: Question[] = [];
  private nextId = 1;
  private last = 0; // run
  private stopping: Promise<void> | null = null;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly kept = new Map<string, Picture>(); // by slot
  /** Pictures that the worker is about to open, by the question's number. */
  private readonly opening = new Map<number, Picture>();
  private running: Running | null = null;

  constructor(
    private readonly painter: { postMessage(message: ToPainter, transfer?: Transferable[]): void },
    /** Called for each engine that came up, the first and those after a stop by force. */
    private readonly onReady: (info: EngineInfo) => void,
    private readonly onGraphics: (graphics: Graphics) => void,
    /** With a sentence for people. */
    private readonly onBroken: (message: string) => void,
  ) {
    this.start();
  }

  private start(): void {
    const { port1, port2 } = new MessageChannel();
    this.worker = new EngineWorker({ name: 'engine' });
    this.stopFlag = null;
    this.state = 'idle';
    this.painter.postMessage({ type: 'engine', port: port2 }, [port2]);
    this.send({ type: 'painter', port: port1 }, [port1]);
    this.worker.onmessage = ({ data }: MessageEvent<FromEngine>) => {
      if (data.type === 'ready') {
        this.state = 'up';
        this.stopFlag = data.stopFlag;
        this.onReady(data.info);
        for (const question of this.queue.splice(0)) this.send(question);
      } else if (data.type === 'graphics') {
        this.graphics = data.graphics;
        this.onGraphics(data.graphics);
      } else if (data.type === 'broken') {
        this.breakDown(data.message);
      } else {
        this.waiting.get(data.id)?.(data);
      }
    };
    this.worker.onerror = (event) => this.breakDown(event.message ?? '');
  }

  private fetchEngine(): Promise<Response> {
    const response = fetch(`engine/tessera-${this.threads > 1 ? 'threads' : 'single'}.wasm`, { priority: 'low' });
    response.catch(() => {}); // boot() will see
    return response;
  }

  private async boot(): Promise<void> {
    const { worker, threads, graphics } = this;
    this.state = 'booting';
    await Promise.race([painted(), after(kPaintPatience)]);
    // Compiled once for all workers. Where that fails, the engine tries in its own way and says what is wrong.
    this.wasm ??= WebAssembly.compileStreaming(this.download).catch(() => undefined);
    const wasm = await this.wasm;
    worker.postMessage({ type: 'boot', base: document.baseURI, threads, wasm, graphics } satisfies ToEngine);
  }

  /** Threads can fail where a single one works: too little memory, a worker that a policy forbids. */
  private breakDown(message: string): void {
    if (this.threads > 1) {
      this.threads = 1;
      this.download = this.fetchEngine();
      this.wasm = null;
      return this.restart();
    }
    this.worker.terminate();
    this.state = 'broken';
    const sentence =
      `The engine cannot start: ${message || 'its files did not load'}. It needs WebAssembly with SIMD, which every ` +
      'browser since 2023 has; update yours, or load the page again.';
    this.giveUp(sentence);
    this.onBroken(sentence);
  }

  /** A fresh engine with the same pictures. What was going on in the old one is over; what waited for it waits on. */
  restart(): void {
    this.worker.terminate();
    if (this.state === 'up') this.giveUp('It was interrupted. Try again.');
    this.start();
    if (this.queue.length || this.kept.size) void this.boot();
    for (const picture of this.kept.values()) this.send({ type: 'picture', id: this.nextId++, ...picture });
    for (const [id, picture] of this.opening) this.send({ type: 'picture', id, ...picture });
  }

  private giveUp(message: string): void {
    this.running?.end({ kind: 'cancelled' });
    this.running = null;
    for (const [id, answer] of this.waiting) answer({ type: 'refused', id, message });
    this.waiting.clear();
    this.queue = [];
  }

  private ask(question: Question): void {
    if (this.state === 'up') return this.send(question);
    this.queue.push(question);
    if (this.state === 'idle') void this.boot();
    if (this.state === 'broken') this.restart(); // what failed may work by now
  }

  private send(message: ToEngine, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  /** A picture for the runs that follow; rejects with a message for people where it cannot be used. */
  setPicture(slot: string, name: string, blob: Blob): Promise<PictureFacts> {
    const picture = { slot, name, blob };
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.opening.set(id, picture);
      this.waiting.set(id, (answer) => {
        this.waiting.delete(id);
        this.opening.delete(id);
        if (answer.type === 'picture') {
          this.kept.set(slot, picture);
          resolve(answer);
        } else {
          reject(new Error(answer.type === 'refused' ? answer.message : 'The picture cannot be read.'));
        }
      });
      if (this.state === 'broken') this.restart();
      else this.send({ type: 'picture', id, ...picture });
      if (slot === kLabels && this.state === 'idle') void this.boot(); // which paints it, if need be
    });
  }

  /** A job from its JSON or from an SVG with one in it. */
  readJob(text: string): Promise<Job | readonly Problem[]> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      this.waiting.set(id, (answer) => {
        this.waiting.delete(id);
        if (answer.type === 'job') resolve(answer.job);
        else if (answer.type === 'problems') resolve(answer.problems);
        else if (answer.type === 'refused') resolve([{ code: 'internal', field: '', message: answer.message }]);
      });
      this.ask({ type: 'read', id, text });
    });
  }

  /** Files may still come after the end; the next run or a cancel is the end of them. */
  run(request: RunRequest, events: RunEvents): Promise<RunEnd> {
    // Files of an earlier run that are still on their way are not wanted any more.
    this.waiting.delete(this.last);
    const id = (this.last = this.nextId++);
    const ended = new Promise<RunEnd>((resolve) => {
      let over = false;
      const end = (how: RunEnd) => {
        over = true;
        resolve(how);
      };
      this.running = { id, end, stopped: () => {} };
      this.waiting.set(id, (answer) => {
        switch (answer.type) {
          case 'stage':
            return over || events.stage(answer.stage);
          case 'progress':
            return over || events.progress(answer.fraction);
          case 'iteration':
            return over || events.iteration(answer.index, answer.last);
          case 'warning':
            return over || events.warning(answer.message);
          case 'forecast':
            return over || events.forecast(answer.text);
          case 'laid':
            return over || events.laid(answer.pieces);
          case 'file':
            return events.file(answer.format, answer.blob);
          case 'done':
          case 'problems':
            this.running?.stopped();
            this.running = null;
            if (answer.type === 'problems') this.painter.postMessage({ type: 'drop', upTo: id }); // what it has shown
            if (!over) end(answer.type === 'done' ? { kind: 'done', ...answer } : { kind: 'problems', ...answer });
        }
      });
      this.ask({ type: 'run', id, request });
    });
    if (this.running) this.running.ended = ended;
    return ended;
  }

  /** One more file of the run that ended last; null where the engine does not have it any more. */
  makeFile(format: string): Promise<Blob | null> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      this.waiting.set(id, (answer) => {
        this.waiting.delete(id);
        resolve(answer.type === 'file' ? answer.blob : null);
      });
      this.ask({ type: 'file', id, run: this.last, format });
    });
  }

  /** Statistics of the run that ended last; null where they are not wanted any more. */
  async measure(of: Measurable): Promise<Measured | readonly Problem[] | null> {
    const answer = await this.perform({ type: 'measure', id: this.nextId++, run: this.last, of }, { brief: true });
    if (answer?.type === 'measured') return answer.measured;
    return answer?.type === 'problems' ? answer.problems : null;
  }

  /** What the technique's question is answered with; null where that is not wanted any more, or cannot be told. */
  async answerTo(question: string, asking: Asking): Promise<string | null> {
    const answer = await this.perform({ type: 'ask', id: this.nextId++, question, asking }, { brief: true });
    return answer?.type === 'answer' ? answer.text : null;
  }

  /** The job's morphed grid, even or settled; null where that is not wanted any more. */
  async beginGrid(asking: Asking, settled: boolean) {
    const answer = await this.question({ type: 'grid', id: this.nextId++, asking, settled });
    return answer.type === 'grid' || answer.type === 'problems' ? answer : null;
  }

  /** Steps of the grid that was begun last; null where the engine does not have it any more. */
  async relaxGrid(steps: number, drag: Drag | null) {
    const answer = await this.question({ type: 'relax', id: this.nextId++, steps, drag });
    return answer.type === 'relaxed' ? answer : null;
  }

  /** Lets the vertex go that was dragged; null as above. */
  async layVertex() {
    const answer = await this.question({ type: 'lay', id: this.nextId++ });
    return answer.type === 'lain' ? answer : null;
  }

  /** What is answered once, and waits its turn. */
  private question(question: Question): Promise<Answer> {
    return new Promise((resolve) => {
      this.waiting.set(question.id, (answer) => {
        this.waiting.delete(question.id);
        resolve(answer);
      });
      this.ask(question);
    });
  }

  /** The model that a picture looks like; null where that is not wanted any more. Rejects as setPicture() does. */
  async fit(
    name: string,
    blob: Blob,
    progress: (fraction: number) => void,
  ): Promise<Fit | readonly Problem[] | null> {
    const answer = await this.perform({ type: 'fit', id: this.nextId++, name, blob }, { progress });
    if (answer?.type === 'refused') throw new Error(answer.message);
    if (answer?.type === 'fitted') return answer.fit;
    return answer?.type === 'problems' ? answer.problems : null;
  }

  /** Asks what takes its time, when nothing else goes on; the last answer, or null where it was stopped. */
  private perform(
    question: Question,
    { brief = false, progress }: { brief?: boolean; progress?: (fraction: number) => void },
  ): Promise<Answer | null> {
    const { id } = question;
    return new Promise((resolve) => {
      const running: Running = { id, brief, end: () => resolve(null), stopped: () => {} };
      this.running = running;
      this.waiting.set(id, (answer) => {
        if (answer.type === 'progress') return progress?.(answer.fraction);
        this.waiting.delete(id);
        running.stopped();
        if (this.running === running) this.running = null;
        resolve(answer);
      });
      this.ask(question);
    });
  }

  /** A picture that the engine has. */
  held(slot: string): { name: string; blob: Blob } | null {
    return this.kept.get(slot) ?? null;
  }

  /** Resolves once no run goes on, or after so many milliseconds. */
  async settled(patience: number): Promise<void> {
    const { running } = this;
    if (running) await Promise.race([running.ended, after(patience)]);
  }

  /** Resolves once nothing runs any more; what ran ends as cancelled at once. */
  cancel(): Promise<void> {
    this.stopping ??= this.stop().finally(() => (this.stopping = null));
    return this.stopping;
  }

  private async stop(): Promise<void> {
    const { running, stopFlag } = this;
    if (!running) return;
    running.end({ kind: 'cancelled' });
    if (this.state !== 'up') {
      this.queue = this.queue.filter(({ id }) => id !== running.id);
      this.running = null;
      return;
    }
    this.painter.postMessage({ type: 'drop', upTo: running.id });
    if (!stopFlag && !running.brief) return this.restart();
    const stopped = new Promise<true>((resolve) => (running.stopped = () => resolve(true)));
    const begin = performance.now();
    // Again and again: a run that has not begun yet sets the flag back.
    while (performance.now() - begin < kPatience) {
      if (stopFlag) Atomics.store(stopFlag, 0, 1);
      if (await Promise.race([stopped, after(10)])) return;
    }
    this.restart();
  }
}

/** Once the page shows what it has by now. */
const painted = () =>
  new Promise<void>((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve())));

const after = (milliseconds: number) =>
  new Promise<false>((resolve) => setTimeout(() => resolve(false), milliseconds));
