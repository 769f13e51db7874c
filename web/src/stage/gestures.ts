// Drag, pinch, wheel and keys on the stage.

import { painter } from '../state/page';
import { fitView, oneToOne, pan, zoom, zoomCentre } from './viewport';
import type { Point } from './view';

const kStep = 48; // px an arrow key pans
const kTap = 5; // px that a tap may wander

const point = (at: Point | null) => painter.postMessage({ type: 'point', at });

/** Listens on `element`; the answer takes all listeners off again. `tapped`: with a place on the element. */
export function listenToGestures(element: HTMLElement, tapped: (at: Point) => void): () => void {
  const pointers = new Map<number, Point>();
  let wandered = 0;
  const aborter = new AbortController();
  const on = <K extends keyof HTMLElementEventMap>(type: K, listener: (event: HTMLElementEventMap[K]) => void) =>
    element.addEventListener(type, listener, { signal: aborter.signal, passive: false });
  const within = (event: MouseEvent): Point => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  on('pointerdown', (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, within(event));
    if (pointers.size === 1) wandered = 0;
  });
  on('pointermove', (event) => {
    const at = within(event);
    const before = pointers.get(event.pointerId);
    if (!before) return event.pointerType === 'mouse' ? point(at) : undefined;
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, at);
    wandered += Math.hypot(at.x - before.x, at.y - before.y);
    if (other) return pinch(before, at, other);
    if (wandered > kTap) pan(at.x - before.x, at.y - before.y);
  });
  const release = (event: PointerEvent) => {
    const still = pointers.delete(event.pointerId) && pointers.size === 0 && wandered <= kTap;
    if (!still || event.type !== 'pointerup') return;
    point(within(event));
    tapped(within(event));
  };
  on('pointerup', release);
  on('pointercancel', release);
  on('pointerleave', (event) => event.pointerType === 'mouse' && point(null));
  on('wheel', (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    zoom(within(event), Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0018)));
  });
  on('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  return () => aborter.abort();
}

function pinch(before: Point, at: Point, other: Point): void {
  const spread = (p: Point) => Math.max(1, Math.hypot(p.x - other.x, p.y - other.y));
  pan((at.x - before.x) / 2, (at.y - before.y) / 2);
  zoom({ x: (at.x + other.x) / 2, y: (at.y + other.y) / 2 }, spread(at) / spread(before));
}

const keys: Record<string, () => void> = {
  ArrowLeft: () => pan(kStep, 0),
  ArrowRight: () => pan(-kStep, 0),
  ArrowUp: () => pan(0, kStep),
  ArrowDown: () => pan(0, -kStep),
  '+': () => zoomCentre(1.3),
  '=': () => zoomCentre(1.3),
  '-': () => zoomCentre(1 / 1.3),
  '0': fitView,
  '1': oneToOne,
};
