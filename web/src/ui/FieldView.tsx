import { useSignal, useSignalEffect, type Signal } from '@preact/signals';
import { Box, Grid3x3, Image, Maximize, Minus, Mountain, Plus, RotateCcw, Sun } from 'lucide-preact';
import type { RefObject } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { Field, FieldLook } from '../field/field';
import { changeValue, changeValues } from '../state/edits';
import { chosen } from '../state/pebbles';
import { fields, outcome, params } from '../state/store';
import { calm, shade } from '../state/theme';
import { counted } from '../techniques/facts';
import { SizeCurve } from './SizeCurve';
import { IconTool } from './ToolBar';

type State = 'loading' | 'ready' | 'missing' | 'lost';

const kTurn = 0.12; // radians an arrow key turns
const kLight = Math.PI / 4; // radians that a press moves the light
const kSoftware = /swiftshader|llvmpipe|softpipe|software|basic render/i;

interface Look {
  texture: boolean;
  wireframe: boolean;
  light: number;
}

/** The field of stones in three dimensions, and the curve of their sizes. */
export function FieldView() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { field, state, lifted, pointed } = useField(canvas);
  const look = useSignal<Look>({ texture: true, wireframe: false, light: 0 });
  const keyed = useSignal<number | null>(null); // the pebble that keys have chosen
  const { shown, stones } = useGlb(field, () => (keyed.value = null));
  useSignalEffect(() => {
    void shade.value; // the styles follow it
    field.value?.setLook({ ...look.value, ...inks(), calm: calm.value });
  });
  useSignalEffect(() => {
    const last = chosen.value.at(-1);
    const ids = outcome.value?.pieces?.ids;
    field.value?.choose((last && ids?.[last.piece]) ?? keyed.value);
  });
  return (
    <div class="field-view">
      <div
        class="field-stage"
        aria-busy={state.value === 'ready' && shown.value !== outcome.value?.files['glb']?.blob}
        data-state={state.value}
        data-lifted={lifted.value.length}
      >
        <div class="field-canvas">
          <canvas
            ref={canvas}
            tabIndex={0}
            role="application"
            aria-label={
              `Field of ${counted(stones.value, 'pebbles')}. Arrow keys turn it, plus and minus zoom, 0 fits. ` +
              'N and B choose the next pebble and the one before, Enter takes it out of the ground and puts it back.'
            }
            onKeyDown={(event) => field.value && onKey(event, field.value, (id) => (keyed.value = id))}
          />
        </div>
        {state.value === 'ready' ? (
          <>
            <FieldTools look={look} />
            <FieldZoom field={field.value} lifted={lifted.value.length} />
            <FieldLabel pointed={pointed.value ?? keyed.value} lifted={lifted.value} />
          </>
        ) : (
          <p class="field-words">{kWords[state.value]}</p>
        )}
      </div>
      <SizeCurve />
    </div>
  );
}

/** Starts what draws the field, which is a download of its own, keeps it in the canvas' size, and ends it. */
function useField(canvas: RefObject<HTMLCanvasElement>) {
  const field = useSignal<Field | null>(null);
  const state = useSignal<State>('loading');
  const lifted = useSignal<readonly number[]>([]);
  const pointed = useSignal<number | null>(null);
  useEffect(() => {
    const element = canvas.current;
    const box = element?.parentElement;
    if (!element || !box) return;
    let gone = false;
    const resize = () => {
      field.value?.resize(box.clientWidth, box.clientHeight, devicePixelRatio);
    };
    const resized = new ResizeObserver(resize);
    resized.observe(box);
    const start = async () => {
      const renderer = rendererName();
      const { Field } = await import('../field/field');
      if (gone) return;
      field.value = new Field(element, kSoftware.test(renderer), {
        pointed: (id) => (pointed.value = id),
        lifted: (ids) => (lifted.value = ids),
        lost: () => (state.value = 'lost'),
      });
      state.value = 'ready';
      resize();
    };
    start().catch(() => (state.value = 'missing'));
    return () => {
      gone = true;
      resized.disconnect();
      field.value?.dispose();
    };
  }, []);
  return { field, state, lifted, pointed };
}

/** Shows the GLB of each run that has one. `shown` is what is seen, `stones` how many of it can be lifted. */
function useGlb(field: Signal<Field | null>, changed: () => void) {
  const shown = useSignal<Blob | undefined>(undefined);
  const stones = useSignal(0);
  const wanted = useRef<Blob | undefined>(undefined);
  const show = async (blob: Blob, target: Field) => {
    const count = await target.show(await blob.arrayBuffer());
    if (wanted.current !== blob) return;
    stones.value = count;
    shown.value = blob;
    changed();
  };
  useSignalEffect(() => {
    const blob = outcome.value?.files['glb']?.blob;
    const target = field.value;
    if (!blob || !target || wanted.current === blob) return;
    wanted.current = blob;
    void show(blob, target);
  });
  return { shown, stones };
}

