// How the picture lies on the stage: a point p of the picture is seen at p * scale + (x, y), in CSS pixels.

export interface View {
  readonly scale: number;
  readonly x: number;
  readonly y: number;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

const kMaxScale = 64;
/** So much of the picture stays on the stage however it is pushed. */
const kKeep = 48;

const clamp = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

/** The whole picture, centred, as large as it goes; small ones are not blown up beyond 4:1. */
export function fit(picture: Size, stage: Size, margin: number): View {
  const room = (size: number) => Math.max(1, size - 2 * margin);
  const scale = Math.min(room(stage.width) / picture.width, room(stage.height) / picture.height, 4);
  return centred(picture, stage, scale);
}

function centred(picture: Size, stage: Size, scale: number): View {
  return { scale, x: (stage.width - picture.width * scale) / 2, y: (stage.height - picture.height * scale) / 2 };
}

export const toPicture = (view: View, p: Point): Point => ({
  x: (p.x - view.x) / view.scale,
  y: (p.y - view.y) / view.scale,
});

/** Zoom that keeps the point of the picture under `at` where it is. */
export function zoomAt(view: View, at: Point, factor: number, picture: Size, stage: Size): View {
  const smallest = Math.min(fit(picture, stage, 0).scale / 2, 1);
  const scale = clamp(view.scale * factor, smallest, kMaxScale);
  const p = toPicture(view, at);
  return kept({ scale, x: at.x - p.x * scale, y: at.y - p.y * scale }, picture, stage);
}

export function panBy(view: View, dx: number, dy: number, picture: Size, stage: Size): View {
  return kept({ ...view, x: view.x + dx, y: view.y + dy }, picture, stage);
}

function kept(view: View, picture: Size, stage: Size): View {
  return {
    scale: view.scale,
    x: clamp(view.x, kKeep - picture.width * view.scale, stage.width - kKeep),
    y: clamp(view.y, kKeep - picture.height * view.scale, stage.height - kKeep),
  };
}
