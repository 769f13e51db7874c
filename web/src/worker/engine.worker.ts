// The engine's thread. Calls into it block until they are done; what happens meanwhile is posted from its callbacks.

import {
  createTessera,
  TesseraError,
  type Artifact,
  type Iteration,
  type Job,
  type LiveGrid,
  type Picture,
  type Problem,
  type RunResult,
  type Tessera,
} from 'tessera-wasm';
import { open, openPixels, PictureError, scaled, toLookAt, type Opened } from './decode';
import { paintEdges } from './edges';
import { Growing, matchingDpi } from './growing';
import { countColours, noPieces, parsePieces, transferable, type Pieces } from './pieces';
import {
  kEdgeMask,
  kEdgeMaskFile,
  kLabels,
  kMask,
  kPanel,
  kPicture,
  maskFileOf,
  type Asking,
  type EngineToPainter,
  type FromEngine,
  type Graphics,
  type RunRequest,
  type ToEngine,
  type Wood,
} from './protocol';
import { scope } from './scope';
import { checksum, previewOf, reportOf, woodOf, zipped } from './wood';

const kPreviewPixels = 600_000;
const kPreviewSites = 16_000;
const kPreviewPause = 33; // ms
const kPreviewShare = 8; // of the time, at most one in so many parts goes into previews
const kManyPieces = 50_000;
const kSmallPiece = 3; // px²
const kPanelSide = 1400; // px of a panel's picture on the page
const kGrowingPause = 250; // ms; each takes the page a frame, where graphics are drawn in software a good part of a core
const kManySteps = 50;
const kNoGround = '#96928a';
const kGround = /<rect [^>]*fill="(#[0-9a-f]{6})"/;

let engine: Tessera | undefined;
let painter: MessagePort | undefined;
let newest = 0; // request; an older one makes no more files
let pictureTaken = Promise.resolve(); // one after the other: the newest is the one that stays
const pictures = new Map<string, Held>(); // by slot
const given = new Map<string, Picture>(); // that the engine has copies of, by role
let grid: LiveGrid | undefined; // that is worked on

interface Held {
  blob: Blob;
  opened: Opened;
  whole?: Picture;
  reduced?: { scale: number; picture: Picture };
}

const kOver: Problem = { code: 'cancelled', field: '', message: 'the run is over' };

const tell = (message: FromEngine) => scope.postMessage(message);
const show = (message: EngineToPainter, transfer: Transferable[]) => painter?.postMessage(message, transfer);
/** Lets messages in that have come meanwhile. */
const breathe = (milliseconds = 0) => new Promise<void>((resolve) => setTimeout(resolve, milliseconds));

const problemsOf = (error: unknown): readonly Problem[] =>
  error instanceof TesseraError
    ? error.problems
    : [{ code: 'internal', field: '', message: error instanceof Error ? error.message : String(error) }];

/** What is known of the graphics, and whether this engine has a canvas to draw on. */
let graphics: Graphics | null = null;
let canvasOffered = false;

/**
 * Making a context holds up the page, so that it is made late, and only for an engine that may use it: one on graphics
 * hardware, or one that is told to.
 */
function lookForGraphics(tessera: Tessera, wanted: boolean): void {
  if (canvasOffered || (graphics && !wanted && (!graphics.works || graphics.software))) return;
  canvasOffered = true;
  graphics = tessera.useCanvas(new OffscreenCanvas(1, 1));
  tell({ type: 'graphics', graphics });
}

let engineUp: (tessera: Tessera) => void;
let engineFailed: (reason: unknown) => void;
const comingEngine = new Promise<Tessera>((resolve, reject) => {
  engineUp = resolve;
  engineFailed = reject;
});
comingEngine.catch(() => {}); // told as 'broken'

