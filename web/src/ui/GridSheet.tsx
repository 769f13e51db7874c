import { useSignalEffect } from '@preact/signals';
import { PinOff } from 'lucide-preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { toPicture, type Point } from '../stage/view';
import { stageSize, view, zoom } from '../stage/viewport';
import { undo } from '../state/edits';
import {
  chosen,
  drag,
  dragged,
  grid,
  gridEdges,
  isLaid,
  laidPins,
  lay,
  leaveDrag,
  placeOf,
  release,
  releaseAll,
  vertexAt,
} from '../state/live-grid';
import type { Vertex } from '../state/pins';
import { picture } from '../state/store';
import { shade } from '../state/theme';
import { counted } from '../techniques/facts';
import { moved, placeIn } from './cursor';
import { IconTool, ToolEnds, ToolGap } from './ToolBar';

const kReach = 16; // CSS px from a vertex that a press may be
const kSlip = 3; // CSS px that a hand may tremble without dragging

const number = new Intl.NumberFormat('en', { maximumFractionDigits: 1 });

/** Pixels of the picture to a millimetre. */
function perMm(): Point {
  const { widthMm = 1, heightMm = 1 } = grid.value ?? {};
  return { x: (picture.value?.width ?? 1) / widthMm, y: (picture.value?.height ?? 1) / heightMm };
}

function toStage(mm: Point): Point {
  const { scale, x, y } = view.value;
  const per = perMm();
  return { x: mm.x * per.x * scale + x, y: mm.y * per.y * scale + y };
}

function toMm(at: Point): Point {
  const per = perMm();
  const p = toPicture(view.value, at);
  return { x: p.x / per.x, y: p.y / per.y };
}

/** The grid over the picture: its corners are dragged by the pointer, or by keys, and the rest relaxes. */
export function GridSheet() {
  const box = useRef<HTMLDivElement>(null);
  const grip = useRef<{ vertex: Vertex; from: Point; moved: boolean } | null>(null);

  useLayoutEffect(() => box.current?.focus({ preventScroll: true }), []);

  const onDown = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    const from = placeIn(event);
    const vertex = vertexAt(toMm(from), kReach / (perMm().x * view.value.scale));
    chosen.value = vertex;
    grip.current = vertex && { vertex, from, moved: false };
  };
  const onMove = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    const { current } = grip;
    if (!current) return;
    const at = placeIn(event);
    current.moved ||= Math.hypot(at.x - current.from.x, at.y - current.from.y) > kSlip;
    if (current.moved) drag(current.vertex, toMm(at));
  };
  const onUp = () => {
    if (grip.current?.moved) void lay();
    grip.current = null;
  };
  const { across = 1, down = 1 } = grid.value ?? {};
  const onKey = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !grid.value) return;
    const { value: vertex } = chosen;
    const { value: taken } = dragged;
    if (event.key.startsWith('Arrow')) {
      if (taken) moveTaken(event);
      else chosen.value = neighbour(vertex, event.key, across, down);
    } else if ((event.key === ' ' || event.key === 'Enter') && vertex) {
      if (taken) void lay();
      else drag(vertex, placeOf(vertex));
    } else if ((event.key === 'Delete' || event.key === 'Backspace') && vertex && isLaid(vertex)) release(vertex);
    else if (event.key === 'Escape' && taken) leaveDrag();
    else return;
    event.preventDefault();
  };
  return (
    <>
      <div
        ref={box}
        class="sketch grid-sheet"
        role="application"
        tabIndex={0}
        aria-label={
          'Grid. Arrow keys choose a corner, space takes it up and lays it down, arrow keys move it meanwhile, ' +
          'Escape leaves it, Delete lets a laid corner go.'
        }
        data-at-rest={grid.value?.atRest ?? false}
        onKeyDown={onKey}
        onPointerDown={onDown}
        onPointerMove={onMove}
        onPointerUp={onUp}
        onPointerCancel={onUp}
        onDblClick={() => chosen.value && isLaid(chosen.value) && release(chosen.value)}
        onWheel={(event) => {
          event.preventDefault();
          zoom(placeIn(event), Math.exp(-event.deltaY * 0.0018));
        }}
      >
        <GridLines />
        <Corners />
      </div>
      <GridTools />
    </>
  );
}

/** With shift far. */
function moveTaken({ key, shiftKey }: KeyboardEvent): void {
  const { value: taken } = dragged;
  const { value: shown } = grid;
  if (!taken || !shown) return;
  const size = { width: shown.widthMm, height: shown.heightMm };
  const next = moved(taken, key, shiftKey, perMm().x * view.value.scale, size);
  if (next) drag(taken, next);
}

