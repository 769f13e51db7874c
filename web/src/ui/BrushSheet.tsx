import { useSignal, useSignalEffect } from '@preact/signals';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { drawStroke, type Context2D, type Ink, type Stroke } from '../state/strokes';
import { toPicture, type Point, type Size } from '../stage/view';
import { view, zoom } from '../stage/viewport';
import { moveCursor, placeIn, startCursor } from './cursor';

interface Props {
  /** What is drawn on, px. */
  size: Size;
  ink: Ink;
  label: string;
  /** What is seen of the strokes before; called again whenever a signal that it reads changes. */
  paint(context: Context2D): void;
  onStroke(stroke: Stroke): void;
}

/** A clear sheet over the stage for a brush: with mouse, pen and finger, or with the arrow keys and space. */
export function BrushSheet({ size, ink, label, paint, onStroke }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const points = useRef<Point[] | null>(null);
  const cursor = useSignal<Point | null>(null);
  const down = useSignal(false); // the brush of the keyboard

  useLayoutEffect(() => box.current?.focus({ preventScroll: true }), []);
  useSignalEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (!context) return;
    context.clearRect(0, 0, size.width, size.height);
    paint(context);
    if (points.current) drawStroke(context, { ...ink, points: points.current });
  });
  const extend = (at: Point) => {
    const context = canvas.current?.getContext('2d');
    if (!points.current || !context) return;
    points.current.push(at);
    drawStroke(context, { ...ink, points: points.current.slice(-2) });
  };
  const finish = () => {
    const stroke = points.current;
    points.current = null;
    down.value = false;
    if (stroke?.length) onStroke({ ...ink, points: stroke });
  };
  const onKey = (event: KeyboardEvent) => {
    const moved = moveCursor(cursor.value, event.key, event.shiftKey);
    if (moved) {
      cursor.value = moved;
      extend(moved);
    } else if (event.key === ' ') {
      if (points.current) finish();
      else {
        points.current = [];
        down.value = true;
        extend((cursor.value ??= startCursor()));
      }
    } else if (event.key === 'Enter' && points.current) finish();
    else return;
    event.preventDefault();
  };
  const { scale, x, y } = view.value;
  const side = ink.width * scale;
  return (
    <div
      ref={box}
      class="sketch"
      role="application"
      tabIndex={0}
      aria-label={`${label}. Arrow keys move the brush, space puts it down and takes it up.`}
      onKeyDown={onKey}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        cursor.value = null;
        points.current = [];
        extend(toPicture(view.value, placeIn(event)));
      }}
      onPointerMove={(event) => cursor.value ?? extend(toPicture(view.value, placeIn(event)))}
      onPointerUp={finish}
      onPointerCancel={finish}
      onWheel={(event) => {
        event.preventDefault();
        zoom(placeIn(event), Math.exp(-event.deltaY * 0.0018));
      }}
    >
      <canvas
        ref={canvas}
        width={size.width}
        height={size.height}
        style={{ transform: `translate(${x}px, ${y}px) scale(${scale})` }}
      />
      {cursor.value && (
        <span
          class="brush-cursor"
          data-down={down.value}
          style={{
            left: `${cursor.value.x * scale + x}px`,
            top: `${cursor.value.y * scale + y}px`,
            width: `${side}px`,
            height: `${side}px`,
          }}
        />
      )}
    </div>
  );
}