async function boot({ base, threads, wasm, graphics: known }: ToEngine & { type: 'boot' }): Promise<void> {
  graphics = known;
  try {
    engine = await createTessera({ threads, wasm, locateFile: (name) => new URL(`engine/${name}`, base).href });
    const { version, stopFlag } = engine;
    tell({ type: 'ready', info: { version, threads: engine.threads }, stopFlag });
    engineUp(engine);
  } catch (error) {
    engineFailed(error);
    tell({ type: 'broken', message: problemsOf(error)[0]?.message ?? '' });
  }
}

const kindIn = (slot: string) => (slot === kLabels ? 'numbers' : slot.startsWith(kPanel) ? 'see-through' : 'colours');

async function takePicture({ id, slot, name, blob }: ToEngine & { type: 'picture' }): Promise<void> {
  try {
    const shapes = slot === kLabels && (await isMarkup(blob));
    const opened = shapes ? await openShapes(blob) : await open(blob, name, kindIn(slot));
    pictures.set(slot, { blob, opened });
    const { bitmap, width, height, dpi } = opened;
    const panel = slot.startsWith(kPanel) ? { dpi, small: await smallOf(bitmap, width, height) } : null;
    if (slot === kPicture) show({ type: 'source', bitmap, width, height }, [bitmap]);
    else bitmap.close();
    tell({ type: 'picture', id, width, height, panel });
  } catch (error) {
    tell({ type: 'refused', id, message: whyNot(error, name) });
  }
}

function whyNot(error: unknown, name: string): string {
  if (error instanceof PictureError) return error.message;
  if (error instanceof TesseraError) return `“${name}” ${error.problems[0]?.message ?? 'cannot be read'}.`;
  return `“${name}” cannot be read. Choose another file.`;
}

const isMarkup = async (blob: Blob) => /^\s*</.test(await blob.slice(0, 100).text());

/** An SVG of closed shapes, painted by the engine, so that pieces are the command line's. */
async function openShapes(blob: Blob): Promise<Opened> {
  const { data, width, height } = (await comingEngine).paintShapes(await blob.text());
  return openPixels(new Uint8ClampedArray(data), width, height);
}

/** For the page, which cannot show every kind of file by itself. */
async function smallOf(bitmap: ImageBitmap, width: number, height: number): Promise<Blob> {
  const small = await toLookAt(bitmap, width, height, kPanelSide);
  const canvas = new OffscreenCanvas(small.width, small.height);
  canvas.getContext('2d')?.drawImage(small, 0, 0);
  small.close();
  return canvas.convertToBlob();
}

/** The engine's copy of each picture of the job, whole or reduced as this run wants it; none of any other. */
async function setInputs(tessera: Tessera, { inputs }: Asking, scale: number): Promise<void> {
  for (const role of given.keys()) {
    if (role in inputs) continue;
    tessera.setInput(role, null);
    given.delete(role);
  }
  for (const [role, slot] of Object.entries(inputs)) {
    const held = pictures.get(slot);
    if (!held) continue;
    held.whole ??= held.opened.pixels();
    if (scale < 1 && held.reduced?.scale !== scale) {
      held.reduced = { scale, picture: await scaled(held.whole, scale) };
    }
    const picture = scale < 1 ? held.reduced?.picture : held.whole;
    if (!picture || given.get(role) === picture) continue;
    tessera.setInput(role, { ...pixelsIn(picture), dpi: scale < 1 ? 0 : held.opened.dpi });
    given.set(role, picture);
  }
}

/** An ImageData's own members are not its own properties. */
const pixelsIn = ({ data, width, height }: Picture): Picture => ({ data, width, height });

