import { useSignal } from '@preact/signals';
import { Layers as LayersIcon } from 'lucide-preact';
import { layers, toggleLayer } from '../stage/viewport';
import { kLayers, type Layer } from '../worker/protocol';

const kTitles: Record<Layer, string> = {
  source: 'Source',
  edges: 'Edges',
  direction: 'Direction field',
  sites: 'Sites',
  cells: 'Cells',
  stones: 'Stones',
};

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
        {kLayers.map((layer) => (
          <button
            type="button"
            key={layer}
            class="chip"
            aria-pressed={layers.value[layer]}
            onClick={() => toggleLayer(layer)}
          >
            {kTitles[layer]}
          </button>
        ))}
      </div>
    </div>
  );
}
