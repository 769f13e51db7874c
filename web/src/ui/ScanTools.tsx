import { signal, useSignal } from '@preact/signals';
import { Brush, Check, CircleDot, Eraser, Search, Trash2, Undo2 } from 'lucide-preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import type { PanelFile } from '../state/drawn';
import { undo } from '../state/edits';
import { kNoWoodColour, kWoodColour, toggledMark } from '../state/masks';
import { correctMask, found, marksOf, ownMarks, panels, setMarks } from '../state/panels';
import type { Point, Size } from '../stage/view';
import { moved } from './cursor';
import { BrushSizes, IconTool, ToolGap } from './ToolBar';

const kBrushes = [
  { title: 'Thin brush', width: 0.03 },
  { title: 'Medium brush', width: 0.08 },
  { title: 'Broad brush', width: 0.2 },
]; // in parts of the scan's shorter side
const kLeastReach = 0.02; // the same, of a click to a mark

/** What the pointer corrects on the scans: where there is wood, or where the marks are. */
export const scanTool = signal<'mask' | 'marks' | null>(null);
const colour = signal(kNoWoodColour);
const brush = signal(kBrushes[1]!.width);

const toggle = (name: 'mask' | 'marks') => (scanTool.value = scanTool.value === name ? null : name);

/** Beside the wood: a brush for the masks, and the marks. */
export function ScanTools() {
  const { value: name } = scanTool;
  return (
    <>
      <IconTool
        title="Mask"
        hint="Correct where there is wood, with a brush"
        Icon={Brush}
        on={name === 'mask'}
        act={() => toggle('mask')}
      />
      <IconTool
        title="Marks"
        hint="Confirm, remove and add the marks for the machine"
        Icon={CircleDot}
        on={name === 'marks'}
        act={() => toggle('marks')}
      />
      {name === 'mask' && <MaskTools />}
      {name === 'marks' && <MarkTools />}
    </>
  );
}

function MaskTools() {
  const touched = panels().filter(({ strokes }) => strokes.length > 0);
  const ink = (title: string, hint: string, Icon: typeof Brush, of: string) => (
    <IconTool title={title} hint={hint} Icon={Icon} on={colour.value === of} act={() => (colour.value = of)} />
  );
  return (
    <>
      <ToolGap />
      {ink('Wood', 'Paint wood', Brush, kWoodColour)}
      {ink('No wood', 'Paint what may not be cut', Eraser, kNoWoodColour)}
      <BrushSizes brushes={kBrushes} chosen={brush.value} choose={(part) => (brush.value = part)} />
      <IconTool title="Undo stroke" Icon={Undo2} off={!touched.length} act={undo} />
      <IconTool
        title="Clear strokes"
        Icon={Trash2}
        off={!touched.length}
        act={() => touched.forEach((panel) => correctMask(panel, null))}
      />
    </>
  );
}

function MarkTools() {
  const unsure = panels().filter((panel) => !ownMarks(panel) && found(panel)?.marks.length);
  const own = panels().filter((panel) => ownMarks(panel));
  return (
    <>
      <ToolGap />
      <IconTool
        title="Confirm marks"
        hint="Take the marks that were found"
        Icon={Check}
        off={!unsure.length}
        act={() => unsure.forEach((panel) => setMarks(panel, marksOf(panel)))}
      />
      <IconTool
        title="Find marks"
        hint="Take those that are found, not these"
        Icon={Search}
        off={!own.length}
        act={() => own.forEach((panel) => setMarks(panel, null))}
      />
    </>
  );
}

interface Props {
  panel: PanelFile;
  /** Its size, px. */
  scan: Size;
  /** mm to a pixel of it. */
  scale: number;
}

const lineOf = (points: readonly Point[]) => {
  const [first] = points;
  return first ? `M${[first, ...points].map(({ x, y }) => `${x} ${y}`).join('L')}` : '';
};

