import { useSignal } from '@preact/signals';
import { kRegions } from '../state/drawn';
import { changeDrawn, undo } from '../state/edits';
import { drawn, fields, params, picture } from '../state/store';
import { valueOf } from '../state/form';
import { drawStroke } from '../state/strokes';
import { BrushSheet } from './BrushSheet';
import { BrushSizes, kPictureBrushes, ToolEnds, ToolGap } from './ToolBar';

/** How large the tiles are where a colour is, as the parameter says: "#0000ff=1.6 #00ff00=1". */
function sizeOf(colour: string): string | undefined {
  const field = fields.value.find(({ key }) => key === 'regionSizes');
  const text = field ? String(valueOf(field, params.value)) : '';
  return new RegExp(`${colour}\\s*=\\s*([\\d.]+)`, 'i').exec(text)?.[1];
}

/** A brush that says where tiles are large and where small; what it leaves out is figure. */
export function Regions() {
  const region = useSignal(kRegions.length - 1);
  const brush = useSignal(kPictureBrushes[1].width);
  if (!picture.value) return null;
  const { width, height } = picture.value;
  const colour = kRegions[region.value]!.colour;
  const { regions } = drawn.value;
  return (
    <>
      <div class="regions">
        <BrushSheet
          size={{ width, height }}
          ink={{ width: Math.max(1, Math.round(brush.value * Math.min(width, height))), colour }}
          label="Sizes of the tiles"
          paint={(context) => drawn.value.regions.forEach((stroke) => drawStroke(context, stroke))}
          onStroke={(stroke) => changeDrawn({ regions: [...drawn.value.regions, stroke] })}
        />
      </div>
      <div class="sketch-tools tool-group" role="toolbar" aria-label="Sizes of the tiles">
        {kRegions.map(({ title, colour: ink }, i) => (
          <button
            type="button"
            class="tool"
            key={ink}
            aria-pressed={region.value === i}
            title={`${title}: tiles of ${sizeOf(ink) ?? '1'} times the usual side`}
            onClick={() => (region.value = i)}
          >
            <span class="region-dot" style={{ background: ink }} />
            {title}
            {sizeOf(ink) && <span class="tool-figure">×{sizeOf(ink)}</span>}
          </button>
        ))}
        <ToolGap />
        <BrushSizes brushes={kPictureBrushes} chosen={brush.value} choose={(part) => (brush.value = part)} />
        <ToolEnds
          undoTitle="Undo"
          clearTitle="Clear all sizes"
          empty={regions.length === 0}
          undo={undo}
          clear={() => changeDrawn({ regions: [] })}
        />
      </div>
    </>
  );
}
