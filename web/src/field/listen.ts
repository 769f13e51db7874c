// The pointer on the field: a press lifts a pebble or puts it back, one that is out can be carried. All else is left to
// the controls that turn the field.

export interface PointerActions {
  /** The pebble at a place, CSS px of the canvas. */
  pick(x: number, y: number): number | null;
  press(id: number): void;
  /** True where it can be carried. */
  grab(id: number): boolean;
  drag(x: number, y: number): void;
  drop(): void;
  point(id: number | null): void;
}

const kTap = 5; // px that a press may wander

/** Has to listen before the controls do. The answer takes all listeners off again. */
export function listen(canvas: HTMLCanvasElement, actions: PointerActions): () => void {
  const aborter = new AbortController();
  const on = (type: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel' | 'pointerleave', then: Listener) =>
    canvas.addEventListener(type, then, { signal: aborter.signal });
  let down: { pointer: number; x: number; y: number; id: number | null; held: boolean; moved: boolean } | null = null;

  on('pointerdown', (event) => {
    if (down || event.button !== 0) {
      down = down && { ...down, id: null }; // a second finger: no press
      return;
    }
    const { offsetX: x, offsetY: y } = event;
    const id = actions.pick(x, y);
    down = { pointer: event.pointerId, x, y, id, held: id !== null && actions.grab(id), moved: false };
    if (down.held) canvas.setPointerCapture(event.pointerId);
  });
  on('pointermove', (event) => {
    const { offsetX: x, offsetY: y } = event;
    if (!down) {
      if (event.pointerType !== 'mouse') return;
      const id = actions.pick(x, y);
      canvas.style.cursor = id === null ? '' : 'pointer';
      return actions.point(id);
    }
    if (event.pointerId !== down.pointer) return;
    down.moved ||= Math.hypot(x - down.x, y - down.y) > kTap;
    if (down.held && down.moved) actions.drag(x, y);
  });
  const release = (event: PointerEvent) => {
    if (event.pointerId !== down?.pointer) return;
    const { held, moved, id } = down;
    down = null;
    if (held) actions.drop();
    if (!moved && id !== null && event.type === 'pointerup') actions.press(id);
  };
  on('pointerup', release);
  on('pointercancel', release);
  on('pointerleave', () => actions.point(null));
  return () => aborter.abort();
}

type Listener = (event: PointerEvent) => void;