const kWords: Readonly<Record<Exclude<State, 'ready'>, string>> = {
  loading: 'Loading the view',
  missing:
    'This browser does not show 3D: it needs WebGL2, which may be switched off. Everything else works, and the GLB ' +
    'opens in any 3D program.',
  lost: 'The graphics card has given up on this view. Load the page again; everything else goes on working.',
};

/** What draws here. Throws where nothing does, without the complaints that three.js has then on the console. */
function rendererName(): string {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context) throw new Error('there is no WebGL2');
  const names = context.getExtension('WEBGL_debug_renderer_info');
  const name = String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

function inks(): Pick<FieldLook, 'accent' | 'ground'> {
  const style = getComputedStyle(document.documentElement);
  const ink = (name: string) => style.getPropertyValue(name).trim();
  return { accent: ink('--accent'), ground: ink('--field-ground') };
}

function onKey(event: KeyboardEvent, field: Field, choose: (id: number | null) => void): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const actions: Record<string, () => void> = {
    ArrowLeft: () => field.turn(-kTurn, 0),
    ArrowRight: () => field.turn(kTurn, 0),
    ArrowUp: () => field.turn(0, -kTurn),
    ArrowDown: () => field.turn(0, kTurn),
    '+': () => field.zoom(1.2),
    '=': () => field.zoom(1.2),
    '-': () => field.zoom(1 / 1.2),
    '0': () => field.fit(),
    n: () => choose(field.chooseNext(1)),
    b: () => choose(field.chooseNext(-1)),
    Enter: () => field.press(),
    ' ': () => field.press(),
    Escape: () => field.settle(),
  };
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

function FieldTools({ look }: { look: Signal<Look> }) {
  const detail = fields.value.find(({ key }) => key === 'lod');
  const set = (part: Partial<Look>) => (look.value = { ...look.value, ...part });
  const { texture, wireframe, light } = look.value;
  const hasGround = params.value['ground'] === true;
  const switchGround = () => changeValues({ ground: !hasGround, groundHole: !hasGround });
  return (
    <div class="field-tools tool-group" role="toolbar" aria-label="Field">
      <IconTool title="Texture" on={texture} Icon={Image} act={() => set({ texture: !texture })} />
      <IconTool title="Wireframe" on={wireframe} Icon={Grid3x3} act={() => set({ wireframe: !wireframe })} />
      <IconTool
        title="Ground"
        hint="The photo's ground, without its pebbles"
        on={hasGround}
        Icon={Mountain}
        act={switchGround}
      />
      <IconTool title="Turn the light" Icon={Sun} act={() => set({ light: light + kLight })} />
      {detail?.kind === 'number' && (
        <label class="field-detail" title={detail.help}>
          <Box size={16} aria-hidden />
          <select
            aria-label="Detail"
            value={Number(params.value['lod'] ?? detail.fallback)}
            onChange={(event) => changeValue(detail, Number(event.currentTarget.value))}
          >
            {['finest', 'fine', 'coarse', 'coarsest'].map((word, lod) => (
              <option key={word} value={lod}>
                {word}
              </option>
            ))}
          </select>
        </label>
      )}
    </div>
  );
}

function FieldZoom({ field, lifted }: { field: Field | null; lifted: number }) {
  return (
    <div class="field-zoom tool-group" role="group" aria-label="View of the field">
      {lifted > 0 && (
        <button type="button" class="tool" title="Every pebble back into its place" onClick={() => field?.settle()}>
          <RotateCcw size={17} aria-hidden />
          Put back
        </button>
      )}
      <IconTool title="Farther" hint="Farther (−)" Icon={Minus} act={() => field?.zoom(1 / 1.3)} />
      <IconTool title="Nearer" hint="Nearer (+)" Icon={Plus} act={() => field?.zoom(1.3)} />
      <IconTool title="Fit the field" hint="Fit (0)" Icon={Maximize} act={() => field?.fit()} />
    </div>
  );
}

function FieldLabel({ pointed, lifted }: { pointed: number | null; lifted: readonly number[] }) {
  const [last] = lifted;
  const words =
    pointed !== null && !lifted.includes(pointed)
      ? `pebble ${pointed}: press to take it out`
      : last !== undefined
        ? `pebble ${pointed ?? last} is out: drag it, press to put it back`
        : '';
  return (
    <p class="field-label" role="status" hidden={!words}>
      {words}
    </p>
  );
}
