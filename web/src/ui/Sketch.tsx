import { Brush, Eraser } from 'lucide-preact';
import { outcome } from '../state/store';
import { addStroke, brush, clearSheet, erasing, kBrushes, kSheet, strokes, undoStroke } from '../state/sketch';
import { BrushSheet } from './BrushSheet';
import { BrushSizes, ToolEnds, ToolGap } from './ToolBar';

/** A clear sheet over the stage: what is drawn on it shows until the stones have taken it up. */
export function Sketch() {
  return (
    <>
      <BrushSheet
        size={kSheet}
        ink={{ width: brush.value, colour: erasing.value ? '#fff' : '#000' }}
        label="Sheet to draw on"
        paint={() => void outcome.value}
        onStroke={addStroke}
      />
      <SketchTools />
    </>
  );
}

function SketchTools() {
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
      <ToolGap />
      <BrushSizes brushes={kBrushes} chosen={brush.value} choose={(width) => (brush.value = width)} />
      <ToolEnds
        undoTitle="Take back the last stroke"
        clearTitle="Clear the sheet"
        empty={strokes.value.length === 0}
        undo={undoStroke}
        clear={clearSheet}
      />
    </div>
  );
}
