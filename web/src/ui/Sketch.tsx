import { useSignalEffect } from '@preact/signals';
import { Brush, Check, Eraser, Trash2, Undo2 } from 'lucide-preact';
import { useRef } from 'preact/hooks';
import { outcome, sketching } from '../state/store';
import {
  addStroke,
  brush,
  clearSheet,
  drawStroke,
  erasing,
  kBrushes,
  kSheet,
  strokes,
  undoStroke,
  type Stroke,
} from '../state/sketch';
import { toPicture, type Point } from '../stage/view';
import { view, zoom } from '../stage/viewport';

/** A clear sheet over the stage: what is drawn on it shows until the stones have taken it up. */
export function Sketch() {
  return (
    <>
      <SketchSheet />
      <SketchTools />
    </>
  );
}

function SketchSheet() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const points = useRef<Point[] | null>(null);
  const box = useRef<HTMLDivElement>(null);

  useSignalEffect(() => {
    void outcome.value; // holds the strokes now
    if (!points.current) canvas.current?.getContext('2d')?.clearRect(0, 0, kSheet.width, kSheet.height);
  });
  const within = (event: MouseEvent): Point => {
    const { left = 0, top = 0 } = box.current?.getBoundingClientRect() ?? {};
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const current = (part: readonly Point[]): Stroke => ({ width: brush.value, erase: erasing.value, points: part });
  const extend = (event: PointerEvent) => {
    const context = canvas.current?.getContext('2d');
    if (!points.current || !context) return;
    points.current.push(toPicture(view.value, within(event)));
    drawStroke(context, current(points.current.slice(-2)));
  };
  const finish = () => {
    if (points.current) addStroke(current(points.current));
    points.current = null;
  };
  const { scale, x, y } = view.value;
  return (
    <div
      ref={box}
      class="sketch"
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        points.current = [];
        extend(event);
      }}
      onPointerMove={extend}
      onPointerUp={finish}
      onPointerCancel={finish}
      onWheel={(event) => {
        event.preventDefault();
        zoom(within(event), Math.exp(-event.deltaY * 0.0018));
      }}
    >
      <canvas
        ref={canvas}
        width={kSheet.width}
        height={kSheet.height}
        style={{ transform: `translate(${x}px, ${y}px) scale(${scale})` }}
      />
    </div>
  );
}

function SketchTools() {
  const empty = strokes.value.length === 0;
  return (
    <div class="sketch-tools tool-group" role="toolbar" aria-label="Brush">
      <button type="button" class="tool" aria-pressed={!erasing.value} onClick={() => (erasing.value = false)}>
        <Brush size={18} aria-hidden />
        Brush
      </button>
      <button type="button" class="tool" aria-pressed={erasing.value} onClick={() => (erasing.value = true)}>
        <Eraser size={18} aria-hidden />
        Eraser
      </button>
      <span class="tool-gap" />
      {kBrushes.map(({ title, width }) => (
        <button
          type="button"
          class="tool"
          key={width}
          aria-label={title}
          title={title}
          aria-pressed={brush.value === width}
          onClick={() => (brush.value = width)}
        >
          <span class="brush-dot" style={{ width: `${4 + width / 5}px`, height: `${4 + width / 5}px` }} />
        </button>
      ))}
      <span class="tool-gap" />
      <button
        type="button"
        class="tool"
        aria-label="Take back the last stroke"
        aria-disabled={empty}
        onClick={undoStroke}
      >
        <Undo2 size={18} aria-hidden />
      </button>
      <button type="button" class="tool" aria-label="Clear the sheet" aria-disabled={empty} onClick={clearSheet}>
        <Trash2 size={18} aria-hidden />
      </button>
      <span class="tool-gap" />
      <button type="button" class="tool strong" onClick={() => (sketching.value = false)}>
        <Check size={18} aria-hidden />
        Done
      </button>
    </div>
  );
}
