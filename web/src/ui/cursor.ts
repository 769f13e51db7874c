// A place on the picture that the arrow keys move, for those who draw without a pointer.

import { picture } from '../state/store';
import { toPicture, type Point, type Size } from '../stage/view';
import { stageSize, view } from '../stage/viewport';

const kStep = 10; // CSS px
const kFarStep = 60; // with shift

const kDirections: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** The middle of the stage, px of the picture. */
export const startCursor = (): Point =>
  toPicture(view.value, { x: stageSize.value.width / 2, y: stageSize.value.height / 2 });

/** Where the key moves the cursor, within the picture; null for any other key. */
export function moveCursor(cursor: Point | null, key: string, far: boolean): Point | null {
  const { width = 0, height = 0 } = picture.value ?? {};
  return moved(cursor ?? startCursor(), key, far, view.value.scale, { width, height });
}

/** The same on any sheet, of which a pixel is so many CSS pixels wide. */
export function moved(
  { x, y }: Point,
  key: string,
  far: boolean,
  scale: number,
  { width, height }: Size,
): Point | null {
  const direction = kDirections[key];
  if (!direction) return null;
  const step = (far ? kFarStep : kStep) / scale;
  const within = (value: number, most: number) => Math.min(most, Math.max(0, value));
  return { x: within(x + step * direction[0], width), y: within(y + step * direction[1], height) };
}

/** Where the event is on the element that listens, CSS px. */
export function placeIn(event: MouseEvent & { currentTarget: Element }): Point {
  const { left, top } = event.currentTarget.getBoundingClientRect();
  return { x: event.clientX - left, y: event.clientY - top };
}
