// Where the stage looks. It stays fitted to the picture until somebody moves it.

import { effect, signal } from '@preact/signals';
import { painter } from '../state/page';
import { picture } from '../state/store';
import { calm, shade } from '../state/theme';
import type { Layer, Layers } from '../worker/protocol';
import { fit, panBy, zoomAt, type Point, type Size, type View } from './view';

const kMargin = 24;

export const view = signal<View>({ scale: 1, x: 0, y: 0 });
export const stageSize = signal<Size>({ width: 1, height: 1 });
export const layers = signal<Layers>({
  source: false,
  edges: false,
  direction: false,
  sites: false,
  cells: false,
  stones: true,
});
/** Part of the stage that shows the source. */
export const divider = signal(0);

const fitted = signal(true);

export const fitView = () => (fitted.value = true);
export const toggleLayer = (layer: Layer) => (layers.value = { ...layers.value, [layer]: !layers.value[layer] });

function move(next: (picture: Size, stage: Size) => View): void {
  if (!picture.value) return;
  fitted.value = false;
  view.value = next(picture.value, stageSize.value);
}

export const pan = (dx: number, dy: number) => move((p, s) => panBy(view.value, dx, dy, p, s));
export const zoom = (at: Point, factor: number) => move((p, s) => zoomAt(view.value, at, factor, p, s));
export const zoomCentre = (factor: number) =>
  zoom({ x: stageSize.value.width / 2, y: stageSize.value.height / 2 }, factor);
export const oneToOne = () => zoomCentre(1 / view.value.scale);

/** Keeps the painter informed. */
export function bindViewport(): void {
  effect(() => {
    if (fitted.value && picture.value) {
      const margin = stageSize.value.width < 600 ? kMargin / 3 : kMargin;
      view.value = fit(picture.value, stageSize.value, margin);
    }
  });
  effect(() => painter.postMessage({ type: 'view', view: view.value }));
  effect(() => {
    void shade.value; // the styles follow it
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    painter.postMessage({
      type: 'look',
      look: {
        layers: layers.value,
        divider: divider.value,
        accent: colour('--accent'),
        line: colour('--line'),
        calm: calm.value,
      },
    });
  });
}
