// What the toolbars of all drawing tools have.

import { Check, Trash2, Undo2, type LucideIcon } from 'lucide-preact';
import { tool } from '../state/store';

export const ToolGap = () => <span class="tool-gap" />;

interface IconToolProps {
  title: string;
  hint?: string;
  Icon: LucideIcon;
  /** Of a switch: whether it is on. */
  on?: boolean;
  /** It can do nothing now. */
  off?: boolean;
  act(): void;
}

/** A button that is a picture. */
export const IconTool = ({ title, hint = title, Icon, on, off, act }: IconToolProps) => (
  <button
    type="button"
    class="tool"
    aria-label={title}
    title={hint}
    aria-pressed={on}
    aria-disabled={off}
    onClick={() => off || act()}
  >
    <Icon size={18} aria-hidden />
  </button>
);

/** Widths in parts of the picture's shorter side. */
export const kPictureBrushes: readonly [Brush, Brush, Brush] = [
  { title: 'Thin brush', width: 0.05 },
  { title: 'Medium brush', width: 0.12 },
  { title: 'Broad brush', width: 0.26 },
];

interface Brush {
  title: string;
  width: number;
}

interface SizesProps {
  brushes: readonly Brush[];
  chosen: number;
  choose(width: number): void;
}

/** Dots, the finest first. */
export const BrushSizes = ({ brushes, chosen, choose }: SizesProps) => (
  <>
    {brushes.map(({ title, width }, i) => (
      <button
        type="button"
        class="tool"
        key={title}
        aria-label={title}
        title={title}
        aria-pressed={chosen === width}
        onClick={() => choose(width)}
      >
        <span class="brush-dot" style={{ width: `${7 + 6 * i}px`, height: `${7 + 6 * i}px` }} />
      </button>
    ))}
  </>
);

interface EndsProps {
  undoTitle: string;
  clearTitle: string;
  empty: boolean;
  undo(): void;
  clear(): void;
}

export const ToolEnds = ({ undoTitle, clearTitle, empty, undo, clear }: EndsProps) => (
  <>
    <ToolGap />
    <button
      type="button"
      class="tool"
      aria-label={undoTitle}
      title={undoTitle}
      aria-disabled={empty}
      onClick={() => empty || undo()}
    >
      <Undo2 size={18} aria-hidden />
    </button>
    <button
      type="button"
      class="tool"
      aria-label={clearTitle}
      title={clearTitle}
      aria-disabled={empty}
      onClick={() => empty || clear()}
    >
      <Trash2 size={18} aria-hidden />
    </button>
    <ToolGap />
    <button type="button" class="tool strong" onClick={() => (tool.value = null)}>
      <Check size={18} aria-hidden />
      Done
    </button>
  </>
);
