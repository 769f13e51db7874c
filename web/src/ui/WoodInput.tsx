import { ImagePlus, Layers2, X } from 'lucide-preact';
import type { PanelFile } from '../state/drawn';
import { endStep } from '../state/edits';
import {
  addPanels,
  dpiOf,
  dropMask,
  forecast,
  improveFor,
  panels,
  remove,
  rename,
  seenOf,
  setDpi,
  setMask,
} from '../state/panels';
import { runSoon } from '../state/runner';
import { kPictureTypes } from './PictureInput';

/** The scans of wood that the picture is cut from, and whether they suffice. */
export function WoodInput() {
  return (
    <section class="group" aria-labelledby="wood-title">
      <h2 id="wood-title">Wood</h2>
      <div class="sources">
        <label class="source" title="Scans of veneer, any number of them">
          <input type="file" multiple class="unseen" accept={kPictureTypes} onChange={onFiles} />
          <ImagePlus size={20} aria-hidden />
          Panels
        </label>
      </div>
      <ul class="wood-list">
        {panels().map((panel) => (
          <Row key={panel.name} panel={panel} />
        ))}
      </ul>
      <Forecast />
      <Improve />
    </section>
  );
}

const kMostSeconds = 3600;

/** How long a finished result is made better. */
function Improve() {
  return (
    <label
      class="improve"
      title="Once all pieces have wood they are laid again, and exchange their wood, for so long"
    >
      Improve for
      <input
        type="number"
        inputMode="numeric"
        min={0}
        max={kMostSeconds}
        step="any"
        value={improveFor.value}
        onChange={({ currentTarget: input }) => {
          const seconds = Math.min(kMostSeconds, Math.max(0, Number(input.value) || 0));
          input.value = String(seconds);
          if (seconds === improveFor.value) return;
          improveFor.value = seconds;
          runSoon();
        }}
      />
      <span class="unit">s</span>
    </label>
  );
}

function onFiles(event: Event & { currentTarget: HTMLInputElement }): void {
  const input = event.currentTarget;
  void addPanels([...(input.files ?? [])]);
  input.value = ''; // so that the same files can be chosen again
}

function Row({ panel }: { panel: PanelFile }) {
  const { name, mask } = panel;
  const seen = seenOf(panel);
  return (
    <li>
      {seen && <img src={seen.address} alt="" width={44} height={44} draggable={false} />}
      <input
        type="text"
        class="wood-name"
        aria-label={`Name of ${name}`}
        title={panel.file}
        value={name}
        maxLength={40}
        onChange={(event) => {
          rename(panel, event.currentTarget.value);
          event.currentTarget.value = panel.name;
        }}
      />
      <label class="wood-dpi">
        <input
          type="number"
          inputMode="decimal"
          min={20}
          max={10000}
          step="any"
          aria-label={`Resolution of ${name}, dpi`}
          placeholder={String(seen?.dpi ? Math.round(seen.dpi) : 300)}
          value={dpiOf(panel)}
          onInput={(event) => setDpi(panel, event.currentTarget.value)}
          onChange={endStep}
        />
        <span class="unit">dpi</span>
      </label>
      {mask ? (
        <button
          type="button"
          class="tool"
          aria-pressed
          title={`Without the mask ${mask.file}`}
          onClick={() => dropMask(panel)}
        >
          <Layers2 size={16} aria-hidden />
          <span class="unseen">Remove the mask of {name}</span>
        </button>
      ) : (
        <label class="tool" title="A picture of the scan's proportions, white where there is wood; else it is found">
          <input
            type="file"
            class="unseen"
            accept={kPictureTypes}
            aria-label={`Mask of ${name}`}
            onChange={({ currentTarget: input }) => {
              const file = input.files?.[0];
              if (file) void setMask(panel, file);
              input.value = '';
            }}
          />
          <Layers2 size={16} aria-hidden />
        </label>
      )}
      <button
        type="button"
        class="tool"
        aria-label={`Remove ${name}`}
        title={`Remove ${name}`}
        onClick={() => remove(panel)}
      >
        <X size={16} aria-hidden />
      </button>
    </li>
  );
}

/** Before the pieces come: how many, and how much wood there is. */
function Forecast() {
  const lines = forecast.value.trim().split('\n').filter(Boolean);
  if (!lines.length) return null;
  return (
    <ul class="forecast" aria-label="Forecast">
      {lines.map((line) => (
        <li key={line} data-short={line.includes('not suffice')}>
          {line.replace(/cm2/g, 'cm²')}
        </li>
      ))}
    </ul>
  );
}
