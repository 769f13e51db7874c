import { useSignal } from '@preact/signals';
import { kEdgeInks } from '../state/drawn';
import { changeDrawn, undo } from '../state/edits';
import { drawn, picture } from '../state/store';
import { drawStroke } from '../state/strokes';
import { BrushSheet } from './BrushSheet';
import { GridLines } from './GridSheet';
import { BrushSizes, kPictureBrushes, ToolEnds, ToolGap } from './ToolBar';

/** A brush that says which edges of the picture the grid follows. */
export function EdgesSheet() {
  const ink = useSignal<string>(kEdgeInks[0].colour);
  const brush = useSignal(kPictureBrushes[1].width);
  if (!picture.value) return null;
  const { width, height } = picture.value;
  return (
    <>
      <div class="edge-lines">
        <GridLines faint />
      </div>
      <div class="regions">
        <BrushSheet
          size={{ width, height }}
          ink={{ width: Math.max(1, Math.round(brush.value * Math.min(width, height))), colour: ink.value }}
          label="Edges that count"
          paint={(context) => drawn.value.edgeMask.forEach((stroke) => drawStroke(context, stroke))}
          onStroke={(stroke) => changeDrawn({ edgeMask: [...drawn.value.edgeMask, stroke] })}
        />
      </div>
      <div class="sketch-tools tool-group" role="toolbar" aria-label="Edges that count">
        {kEdgeInks.map(({ title, hint, colour }) => (
          <button
            type="button"
            class="tool"
            key={colour}
            aria-pressed={ink.value === colour}
            title={hint}
            onClick={() => (ink.value = colour)}
          >
            <span class="region-dot" style={{ background: colour }} />
            {title}
          </button>
        ))}
        <ToolGap />
        <BrushSizes brushes={kPictureBrushes} chosen={brush.value} choose={(part) => (brush.value = part)} />
        <ToolEnds
          undoTitle="Undo"
          clearTitle="Clear the mask"
          empty={drawn.value.edgeMask.length === 0}
          undo={undo}
          clear={() => changeDrawn({ edgeMask: [] })}
        />
      </div>
    </>
  );
}
