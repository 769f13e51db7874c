import { useSignal } from '@preact/signals';
import { Layers as LayersIcon } from 'lucide-preact';
import { layers, toggleLayer } from '../stage/viewport';
import { entry } from '../state/store';
import type { Layer } from '../worker/protocol';

const kTitles: Record<Exclude<Layer, 'stones'>, string> = {
  source: 'Source',
  edges: 'Edges',
  direction: 'Direction field',
  sites: 'Sites',
  cells: 'Cells',
  outlines: 'Outlines',
};

const capital = (word: string) => word.charAt(0).toUpperCase() + word.slice(1);

export function LayerSwitches() {
  const open = useSignal(false); // matters on a phone only
  return (
    <div class="layers" data-open={open.value}>
      <button
        type="button"
        class="layers-button tool"
        aria-expanded={open.value}
        aria-controls="layers"
        onClick={() => (open.value = !open.value)}
      >
        <LayersIcon size={18} aria-hidden />
        Layers
      </button>
      <div id="layers" class="layers-list" role="group" aria-label="Layers">
        {entry.value.layers.map((layer) => (
          <button
            type="button"
            key={layer}
            class="chip"
            aria-pressed={layers.value[layer]}
            onClick={() => toggleLayer(layer)}
          >
            {layer === 'stones' ? capital(entry.value.pieces) : kTitles[layer]}
          </button>
        ))}
      </div>
    </div>
  );
}
