import { useSignal } from '@preact/signals';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { simplified, smoothPath } from '../stage/curve';
import { toPicture, type Point } from '../stage/view';
import { view, zoom } from '../stage/viewport';
import type { Guide } from '../state/drawn';
import { changeDrawn, endStep, undo } from '../state/edits';
import { drawn } from '../state/store';
import { counted } from '../techniques/facts';
import { moveCursor, placeIn, startCursor } from './cursor';
import { ToolEnds } from './ToolBar';

const kTolerance = 3; // CSS px that a curve may leave the hand's line
const kShortest = 6; // CSS px; less is a slip of the hand

const setGuides = (guides: readonly Guide[], key = '') => changeDrawn({ guides }, key);

/** Curves that rows of tiles follow: drawn by hand and smoothed, with points to drag; or set point by point with keys. */
export function Guides() {
  const box = useRef<HTMLDivElement>(null);
  const hand = useSignal<readonly Point[]>([]); // the line that is being drawn
  const keyed = useSignal<readonly Point[]>([]); // the points that keys have set so far
  const cursor = useSignal<Point | null>(null);
  const grip = useRef<{ guide: number; point: number } | null>(null); // that is being dragged
  const { guides } = drawn.value;
  const { scale, x, y } = view.value;

  useLayoutEffect(() => box.current?.focus({ preventScroll: true }), []);

  const onDown = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    cursor.value = null;
    const { guide, point } = (event.target as SVGElement).dataset;
    if (guide && point) grip.current = { guide: Number(guide), point: Number(point) };
    else hand.value = [toPicture(view.value, placeIn(event))];
  };
  const onMove = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    const at = toPicture(view.value, placeIn(event));
    const { current } = grip;
    if (current) setGuides(withPoint(guides, current.guide, current.point, at), 'guides');
    else if (hand.value.length) hand.value = [...hand.value, at];
  };
  const onUp = () => {
    if (grip.current) endStep();
    grip.current = null;
    const line = simplified(hand.value, kTolerance / scale);
    if (reach(hand.value) * scale >= kShortest) setGuides([...guides, line]);
    hand.value = [];
  };
  const endKeyed = () => {
    if (keyed.value.length > 1) setGuides([...guides, keyed.value]);
    keyed.value = [];
  };
  const onKey = (event: KeyboardEvent) => {
    const moved = moveCursor(cursor.value, event.key, event.shiftKey);
    if (moved) cursor.value = moved;
    else if (event.key === ' ') keyed.value = [...keyed.value, (cursor.value ??= startCursor())];
    else if (event.key === 'Enter') endKeyed();
    else if (event.key === 'Escape') keyed.value = [];
    else if (event.key !== 'Backspace' && event.key !== 'Delete') return;
    else if (keyed.value.length) keyed.value = keyed.value.slice(0, -1);
    else setGuides(guides.slice(0, -1));
    event.preventDefault();
  };
  const drawing = hand.value.length ? hand.value : [...keyed.value, ...(cursor.value ? [cursor.value] : [])];
  const toStage = (p: Point): Point => ({ x: p.x * scale + x, y: p.y * scale + y });
  const pathOf = (points: readonly Point[]) => smoothPath(points.map(toStage));
  return (
    <>
      <div
        ref={box}
        class="sketch guides"
        role="application"
        tabIndex={0}
        aria-label={
          'Guide curves. Arrow keys move the cursor, space sets a point, Enter ends the curve, ' +
          'Backspace takes back the last point or curve.'
        }
        onPointerDown={onDown}
        onPointerMove={onMove}
        onPointerUp={onUp}
        onPointerCancel={onUp}
        onKeyDown={onKey}
        onWheel={(event) => {
          event.preventDefault();
          zoom(placeIn(event), Math.exp(-event.deltaY * 0.0018));
        }}
      >
        <svg aria-hidden="true">
          {guides.map((guide, i) => (
            <g key={i}>
              <path class="guide-halo" d={pathOf(guide)} />
              <path class="guide" d={pathOf(guide)} />
            </g>
          ))}
          {drawing.length > 1 && <path class="guide going" d={pathOf(drawing)} />}
          {guides.map((guide, i) =>
            guide.map((point, k) => {
              const { x: cx, y: cy } = toStage(point);
              return (
                <circle key={`${i} ${k}`} class="guide-grip" cx={cx} cy={cy} r={5} data-guide={i} data-point={k} />
              );
            }),
          )}
          {keyed.value.map((point, k) => (
            <circle key={k} class="guide-grip" cx={toStage(point).x} cy={toStage(point).y} r={5} />
          ))}
          {cursor.value && <Cross at={toStage(cursor.value)} />}
        </svg>
      </div>
      <div class="sketch-tools tool-group" role="toolbar" aria-label="Guide curves">
        <span class="tool-words" role="status">
          {guides.length ? counted(guides.length, 'curves') : 'Draw where rows of tiles should run'}
        </span>
        <ToolEnds
          undoTitle="Undo"
          clearTitle="Clear all curves"
          empty={guides.length === 0}
          undo={undo}
          clear={() => setGuides([])}
        />
      </div>
    </>
  );
}

const Cross = ({ at: { x, y } }: { at: Point }) => (
  <path class="guide-cursor" d={`M${x - 12} ${y}H${x + 12}M${x} ${y - 12}V${y + 12}`} />
);

const withPoint = (guides: readonly Guide[], guide: number, point: number, at: Point): Guide[] =>
  guides.map((points, i) => (i === guide ? points.map((p, k) => (k === point ? at : p)) : points));

/** How far a line gets from where it begins. */
function reach([first, ...others]: readonly Point[]): number {
  return first ? Math.max(0, ...others.map((p) => Math.hypot(p.x - first.x, p.y - first.y))) : 0;
}
