import { useSignal } from '@preact/signals';
import { ChevronUp, Play, Square } from 'lucide-preact';
import { cancel, generate } from '../state/runner';
import { entry, inputRole, opening, run, sheet } from '../state/store';
import { DensityInput } from './DensityInput';
import { FitInput } from './FitInput';
import { ModelChoice } from './ModelChoice';
import { Parameters, Presets } from './Parameters';
import { PictureInput } from './PictureInput';
import { WoodInput } from './WoodInput';

/** On the right; on a phone a sheet of which only the head is seen until it is pulled up. */
export function Panel() {
  const open = useSignal(false);
  return (
    <aside class="panel" aria-label="Parameters" data-open={open.value}>
      <div class="panel-head">
        <button
          type="button"
          class="sheet-handle"
          aria-expanded={open.value}
          aria-controls="panel-body"
          onClick={() => (open.value = !open.value)}
        >
          <ChevronUp size={20} aria-hidden />
          Parameters
        </button>
        <div class="run-buttons">
          <button type="button" class="button primary" disabled={!sheet.value && !opening.value} onClick={generate}>
            <Play size={16} aria-hidden />
            Generate
          </button>
          <button type="button" class="button" aria-disabled={!run.value} onClick={() => run.value && cancel()}>
            <Square size={14} aria-hidden />
            Cancel
          </button>
        </div>
      </div>
      <div class="panel-body" id="panel-body">
        {inputRole.value && <PictureInput />}
        {entry.value.panels && <WoodInput />}
        <ModelChoice />
        <Presets />
        <Parameters />
        {entry.value.measurable && <FitInput />}
        {!inputRole.value && <DensityInput />}
      </div>
    </aside>
  );
}
