// Where the stage looks. It stays fitted to the picture until somebody moves it.

import { computed, effect, signal } from '@preact/signals';
import { painter } from '../state/page';
import { compared, entry, inputRole, shaping, sheet, technique } from '../state/store';
import { extent } from '../state/targets';
import { calm, shade } from '../state/theme';
import { kLayers, type Layer, type Layers } from '../worker/protocol';
import { fit, panBy, zoomAt, type Point, type Size, type View } from './view';

const kMargin = 24;

export const view = signal<View>({ scale: 1, x: 0, y: 0 });
export const stageSize = signal<Size>({ width: 1, height: 1 });
/** What was switched, by technique; else each shows what it shows at first. */
const switched = signal<Readonly<Record<string, Layers>>>({});
export const layers = computed(() => switched.value[technique.value] ?? shownAtFirst(entry.value.shown));
/** There is a picture to compare with, on the same stage. */
export const comparable = computed(() => {
  if (entry.value.solid) return false;
  return inputRole.value !== '' || (sheet.value !== null && sameSize(compared.value, sheet.value));
});
/** Part of the stage that shows the source. */
export const divider = signal(0);

const sameSize = (a: Size | null, b: Size) => a?.width === b.width && a.height === b.height;

const fitted = signal(true);

export const fitView = () => (fitted.value = true);
export const toggleLayer = (layer: Layer) =>
  (switched.value = {
    ...switched.value,
    [technique.value]: { ...layers.value, [layer]: !layers.value[layer] },
  });

const shownAtFirst = (shown: readonly Layer[]) =>
  Object.fromEntries(kLayers.map((layer) => [layer, shown.includes(layer)])) as Record<Layer, boolean>;

/** What there is to look at, px of the picture. */
const whole = computed(() => (inputRole.value && !shaping.value ? extent.value : sheet.value));

function move(next: (picture: Size, stage: Size) => View): void {
  if (!whole.value) return;
  fitted.value = false;
  view.value = next(whole.value, stageSize.value);
}

export const pan = (dx: number, dy: number) => move((p, s) => panBy(view.value, dx, dy, p, s));
export const zoom = (at: Point, factor: number) => move((p, s) => zoomAt(view.value, at, factor, p, s));
export const zoomCentre = (factor: number) =>
  zoom({ x: stageSize.value.width / 2, y: stageSize.value.height / 2 }, factor);
export const oneToOne = () => zoomCentre(1 / view.value.scale);

/** Keeps the painter informed. */
export function bindViewport(): void {
  effect(() => {
    if (fitted.value && whole.value) {
      const margin = stageSize.value.width < 600 ? kMargin / 3 : kMargin;
      view.value = fit(whole.value, stageSize.value, margin);
    }
  });
  effect(() => painter.postMessage({ type: 'view', view: view.value }));
  effect(() => painter.postMessage({ type: 'sheet', sheet: inputRole.value ? null : sheet.value }));
  effect(() => painter.postMessage({ type: 'extent', extent: inputRole.value ? whole.value : null }));
  effect(() => {
    void shade.value; // the styles follow it
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    painter.postMessage({
      type: 'look',
      look: {
        layers: layers.value,
        divider: shaping.value ? 1 : comparable.value ? divider.value : 0, // the picture itself, under a grid
        accent: colour('--accent'),
        line: colour('--line'),
        calm: calm.value,
      },
    });
  });
}
