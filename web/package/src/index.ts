export * from './api.js';
export type * from './parameters.js';

import {
  TesseraError,
  type Artifact,
  type Fit,
  type FitOptions,
  type Iteration,
  type Job,
  type JobSchema,
  type LiveGrid,
  type Measured,
  type MeasureOptions,
  type Picture,
  type Preview,
  type Problem,
  type RunOptions,
  type RunResult,
  type Technique,
  type Tessera,
  type TesseraOptions,
  type WatchOptions,
} from './api.js';

/** What web/wasm/binding.cpp offers. Texts are JSON; an answer {"problems": [...]} takes the place of any other. */
interface CoreModule {
  version(): string;
  schema(): string;
  techniques(): string;
  read(job: string): string;
  setThreads(threads: number): void;
  stopAddress(): number;
  setInput(role: string, rgba: Pixels, width: number, height: number, dpi: number): string;
  forgetInput(role: string): void;
  useGl(software: boolean): string;
  run(job: string, backend: string, improves: boolean, watcher: Watcher): string;
  preview(maxPixels: number, maxSites: number): Preview | null;
  state(): string | null;
  artifact(format: string): Artifact | string;
  artifacts(format: string): Artifact[] | string;
  ask(question: string, job: string, watcher: Watcher): string;
  paintShapes(svg: string): Picture | string;
  beginGrid(job: string): string;
  gridVertices(): Float64Array;
  gridEdges(): ReturnType<LiveGrid['edges']>;
  stepGrid(most: number): number;
  dragVertex(column: number, row: number, x: number, y: number): void;
  layVertex(): string;
  measureFile(bytes: Uint8Array, options: string, watcher: Watcher): string;
  measurePixels(rgba: Pixels, width: number, height: number, options: string, watcher: Watcher): string;
  fit(rgba: Pixels, width: number, height: number, seed: number, watcher: Watcher): string;
  HEAP32: Int32Array;
  PThread?: { unusedWorkers: { unref(): void }[] };
  GL: {
    registerContext(context: WebGL2RenderingContext, attributes: { majorVersion: number }): number;
    makeContextCurrent(handle: number): boolean;
  };
}

type Pixels = Picture['data'];

interface Watcher {
  stage(name: string): void;
  progress(fraction: number): void;
  warning(message: string): void;
  iteration(index: number, last: number): void;
  state(): void;
  goOn(): boolean;
}

type Variant = 'threads' | 'single';
type Factory = (options: object) => Promise<CoreModule>;

const inNode = typeof process === 'object' && Boolean(process.versions?.node);

/** By a name that bundlers do not follow. */
const importAtRunTime = (address: string) => import(/* @vite-ignore */ address);

async function nodeFactory(path: string): Promise<Factory> {
  const { createRequire } = await importAtRunTime('node:module');
  return createRequire(import.meta.url)(path) as Factory;
}

async function readInNode(path: string): Promise<Uint8Array> {
  const { readFile } = await importAtRunTime('node:fs/promises');
  return readFile(path) as Promise<Uint8Array>;
}

async function browserFactory(address: string): Promise<Factory> {
  return ((await importAtRunTime(address)) as { default: Factory }).default;
}

async function beside(name: string): Promise<string> {
  const address = new URL(/* @vite-ignore */ `./engine/${name}`, import.meta.url);
  if (!inNode) return address.href;
  const { fileURLToPath } = await importAtRunTime('node:url');
  return fileURLToPath(address);
}

async function filesOf(variant: Variant, locateFile: TesseraOptions['locateFile']) {
  const names = ['js', 'mjs', 'wasm', 'worker.js'].map((ending) => `tessera-${variant}.${ending}`);
  const places = await Promise.all(names.map((name) => locateFile?.(name) ?? beside(name)));
  return new Map(names.map((name, i) => [name, places[i]!]));
}

/** Emscripten's hook, for a module that is compiled already. */
const instantiate = (wasm: WebAssembly.Module) => ({
  instantiateWasm(
    imports: WebAssembly.Imports,
    done: (instance: WebAssembly.Instance, wasm: WebAssembly.Module) => void,
  ) {
    void WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm));
    return {};
  },
});

/** All the threads there are, where the page may use shared memory. */
function availableThreads(): number {
  if (!inNode && !globalThis.crossOriginIsolated) return 1;
  return Math.max(1, Math.min(globalThis.navigator?.hardwareConcurrency ?? 4, 16));
}

/** Loads the core. Rejects where its files cannot be had, or the browser has no WebAssembly with SIMD. */
export async function createTessera(options: TesseraOptions = {}): Promise<Tessera> {
  const threads = options.threads ?? availableThreads();
  const variant: Variant = threads > 1 ? 'threads' : 'single';
  const files = await filesOf(variant, options.locateFile);
  const script = files.get(`tessera-${variant}.js`)!;
  const factory = await (inNode ? nodeFactory(script) : browserFactory(files.get(`tessera-${variant}.mjs`)!));
  const module = await factory({
    ...(inNode && { wasmBinary: await readInNode(files.get(`tessera-${variant}.wasm`)!) }), // fetch() knows no paths
    ...(options.wasm && instantiate(options.wasm)),
    poolSize: threads,
    mainScriptUrlOrBlob: script, // what the threads' workers load
    locateFile: (name: string) => files.get(name) ?? name,
  });
  // Waiting threads do not keep a program alive that is done.
  if (inNode) for (const worker of module.PThread?.unusedWorkers ?? []) worker.unref();
  module.setThreads(threads);
  return new Core(module, threads);
}

