// Pictures that the engine's worker has, each sent once only.

import type { PictureFacts } from './engine-client';
import { client } from './page';

const sent = new Map<string, { blob: Blob; facts: PictureFacts }>(); // by slot

/** Rejects with a message for people where it cannot be used. */
export async function sendPicture(slot: string, name: string, blob: Blob): Promise<PictureFacts> {
  const before = sent.get(slot);
  if (before?.blob === blob) return before.facts;
  const facts = await client.setPicture(slot, name, blob);
  sent.set(slot, { blob, facts });
  return facts;
}