async function ask({ id, question, asking }: ToEngine & { type: 'ask' }): Promise<void> {
  await pictureTaken;
  try {
    if (!engine) return;
    await setInputs(engine, asking, 1);
    tell({ type: 'answer', id, text: engine.ask(question, asking.job) });
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

async function beginGrid({ id, asking, settled }: ToEngine & { type: 'grid' }): Promise<void> {
  await pictureTaken;
  try {
    if (!engine) return;
    await setInputs(engine, asking, 1);
    grid = engine.beginGrid(asking.job);
    if (settled) while (grid.step(kManySteps) > 0) continue;
    const { across, down, widthMm, heightMm } = grid;
    const size = { across, down, widthMm, heightMm };
    tell({ type: 'grid', id, size, vertices: grid.vertices(), edges: paintEdges(grid.edges()) });
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

function relax({ id, steps, drag }: ToEngine & { type: 'relax' }): void {
  if (!grid) return tell({ type: 'refused', id, message: '' });
  if (drag) grid.drag(drag.column, drag.row, drag.x, drag.y);
  const done = grid.step(steps);
  tell({ type: 'relaxed', id, vertices: grid.vertices(), steps: done });
}

function lay({ id }: ToEngine & { type: 'lay' }): void {
  if (!grid) return tell({ type: 'refused', id, message: '' });
  const pins = grid.lay();
  tell({ type: 'lain', id, vertices: grid.vertices(), pins });
}

async function run(id: number, request: RunRequest): Promise<void> {
  newest = id;
  await pictureTaken;
  if (!engine || newest !== id) return;
  try {
    if (request.backend === 'gl') lookForGraphics(engine, true);
    await setInputs(engine, request, request.scale);
    if (newest !== id) return;
    forecast(engine, id, request);
    const clock = stageClock();
    const begin = performance.now();
    const result = engine.run(request.job, {
      backend: request.backend,
      onStage: (stage) => {
        clock.begin(stage);
        tell({ type: 'stage', id, stage });
      },
      onProgress: (fraction) => tell({ type: 'progress', id, fraction }),
      onWarning: (message) => tell({ type: 'warning', id, message }),
      onIteration: previewer(id, request.scale),
      ...(request.improve > 0 && { goOnImproving: patience(request.improve) }),
      ...grower(id, request),
    });
    const milliseconds = performance.now() - begin;
    const noise = isNoise(result);
    const png = noise || result.retouched ? blobOf(engine, 'png') : null;
    const pieces = noise ? sheetOf(request.job) : parsePieces(engine.artifact('json').bytes);
    const folder = request.panels && (await openFolder(engine, request, pieces));
    const face = folder?.preview ?? (png && (await createImageBitmap(png)));
    const ground = noise ? kNoGround : groundOf(engine);
    tell({
      type: 'done',
      id,
      result,
      milliseconds,
      colours: countColours(pieces),
      pieces: request.pieces ? pieces : null,
      wood: folder?.wood ?? null,
      onDemand: noise,
    });
    const seamless = request.job.params['seamless'] === true;
    show(
      { type: 'pieces', id, pieces, ground, scale: folder?.wood.scale ?? request.scale, seamless, face },
      face ? [...transferable(pieces), face] : transferable(pieces),
    );
    const formats = noise ? ['png'] : request.formats;
    const made = new Map(png ? [['png', png]] : []);
    if (folder) made.set('folder', await zipOfRun(engine, request, result, clock.end(), folder.files));
    if (request.scale === 1) await makeFiles(engine, id, formats, made);
    if (newest === id && request.backend === 'auto') lookForGraphics(engine, false); // for the runs to come
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

/** True for so many seconds from the first time that it is asked. */
function patience(seconds: number): () => boolean {
  let end = 0;
  return () => performance.now() < (end ||= performance.now() + 1000 * seconds);
}

/** How long each stage took. */
function stageClock() {
  const stages: { name: string; ms: number }[] = [];
  let since = performance.now();
  const end = () => {
    const last = stages.at(-1);
    if (last && !last.ms) last.ms = performance.now() - since;
    return stages;
  };
  const begin = (name: string) => {
    end();
    since = performance.now();
    stages.push({ name, ms: 0 });
  };
  return { begin, end };
}

/** Whether the wood suffices; what is wrong with it, the run will say. */
function forecast(tessera: Tessera, id: number, { job, panels }: RunRequest): void {
  if (!panels) return;
  try {
    tell({ type: 'forecast', id, text: tessera.ask('forecast', job) });
  } catch (error) {
    if (!(error instanceof TesseraError)) throw error;
  }
}

const dpiIn = (slot: string) => pictures.get(slot)?.opened.dpi ?? 0;
const dpisOf = (panels: NonNullable<RunRequest['panels']>) =>
  panels.map(({ name, dpi }) => ({ dpi: dpi || dpiIn(kPanel + name) }));

/** Shows a parquetry piece by piece, some frames a second. */
function grower(id: number, { job, inputs, panels }: RunRequest): { onState?(state: () => string): void } {
  if (!panels) return {};
  const targets = Object.entries(inputs)
    .filter(([role]) => /^target(-|$)/.test(role))
    .sort(([a], [b]) => a.length - b.length || (a < b ? -1 : 1))
    .flatMap(([, slot]) => pictures.get(slot)?.opened ?? []);
  if (!targets.length) return {};
  const scans = [...panels]
    .sort((a, b) => (a.name < b.name ? -1 : 1))
    .flatMap(({ name, dpi }) => {
      const held = pictures.get(kPanel + name);
      return held?.whole ? { name, dpi: dpi || held.opened.dpi, picture: held.whole } : [];
    });
  const number = (key: string) => Number(job.params[key]);
  const growing = new Growing(scans, targets, number('imageSizeMm'), number('resolutionDpi'), number('copies'));
  let shown = -Infinity;
  return {
    onState: (state) => {
      if (performance.now() - shown < kGrowingPause) return;
      shown = performance.now();
      const pieces = growing.take(state());
      const bitmap = growing.bitmap();
      show({ type: 'growing', id, bitmap }, [bitmap]);
      tell({ type: 'laid', id, pieces });
    },
  };
}

interface Folder {
  files: readonly Artifact[];
  preview: ImageBitmap | null;
  wood: Wood;
}

async function openFolder(tessera: Tessera, { job, panels }: RunRequest, pieces: Pieces): Promise<Folder> {
  const files = tessera.artifacts('folder');
  const preview = await previewOf(files);
  const mmPerPx = 25.4 / matchingDpi(dpisOf(panels ?? []), Number(job.params['resolutionDpi']));
  const names = (panels ?? []).map(({ name }) => name);
  const height = preview?.firstHeight ?? pieces.height;
  const scale = height / (pictures.get(kPicture)?.opened.height ?? height);
  return { files, preview: preview?.all ?? null, wood: await woodOf(files, pieces, mmPerPx, names, scale) };
}

async function zipOfRun(
  tessera: Tessera,
  { inputs }: RunRequest,
  result: RunResult,
  stages: ReturnType<ReturnType<typeof stageClock>['end']>,
  files: readonly Artifact[],
): Promise<Blob> {
  const { job } = result;
  const masks: Record<string, Uint8Array> = {};
  const read = await Promise.all(
    Object.entries(inputs).map(async ([role, slot]) => {
      const held = pictures.get(slot);
      const { width = 0, height = 0 } = held?.opened ?? {};
      const bytes = await held?.blob.arrayBuffer();
      const name = role === kEdgeMask ? kEdgeMaskFile : maskFileOf(role.slice(kMask.length));
      const isMask = role === kEdgeMask || role.startsWith(kMask);
      if (bytes && isMask && job.inputs[role] === name) masks[name] = new Uint8Array(bytes);
      return { path: job.inputs[role] ?? '', width, height, ...(bytes && (await checksum(bytes))) };
    }),
  );
  const report = await reportOf(tessera.version, tessera.threads, job, read, result, stages, files);
  return zipped({ files, report, masks });
}

/** Pieces so many and so small that their picture is all there is to see. */
const isNoise = ({ counts, metrics }: RunResult) =>
  (counts['cells'] ?? 0) > kManyPieces && (metrics['area_mean'] ?? Infinity) < kSmallPiece;

const sheetOf = ({ params }: Job) => noPieces(Number(params['width']), Number(params['height']));

const groundOf = (tessera: Tessera) =>
  kGround.exec(new TextDecoder().decode(tessera.artifact('svg').bytes.subarray(0, 8192)))?.[1] ?? kNoGround;

/** About thirty previews a second, fewer where they cost much, and always the last one, which stays to be looked at. */
function previewer(id: number, scale: number): (iteration: Iteration) => void {
  let shown = -Infinity;
  let cost = 0;
  return (iteration) => {
    const { index, last } = iteration;
    const begin = performance.now();
    if (index < last && begin - shown < Math.max(kPreviewPause, kPreviewShare * cost)) return;
    const preview = iteration.draw(kPreviewPixels, kPreviewSites);
    const { cells, palette, sites } = preview;
    show({ type: 'preview', id, preview, scale }, [cells.buffer, palette.buffer, sites.buffer] as ArrayBuffer[]);
    tell({ type: 'iteration', id, index, last });
    shown = performance.now();
    cost = shown - begin;
  };
}

function blobOf(tessera: Tessera, format: string): Blob {
  const { bytes, mediaType } = tessera.artifact(format);
  return new Blob([bytes as Uint8Array<ArrayBuffer>], { type: mediaType });
}

/** `made`: files that are there already. */
async function makeFiles(
  tessera: Tessera,
  id: number,
  formats: readonly string[],
  made: ReadonlyMap<string, Blob>,
): Promise<void> {
  for (const format of formats) {
    await breathe();
    if (newest !== id) return;
    tell({ type: 'file', id, format, blob: made.get(format) ?? blobOf(tessera, format) });
  }
}

function makeFile({ id, run, format }: ToEngine & { type: 'file' }): void {
  try {
    if (!engine || newest !== run) throw new Error('the run is over');
    tell({ type: 'file', id, format, blob: blobOf(engine, format) });
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

async function measure({ id, run, of }: ToEngine & { type: 'measure' }): Promise<void> {
  try {
    const picture =
      engine && newest === run && of === 'png' ? await open(blobOf(engine, 'png'), 'the picture') : null;
    picture?.bitmap.close();
    if (!engine || newest !== run) return tell({ type: 'problems', id, problems: [kOver] });
    tell({ type: 'measured', id, measured: engine.measure(picture?.pixels() ?? engine.artifact(of).bytes) });
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

async function fit({ id, name, blob }: ToEngine & { type: 'fit' }): Promise<void> {
  try {
    if (!engine) return;
    const { bitmap, pixels } = await open(blob, name);
    const fitted = engine.fit(pixels(), { onProgress: (fraction) => tell({ type: 'progress', id, fraction }) });
    show({ type: 'compared', bitmap }, [bitmap]);
    tell({ type: 'fitted', id, fit: fitted });
  } catch (error) {
    if (error instanceof PictureError) tell({ type: 'refused', id, message: error.message });
    else tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

function read(id: number, text: string): void {
  try {
    if (engine) tell({ type: 'job', id, job: engine.readJob(text) });
  } catch (error) {
    tell({ type: 'problems', id, problems: [...problemsOf(error)] });
  }
}

scope.onmessage = ({ data }: MessageEvent<ToEngine>) => {
  switch (data.type) {
    case 'painter':
      painter = data.port;
      return;
    case 'boot':
      return void boot(data);
    case 'picture':
      pictureTaken = pictureTaken.then(() => takePicture(data));
      return;
    case 'run':
      return void run(data.id, data.request);
    case 'ask':
      return void ask(data);
    case 'grid':
      return void beginGrid(data);
    case 'relax':
      return relax(data);
    case 'lay':
      return lay(data);
    case 'file':
      return makeFile(data);
    case 'read':
      return read(data.id, data.text);
    case 'measure':
      return void measure(data);
    case 'fit':
      return void fit(data);
  }
};