function neighbour(vertex: Vertex | null, key: string, across: number, down: number): Vertex {
  if (!vertex) return { column: Math.floor(across / 2), row: Math.floor(down / 2) };
  const within = (value: number, most: number) => Math.min(most, Math.max(0, value));
  const dx = Number(key === 'ArrowRight') - Number(key === 'ArrowLeft');
  const dy = Number(key === 'ArrowDown') - Number(key === 'ArrowUp');
  const next = { column: within(vertex.column + dx, across), row: within(vertex.row + dy, down) };
  const fixed = (next.column === 0 || next.column === across) && (next.row === 0 || next.row === down);
  return fixed ? vertex : next;
}

/** Lines between the corners, and the edges that they follow; also under the brush for these. */
export function GridLines({ faint = false }: { faint?: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useSignalEffect(() => {
    const { width, height } = stageSize.value;
    // Drawn by the processor: thousands of thin lines are what software in the place of a graphics card is slowest at.
    const context = canvas.current?.getContext('2d', { willReadFrequently: true });
    if (!canvas.current || !context) return;
    const ratio = devicePixelRatio;
    canvas.current.width = Math.round(width * ratio);
    canvas.current.height = Math.round(height * ratio);
    context.scale(ratio, ratio);
    drawEdges(context, faint ? 1 : 0.55);
    context.globalAlpha = 0.7;
    if (!faint) drawLines(context, 4, colourOf('--raised', shade.value));
    context.globalAlpha = 1;
    drawLines(context, faint ? 1 : 1.6, colourOf('--accent', shade.value));
  });
  const { width, height } = stageSize.value;
  return (
    <canvas
      ref={canvas}
      class="grid-lines"
      aria-hidden="true"
      style={{ width: `${width}px`, height: `${height}px` }}
    />
  );
}

/** Of the styles, which follow the shade. */
const colourOf = (name: string, _: unknown) =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function drawLines(context: CanvasRenderingContext2D, width: number, colour: string): void {
  const { value: shown } = grid;
  if (!shown) return;
  const { across, down } = shown;
  const to = (column: number, row: number) => toStage(placeOf({ column, row }));
  context.beginPath();
  for (let row = 0; row <= down; ++row)
    for (let column = 0; column <= across; ++column) {
      const { x, y } = to(column, row);
      if (column === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
  for (let column = 0; column <= across; ++column)
    for (let row = 0; row <= down; ++row) {
      const { x, y } = to(column, row);
      if (row === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.lineJoin = 'round';
  context.stroke();
}

function drawEdges(context: CanvasRenderingContext2D, opacity: number): void {
  const { value: edges } = gridEdges;
  const { value: shown } = grid;
  if (!edges || !shown) return;
  const [from, to] = [toStage({ x: 0, y: 0 }), toStage({ x: shown.widthMm, y: shown.heightMm })];
  context.globalAlpha = opacity;
  context.drawImage(edges, from.x, from.y, to.x - from.x, to.y - from.y);
  context.globalAlpha = 1;
}

/** Those that were laid, and the one that is chosen. */
function Corners() {
  const { value: vertex } = chosen;
  if (!grid.value) return null;
  const at = vertex && toStage(placeOf(vertex));
  return (
    <svg aria-hidden="true">
      {laidPins().map(({ column, row }) => {
        const { x, y } = toStage(placeOf({ column, row }));
        return <circle key={`${column},${row}`} class="grid-pin" cx={x} cy={y} r={5} data-pin={`${column},${row}`} />;
      })}
      {at && <circle class="grid-chosen" cx={at.x} cy={at.y} r={9} data-taken={dragged.value !== null} />}
    </svg>
  );
}

function GridTools() {
  const laid = laidPins().length;
  const { value: vertex } = chosen;
  return (
    <div class="sketch-tools tool-group" role="toolbar" aria-label="Grid">
      <span class="tool-words grid-words" role="status">
        {vertex && grid.value ? wordsOn(vertex) : laid ? counted(laid, 'corners laid') : 'Drag corners of the grid'}
      </span>
      <ToolGap />
      <IconTool
        title="Let the corner go"
        hint="Let the chosen corner go where the grid takes it (Delete)"
        Icon={PinOff}
        off={!vertex || !isLaid(vertex)}
        act={() => vertex && release(vertex)}
      />
      <ToolEnds undoTitle="Undo" clearTitle="Let all corners go" empty={laid === 0} undo={undo} clear={releaseAll} />
    </div>
  );
}

/** "Corner 3, 4: 12.5 × 40 mm, laid" */
function wordsOn(vertex: Vertex): string {
  const { x, y } = placeOf(vertex);
  const state = dragged.value ? ', taken up' : isLaid(vertex) ? ', laid' : '';
  return `Corner ${vertex.column}, ${vertex.row}: ${number.format(x)} × ${number.format(y)} mm${state}`;
}