/** What may not be cut, shaded. */
export function NoWood({ panel, scan: { width, height }, scale }: Props) {
  const mask = found(panel);
  if (!mask) return null;
  const id = `no-wood-${panel.name}`;
  return (
    <g transform={`scale(${scale})`}>
      <mask id={id} maskUnits="userSpaceOnUse" x={0} y={0} width={width} height={height}>
        <image href={mask.address} width={width} height={height} preserveAspectRatio="none" />
        {panel.strokes.map(({ colour: ink, width: broad, points }) => (
          <path
            d={lineOf(points)}
            fill="none"
            stroke={ink === kWoodColour ? '#000' : '#fff'}
            stroke-width={broad}
            stroke-linecap="round"
            stroke-linejoin="round"
          />
        ))}
      </mask>
      <rect class="no-wood" width={width} height={height} mask={`url(#${id})`} />
    </g>
  );
}

/** Over a scan while it is corrected: with mouse, pen and finger, or with the arrow keys and space. */
export function ScanToolSheet({ panel, scan, scale }: Props) {
  const box = useRef<SVGRectElement>(null);
  const line = useSignal<readonly Point[] | null>(null);
  const cursor = useSignal<Point | null>(null);
  const { value: name } = scanTool;
  useLayoutEffect(() => {
    line.value = null;
    if (panel === panels()[0]) box.current?.focus({ preventScroll: true });
  }, [name]);
  const side = Math.min(scan.width, scan.height);
  const width = Math.max(1, brush.value * side);
  const placeOf = (event: PointerEvent): Point | null => {
    const matrix = box.current?.getScreenCTM();
    if (!matrix) return null;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    return { x: x / scale, y: y / scale };
  };
  const put = (at: Point) => {
    if (name === 'mask') line.value = [at];
    else setMarks(panel, toggledMark(marksOf(panel), at, Math.max(found(panel)?.markPx ?? 0, kLeastReach * side)));
  };
  const finish = () => {
    if (line.value) correctMask(panel, { colour: colour.value, width, points: line.value });
    line.value = null;
  };
  const onKey = (event: KeyboardEvent) => {
    const at = cursor.value ?? { x: scan.width / 2, y: scan.height / 2 };
    const pixel = (box.current?.getBoundingClientRect().width ?? scan.width) / scan.width;
    const next = moved(at, event.key, event.shiftKey, pixel, scan);
    if (next) {
      cursor.value = next;
      if (line.value) line.value = [...line.value, next];
    } else if (event.key === ' ') {
      cursor.value = at;
      if (line.value) finish();
      else put(at);
    } else if (event.key === 'Escape') scanTool.value = null;
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const what = name === 'mask' ? 'space puts the brush down and takes it up' : 'space sets a mark or takes it away';
  return (
    <>
      {line.value && (
        <path
          class="scan-stroke"
          d={lineOf(line.value.map(({ x, y }) => ({ x: x * scale, y: y * scale })))}
          data-wood={colour.value === kWoodColour}
          stroke-width={width * scale}
        />
      )}
      {cursor.value && (
        <circle
          class="scan-cursor"
          cx={cursor.value.x * scale}
          cy={cursor.value.y * scale}
          r={((name === 'mask' ? width : kLeastReach * side) * scale) / 2}
        />
      )}
      <rect
        ref={box}
        class="scan-tool"
        width={scan.width * scale}
        height={scan.height * scale}
        tabindex={0} // as SVG spells it
        role="application"
        aria-label={`${name === 'mask' ? 'Mask' : 'Marks'} of ${panel.name}. Arrow keys move, ${what}, Escape ends.`}
        onKeyDown={onKey}
        onClick={(event) => event.stopPropagation()}
        onPointerDown={(event) => {
          const at = event.button === 0 && placeOf(event);
          if (!at) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          cursor.value = null;
          put(at);
        }}
        onPointerMove={(event) => {
          const at = line.value && cursor.value === null && placeOf(event);
          if (at && line.value) line.value = [...line.value, at];
        }}
        onPointerUp={() => cursor.value ?? finish()}
        onPointerCancel={() => cursor.value ?? finish()}
      />
    </>
  );
}
