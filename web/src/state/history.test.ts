import { expect, test } from 'vitest';
import { historyOf, push, redo, undo } from './history';

test('undo and redo walk the same values', () => {
  const three = push(push(historyOf(1), 2), 3);
  expect(undo(three).present).toBe(2);
  expect(undo(undo(three)).present).toBe(1);
  expect(redo(redo(undo(undo(three))))).toEqual(three);
});

test('nothing to undo or redo leaves the history as it is', () => {
  const one = historyOf(1);
  expect(undo(one)).toBe(one);
  expect(redo(one)).toBe(one);
});

test('a merged step is undone together with those before it', () => {
  const dragged = push(push(push(historyOf(1), 2), 3, true), 4, true);
  expect(undo(dragged).present).toBe(1);
});

test('a new value forgets what was undone', () => {
  expect(redo(push(undo(push(historyOf(1), 2)), 5)).present).toBe(5);
});

test('the past is bounded', () => {
  let history = historyOf(0);
  for (let i = 1; i <= 1000; ++i) history = push(history, i);
  expect(history.past.length).toBe(200);
});
