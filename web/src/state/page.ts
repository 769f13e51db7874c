// The two workers of this page.

import PainterWorker from '../stage/painter.worker?worker';
import type { FromPainter, ToPainter } from '../worker/protocol';
import { EngineClient } from './engine-client';
import { alertWith, engine, graphics, piece } from './store';

const painterWorker = new PainterWorker({ name: 'painter' });
painterWorker.onmessage = ({ data }: MessageEvent<FromPainter>) => {
  if (data.type === 'piece') piece.value = data.piece;
  else performance.mark('picture-shown'); // for who measures how long a visitor waits
};

export const painter = {
  postMessage: (message: ToPainter, transfer: Transferable[] = []) => painterWorker.postMessage(message, transfer),
};

export const client = new EngineClient(
  painter,
  (info) => (engine.value = info),
  (found) => (graphics.value = found),
  alertWith,
);
