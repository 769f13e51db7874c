// Undo and redo over values that never change in place.

export interface History<T> {
  readonly past: readonly T[];
  readonly present: T;
  readonly future: readonly T[];
}

const kDepth = 200;

export const historyOf = <T>(present: T): History<T> => ({ past: [], present, future: [] });

/** A new present. With `merge` it takes the old one's place, as the steps of one drag of a slider do. */
export function push<T>(history: History<T>, present: T, merge = false): History<T> {
  const past = merge ? history.past : [...history.past, history.present].slice(-kDepth);
  return { past, present, future: [] };
}

export function undo<T>(history: History<T>): History<T> {
  const before = history.past.at(-1);
  if (before === undefined) return history;
  return { past: history.past.slice(0, -1), present: before, future: [history.present, ...history.future] };
}

export function redo<T>(history: History<T>): History<T> {
  const [after, ...future] = history.future;
  if (after === undefined) return history;
  return { past: [...history.past, history.present], present: after, future };
}
