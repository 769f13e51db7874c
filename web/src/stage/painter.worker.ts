// The stage's thread: draws on the page's canvas, so that neither a large sheet nor a busy engine holds up the page.

import { scope } from '../worker/scope';
import type { EngineToPainter, FromPainter, ToPainter } from '../worker/protocol';
import { Scene } from './scene';
import type { Context } from './stones';

const scene = new Scene();
let context: Context | null = null;
let waiting = false;
let described = -1;
let shown = false;

const tell = (message: FromPainter) => scope.postMessage(message);

function refresh(): void {
  if (waiting) return;
  waiting = true;
  scope.requestAnimationFrame((time) => {
    waiting = false;
    if (!context) return;
    describe();
    if (scene.draw(context, Math.max(time, performance.now()))) refresh();
    if (!shown && scene.hasPicture) {
      shown = true;
      scope.requestAnimationFrame(() => tell({ type: 'shown' }));
    }
  });
}

function describe(): void {
  const piece = scene.pieceUnderPointer();
  if (piece === described) return;
  described = piece;
  tell({ type: 'piece', piece: scene.facts(piece) });
}

function resize(width: number, height: number, ratio: number): void {
  scene.stage = { width, height };
  scene.ratio = ratio;
  if (!context) return;
  context.canvas.width = Math.max(1, Math.round(width * ratio));
  context.canvas.height = Math.max(1, Math.round(height * ratio));
  // At once: a canvas is empty after a change of size, and would flicker until the next frame.
  scene.draw(context, performance.now());
}

function listen(port: MessagePort): void {
  port.onmessage = ({ data }: MessageEvent<EngineToPainter>) => {
    scene.take(data);
    described = data.type === 'pieces' ? -2 : described;
    refresh();
  };
}

scope.onmessage = ({ data }: MessageEvent<ToPainter>) => {
  switch (data.type) {
    case 'canvas':
      context = data.canvas.getContext('2d');
      break;
    case 'engine':
      return listen(data.port);
    case 'stage':
      resize(data.width, data.height, data.ratio);
      break;
    case 'view':
      scene.view = data.view;
      break;
    case 'extent':
      scene.extent = data.extent;
      break;
    case 'sheet':
      scene.lay(data.sheet);
      break;
    case 'look':
      scene.look = data.look;
      break;
    case 'point':
      scene.pointer = data.at;
      break;
    case 'drop':
      scene.drop(data.upTo);
  }
  refresh();
};