/** The answer in `text`; throws the problems that stand in its place. */
function answer<T>(text: string): T {
  const value = JSON.parse(text) as T | { problems: Problem[] };
  if (value && typeof value === 'object' && 'problems' in value) throw new TesseraError(value.problems);
  return value as T;
}

/** Throws where the pixels are not as many as the size says. */
function checkPixels({ data, width, height }: Picture, field: string): void {
  if (data.length === 4 * width * height) return;
  const message = `has ${data.length} bytes, expected ${4 * width * height} for ${width} x ${height} px`;
  throw new TesseraError([{ code: 'invalidInput', field, message }]);
}

const watcherOf = (
  options: RunOptions | WatchOptions,
  iteration: Watcher['iteration'] = () => {},
  state: Watcher['state'] = () => {},
): Watcher => ({
  stage: (name) => options.onStage?.(name),
  progress: (fraction) => options.onProgress?.(fraction),
  warning: (message) => 'onWarning' in options && options.onWarning?.(message),
  iteration,
  state,
  goOn: () => ('goOnImproving' in options && options.goOnImproving?.()) || false,
});

const softwareRenderers = /swiftshader|llvmpipe|softpipe|software|basic render/i;

class Core implements Tessera {
  readonly version: string;
  readonly schema: JobSchema;
  readonly techniques: Technique[];
  readonly stopFlag: Int32Array | null;

  constructor(
    private readonly module: CoreModule,
    readonly threads: number,
  ) {
    this.version = module.version();
    this.schema = JSON.parse(module.schema()) as JobSchema;
    this.techniques = JSON.parse(module.techniques()) as Technique[];
    // A view of its own, so that it outlives growth of the memory.
    const { buffer } = module.HEAP32;
    const shared = typeof SharedArrayBuffer === 'function' && buffer instanceof SharedArrayBuffer;
    this.stopFlag = shared ? new Int32Array(buffer, module.stopAddress(), 1) : null;
  }

  readJob(text: string): Job {
    return answer<{ job: Job }>(this.module.read(text)).job;
  }

  validate(job: Job): Problem[] {
    const result = JSON.parse(this.module.read(JSON.stringify(job))) as { problems?: Problem[] };
    return result.problems ?? [];
  }

  setInput(role: string, picture: Picture | null): void {
    if (!picture) return this.module.forgetInput(role);
    checkPixels(picture, role);
    const trouble = this.module.setInput(role, picture.data, picture.width, picture.height, picture.dpi ?? 0);
    if (trouble) answer(trouble);
  }

  useCanvas(canvas: OffscreenCanvas) {
    const gl = canvas.getContext('webgl2', { antialias: false, depth: false, powerPreference: 'high-performance' });
    if (!gl) return { works: false, software: false, renderer: 'there is no WebGL2' };
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const renderer = String(gl.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
    const software = softwareRenderers.test(renderer);
    this.module.GL.makeContextCurrent(this.module.GL.registerContext(gl, { majorVersion: 2 }));
    const trouble = this.module.useGl(software);
    return { works: !trouble, software, renderer: trouble || renderer };
  }

  run(job: Job, options: RunOptions = {}): RunResult {
    const watcher = watcherOf(
      options,
      (index, last) => options.onIteration?.(this.iteration(index, last)),
      () => options.onState?.(() => this.module.state() ?? ''),
    );
    const improves = options.goOnImproving !== undefined;
    return answer<RunResult>(this.module.run(JSON.stringify(job), options.backend ?? 'auto', improves, watcher));
  }

  artifact(format: string): Artifact {
    const made = this.module.artifact(format);
    return typeof made === 'string' ? answer<Artifact>(made) : made;
  }

  artifacts(format: string): Artifact[] {
    const made = this.module.artifacts(format);
    return typeof made === 'string' ? answer<Artifact[]>(made) : made;
  }

  ask(question: string, job: Job, options: RunOptions = {}): string {
    return answer<{ answer: string }>(this.module.ask(question, JSON.stringify(job), watcherOf(options))).answer;
  }

  beginGrid(job: Job): LiveGrid {
    const { module } = this;
    const size = answer<Pick<LiveGrid, 'across' | 'down' | 'widthMm' | 'heightMm'>>(
      module.beginGrid(JSON.stringify(job)),
    );
    return {
      ...size,
      vertices: () => module.gridVertices(),
      edges: () => module.gridEdges(),
      step: (most) => module.stepGrid(most),
      drag: (column, row, x, y) => module.dragVertex(column, row, x, y),
      lay: () => module.layVertex(),
    };
  }

  paintShapes(svg: string): Picture {
    const painted = this.module.paintShapes(svg);
    return typeof painted === 'string' ? answer<Picture>(painted) : painted;
  }

  measure(of: Picture | Uint8Array, options: MeasureOptions = {}): Measured {
    const text = JSON.stringify(options); // without its functions
    const watcher = watcherOf(options);
    if (of instanceof Uint8Array) return answer<Measured>(this.module.measureFile(of, text, watcher));
    checkPixels(of, '');
    return answer<Measured>(this.module.measurePixels(of.data, of.width, of.height, text, watcher));
  }

  fit(picture: Picture, options: FitOptions = {}): Fit {
    checkPixels(picture, '');
    const { data, width, height } = picture;
    return answer<Fit>(this.module.fit(data, width, height, options.seed ?? 1, watcherOf(options)));
  }

  private iteration(index: number, last: number): Iteration {
    return {
      index,
      last,
      draw: (maxPixels, maxSites) => {
        const preview = this.module.preview(maxPixels, maxSites);
        if (!preview) throw new Error('draw() works only during onIteration');
        return preview;
      },
    };
  }
}
