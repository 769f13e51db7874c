// The page's end of the engine's worker: starts it, asks it, stops it, and starts another where it does not stop.

import type { Job, Problem, RunResult } from 'tessera-wasm';
import EngineWorker from '../worker/engine.worker?worker';
import type { EngineInfo, FromEngine, Graphics, RunRequest, ToEngine, ToPainter } from '../worker/protocol';

// ms that a run may take to stop. The page shows it as cancelled at once; a fresh engine would take longer than this.
const kPatience = 300;
const kMaxThreads = 8;

export interface RunEvents {
  stage(stage: string): void;
  progress(fraction: number): void;
  iteration(index: number, last: number): void;
  warning(message: string): void;
  file(format: string, blob: Blob): void;
}

export type RunEnd =
  | { kind: 'done'; result: RunResult; milliseconds: number }
  | { kind: 'problems'; problems: readonly Problem[] }
  | { kind: 'cancelled' };

type Answer = Extract<FromEngine, { id: number }>;

export class EngineClient {
  private worker!: Worker;
  private stopFlag: Int32Array | null = null;
  private ready!: Promise<EngineInfo>;
  private threads = globalThis.crossOriginIsolated ? Math.min(navigator.hardwareConcurrency || 1, kMaxThreads) : 1;
  private graphics: Graphics | null = null;
  private nextId = 1;
  private last = 0; // run
  private stopping: Promise<void> | null = null;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private kept: { role: string; name: string; blob: Blob } | null = null;
  private running: { id: number; end: (end: RunEnd) => void; stopped: () => void } | null = null;

  constructor(
    private readonly painter: { postMessage(message: ToPainter, transfer?: Transferable[]): void },
    /** Called for each engine that came up, the first and those after a stop by force. */
    private readonly onReady: (info: EngineInfo) => void,
    private readonly onGraphics: (graphics: Graphics) => void,
    private readonly onBroken: (message: string) => void,
  ) {
    this.start();
  }

  private start(): void {
    const { port1, port2 } = new MessageChannel();
    this.worker = new EngineWorker({ name: 'engine' });
    this.stopFlag = null;
    this.painter.postMessage({ type: 'engine', port: port2 }, [port2]);
    const { threads, graphics } = this;
    this.send({ type: 'boot', base: document.baseURI, threads, graphics, painter: port1 }, [port1]);
    this.ready = new Promise((resolve) => {
      const { worker } = this;
      worker.onmessage = ({ data }: MessageEvent<FromEngine>) => {
        if (data.type === 'ready') {
          this.stopFlag = data.stopFlag;
          this.onReady(data.info);
          resolve(data.info);
        } else if (data.type === 'graphics') {
          this.graphics = data.graphics;
          this.onGraphics(data.graphics);
        } else if (data.type === 'broken') {
          this.breakDown(data.message);
        } else {
          this.waiting.get(data.id)?.(data);
        }
      };
      worker.onerror = (event) => this.breakDown(event.message ?? '');
    });
  }

  /** Threads can fail where a single one works: too little memory, a worker that a policy forbids. */
  private breakDown(message: string): void {
    this.worker.terminate();
    if (this.threads === 1) return this.onBroken(message);
    this.threads = 1;
    this.restart();
  }

  /** A fresh engine with the same picture. */
  restart(): void {
    this.worker.terminate();
    this.running?.end({ kind: 'cancelled' });
    this.running = null;
    for (const [id, answer] of this.waiting)
      answer({ type: 'refused', id, message: 'It was interrupted. Try again.' });
    this.waiting.clear();
    this.start();
    const { kept } = this;
    if (kept) this.ready = this.ready.then((info) => this.hand(kept).then(() => info));
  }

  private send(message: ToEngine, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  /** The picture for the runs that follow; rejects with a message for people where it cannot be used. */
  async setPicture(role: string, name: string, blob: Blob): Promise<{ width: number; height: number }> {
    const size = await this.hand({ role, name, blob });
    this.kept = { role, name, blob };
    return size;
  }

  private hand(picture: { role: string; name: string; blob: Blob }): Promise<{ width: number; height: number }> {
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, (answer) => {
        this.waiting.delete(id);
        if (answer.type === 'picture') resolve(answer);
        else reject(new Error(answer.type === 'refused' ? answer.message : 'The picture cannot be read.'));
      });
      this.send({ type: 'picture', id, ...picture });
    });
  }

  /** A job from its JSON or from an SVG with one in it. */
  async readJob(text: string): Promise<Job | readonly Problem[]> {
    await this.ready;
    const id = this.nextId++;
    return new Promise((resolve) => {
      this.waiting.set(id, (answer) => {
        this.waiting.delete(id);
        if (answer.type === 'job') resolve(answer.job);
        else if (answer.type === 'problems') resolve(answer.problems);
        else if (answer.type === 'refused') resolve([{ code: 'internal', field: '', message: answer.message }]);
      });
      this.send({ type: 'read', id, text });
    });
  }

  /** Files may still come after the end; the next run or a cancel is the end of them. */
  async run(request: RunRequest, events: RunEvents): Promise<RunEnd> {
    await this.ready;
    // Files of an earlier run that are still on their way are not wanted any more.
    this.waiting.delete(this.last);
    const id = (this.last = this.nextId++);
    return new Promise((resolve) => {
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
          case 'file':
            return events.file(answer.format, answer.blob);
          case 'done':
          case 'problems':
            this.running?.stopped();
            this.running = null;
            if (!over) end(answer.type === 'done' ? { kind: 'done', ...answer } : { kind: 'problems', ...answer });
        }
      });
      this.send({ type: 'run', id, request });
    });
  }

  /** Resolves once nothing runs any more; the run itself ends as cancelled at once. */
  cancel(): Promise<void> {
    this.stopping ??= this.stop().finally(() => (this.stopping = null));
    return this.stopping;
  }

  private async stop(): Promise<void> {
    const { running, stopFlag } = this;
    if (!running) return;
    running.end({ kind: 'cancelled' });
    this.painter.postMessage({ type: 'drop', upTo: running.id });
    if (!stopFlag) return this.restart();
    const stopped = new Promise<true>((resolve) => (running.stopped = () => resolve(true)));
    const begin = performance.now();
    // Again and again: a run that has not begun yet sets the flag back.
    while (performance.now() - begin < kPatience) {
      Atomics.store(stopFlag, 0, 1);
      if (await Promise.race([stopped, after(10)])) return;
    }
    this.restart();
  }
}

const after = (milliseconds: number) =>
  new Promise<false>((resolve) => setTimeout(() => resolve(false), milliseconds));
