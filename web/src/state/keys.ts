// Undo and redo by the usual keys; those of a text field stay its own.

import { redo, undo } from './edits';
import { undoStroke } from './sketch';
import { tool } from './store';

const kTextTypes = new Set(['text', 'search', 'email', 'url']);

const isText = (target: EventTarget | null) =>
  (target instanceof HTMLInputElement && kTextTypes.has(target.type)) || target instanceof HTMLTextAreaElement;

export function bindKeys(): void {
  addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || isText(event.target)) return;
    const key = event.key.toLowerCase();
    const back = key === 'z' && !event.shiftKey;
    const forth = (key === 'z' && event.shiftKey) || key === 'y';
    if (!back && !forth) return;
    event.preventDefault();
    if (tool.value === 'sketch') back && undoStroke();
    else if (back) undo();
    else redo();
  });
}
