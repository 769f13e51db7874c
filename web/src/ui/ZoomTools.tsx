import { Maximize, Minus, Plus } from 'lucide-preact';
import { fitView, oneToOne, view, zoomCentre } from '../stage/viewport';

export function ZoomTools() {
  return (
    <div class="zoom-tools tool-group" role="group" aria-label="Zoom">
      <button
        type="button"
        class="tool"
        aria-label="Zoom out"
        title="Zoom out (−)"
        onClick={() => zoomCentre(1 / 1.4)}
      >
        <Minus size={18} aria-hidden />
      </button>
      <output class="zoom-figure" aria-label="Zoom level">
        {Math.round(view.value.scale * 100)}%
      </output>
      <button type="button" class="tool" aria-label="Zoom in" title="Zoom in (+)" onClick={() => zoomCentre(1.4)}>
        <Plus size={18} aria-hidden />
      </button>
      <button type="button" class="tool" aria-label="Fit" title="Fit (0)" onClick={fitView}>
        <Maximize size={17} aria-hidden />
      </button>
      <button type="button" class="tool figure" aria-label="True size, 1:1" title="True size (1)" onClick={oneToOne}>
        1:1
      </button>
    </div>
  );
}
