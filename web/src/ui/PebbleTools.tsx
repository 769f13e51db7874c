import { useSignal } from '@preact/signals';
import { Combine, Lasso, MousePointer2, Ruler, Scissors, Trash2, Undo2, X, type LucideIcon } from 'lucide-preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { simplified } from '../stage/curve';
import { toPicture, type Point } from '../stage/view';
import { view, zoom } from '../stage/viewport';
import { countCorrections } from '../state/corrections';
import { undo } from '../state/edits';
import { chooseNone, chosen, correct, correctChosen, corrections, setScale, toggleAt } from '../state/pebbles';
import { outcome, tool } from '../state/store';
import type { Pieces } from '../worker/pieces';
import type { PebbleTool } from '../techniques/entry';
import { counted } from '../techniques/facts';
import { moveCursor, placeIn, startCursor } from './cursor';
import { IconTool, ToolGap } from './ToolBar';

const kTolerance = 1.5; // CSS px that an outline may leave the hand's line

interface ToolKind {
  title: string;
  hint: string;
  Icon: LucideIcon;
  key: string;
}

const kTools: Readonly<Record<PebbleTool, ToolKind>> = {
  pick: { title: 'Choose', hint: 'Press pebbles to choose them', Icon: MousePointer2, key: 'v' },
  split: {
    title: 'Split',
    hint: 'Press two places of one pebble; the cut goes between them',
    Icon: Scissors,
    key: 's',
  },
  add: { title: 'Add', hint: 'Draw around a pebble that was missed', Icon: Lasso, key: 'a' },
  ruler: { title: 'Scale', hint: 'Draw a line whose length you know', Icon: Ruler, key: 'r' },
};
const kOrder: readonly PebbleTool[] = ['pick', 'split', 'add', 'ruler'];

const isPebbleTool = (name: string | null): name is PebbleTool => name !== null && name in kTools;

const toggle = (name: PebbleTool) => (tool.value = tool.value === name ? null : name);

const merge = () => chosen.value.length > 1 && correctChosen('merge');
const remove = () => chosen.value.length > 0 && correctChosen('delete');

/** Keys of the photo's half, whatever has the focus in it. */
export function onPebbleKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLInputElement) return;
  const key = event.key.toLowerCase();
  const name = kOrder.find((one) => kTools[one].key === key);
  if (name) toggle(name);
  else if (key === 'm') merge();
  else if (key === 'delete') remove();
  else if (key === 'escape' && chosen.value.length && !isPebbleTool(tool.value)) chooseNone();
  else return;
  event.preventDefault();
}

/** Beside the photo: what corrects the pebbles that were found, and the photo's scale. */
export function PebbleTools() {
  const { value: list } = chosen;
  const count = countCorrections(corrections.value);
  return (
    <div class="pebble-tools tool-group" role="toolbar" aria-label="Corrections">
      {kOrder.map((name) => {
        const { title, hint, Icon, key } = kTools[name];
        return (
          <IconTool
            key={name}
            title={title}
            hint={`${title} (${key.toUpperCase()}): ${hint.charAt(0).toLowerCase()}${hint.slice(1)}`}
            Icon={Icon}
            on={tool.value === name}
            act={() => toggle(name)}
          />
        );
      })}
      <ToolGap />
      <IconTool title="Merge" hint="Merge the pebbles chosen (M)" off={list.length < 2} act={merge} Icon={Combine} />
      <IconTool
        title="Delete"
        hint="Delete the pebbles chosen (Delete)"
        off={!list.length}
        act={remove}
        Icon={Trash2}
      />
      <IconTool title="Choose none" hint="Choose none (Escape)" off={!list.length} act={chooseNone} Icon={X} />
      <p class="unseen" role="status">
        {list.length > 0 && `${counted(list.length, 'pebbles')} chosen`}
        {list.length === 0 && count > 0 && counted(count, 'corrections')}
      </p>
    </div>
  );
}

const toStage = ({ x, y }: Point): Point => ({
  x: x * view.value.scale + view.value.x,
  y: y * view.value.scale + view.value.y,
});

/** What is chosen, outlined over the photo. */
export function ChosenPebbles() {
  const pieces = outcome.value?.pieces;
  const { scale, x, y } = view.value;
  if (!pieces || chosen.value.length === 0) return null;
  return (
    <svg class="chosen-pebbles" aria-hidden="true">
      <g transform={`translate(${x} ${y}) scale(${scale})`}>
        {chosen.value.map(({ piece }) => (
          <path key={piece} d={outlineOf(pieces, piece)} />
        ))}
      </g>
    </svg>
  );
}

export function outlineOf({ pieceStarts, ringStarts, points }: Pieces, piece: number): string {
  const words: string[] = [];
  for (let ring = pieceStarts[piece]!; ring < pieceStarts[piece + 1]!; ++ring) {
    for (let k = ringStarts[ring]!; k < ringStarts[ring + 1]!; ++k)
      words.push(`${k === ringStarts[ring] ? 'M' : 'L'}${points[2 * k]} ${points[2 * k + 1]}`);
    words.push('Z');
  }
  return words.join('');
}

const kKeys: Readonly<Record<PebbleTool, string>> = {
  pick: 'space chooses the pebble under the cursor, M merges, Delete deletes',
  split: 'space sets each of the two places',
  add: 'space sets a corner, Enter closes the outline',
  ruler: 'space sets each end of the line',
};

/** Over the photo while one of the tools is in use: places set by the pointer, or by keys. */
export function PebbleSheet() {
  const box = useRef<HTMLDivElement>(null);
  const places = useSignal<readonly Point[]>([]); // set so far
  const hand = useSignal<readonly Point[]>([]); // an outline or line that is being drawn
  const cursor = useSignal<Point | null>(null);
  const name = tool.value;
  useLayoutEffect(() => {
    places.value = hand.value = [];
    box.current?.focus({ preventScroll: true });
  }, [name]);
  if (!isPebbleTool(name)) return null;

  const isLine = name === 'ruler' && places.value.length === 2;
  const put = (at: Point) => {
    if (name === 'pick') return toggleAt(at);
    places.value = isLine ? [at] : [...places.value, at];
    if (name === 'split' && places.value.length === 2) finish('split', places.value);
  };
  const finish = (what: 'split' | 'add', outline: readonly Point[]) => {
    places.value = [];
    correct(what, outline);
  };
  const onDown = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    cursor.value = null;
    const at = toPicture(view.value, placeIn(event));
    if (name === 'add' || name === 'ruler') hand.value = [at];
    else put(at);
  };
  const onMove = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    const [first] = hand.value;
    const at = toPicture(view.value, placeIn(event));
    if (first) hand.value = name === 'ruler' ? [first, at] : [...hand.value, at];
  };
  const onUp = () => {
    const [first, last] = [hand.value[0], hand.value.at(-1)];
    if (first && last && hand.value.length > 1) {
      if (name === 'ruler') places.value = [first, last];
      else finish('add', simplified(hand.value, kTolerance / view.value.scale));
    }
    hand.value = [];
  };
  const onKey = (event: KeyboardEvent) => {
    const moved = moveCursor(cursor.value, event.key, event.shiftKey);
    if (moved) cursor.value = moved;
    else if (event.key === ' ') put((cursor.value ??= startCursor()));
    else if (event.key === 'Enter' && name === 'add' && places.value.length > 2) finish('add', places.value);
    else if (event.key === 'Backspace') places.value = places.value.slice(0, -1);
    else if (event.key === 'Escape') tool.value = null;
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const going = hand.value.length
    ? hand.value
    : [...places.value, ...(cursor.value && !isLine ? [cursor.value] : [])];
  return (
    <>
      <div
        ref={box}
        class="sketch guides"
        role="application"
        tabIndex={0}
        aria-label={`${kTools[name].hint}. Arrow keys move the cursor, ${kKeys[name]}, Escape ends.`}
        onPointerDown={onDown}
        onPointerMove={onMove}
        onPointerUp={onUp}
        onPointerCancel={() => (hand.value = [])}
        onKeyDown={onKey}
        onWheel={(event) => {
          event.preventDefault();
          zoom(placeIn(event), Math.exp(-event.deltaY * 0.0018));
        }}
      >
        <svg aria-hidden="true">
          {going.length > 1 && name !== 'pick' && <Line places={going} closed={name === 'add'} />}
          {places.value.map((at, i) => (
            <circle key={i} class="guide-grip" cx={toStage(at).x} cy={toStage(at).y} r={5} />
          ))}
          {cursor.value && <Cross at={toStage(cursor.value)} />}
        </svg>
      </div>
      <div class="pebble-words tool-group">
        {isLine ? (
          <LengthField from={places.value[0]!} to={places.value[1]!} />
        ) : (
          <p class="tool-words">{wordsOf(name, places.value.length)}</p>
        )}
        <IconTool title="Undo" hint="Undo (Ctrl+Z)" Icon={Undo2} act={undo} />
        <button type="button" class="tool strong" onClick={() => (tool.value = null)}>
          Done
        </button>
      </div>
    </>
  );
}

function wordsOf(name: PebbleTool, places: number): string {
  if (name === 'pick' && chosen.value.length) return `${counted(chosen.value.length, 'pebbles')} chosen`;
  if (name === 'split' && places === 1) return 'And the place on the other side';
  if (name === 'ruler' && places === 1) return 'And the other end';
  if (name === 'add' && places > 0) return 'Enter closes the outline';
  return kTools[name].hint;
}

function Line({ places, closed }: { places: readonly Point[]; closed: boolean }) {
  const path = `M${places.map((at) => `${toStage(at).x} ${toStage(at).y}`).join('L')}${closed ? 'Z' : ''}`;
  return (
    <g>
      <path class="guide-halo" d={path} />
      <path class="guide" d={path} />
    </g>
  );
}

const Cross = ({ at: { x, y } }: { at: Point }) => (
  <path class="guide-cursor" d={`M${x - 12} ${y}H${x + 12}M${x} ${y - 12}V${y + 12}`} />
);

const kUnits = { mm: 1, cm: 10, m: 1000 } as const;

/** How long the line is that was drawn. */
function LengthField({ from, to }: { from: Point; to: Point }) {
  const text = useSignal('');
  const unit = useSignal<keyof typeof kUnits>('cm');
  const input = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => input.current?.focus({ preventScroll: true }), []);
  return (
    <form
      class="length"
      onSubmit={(event) => {
        event.preventDefault();
        if (setScale(from, to, Number(text.value) * kUnits[unit.value])) tool.value = null;
      }}
      onKeyDown={(event) => event.key === 'Escape' && (tool.value = null)}
    >
      <label for="line-length">Length</label>
      <input
        id="line-length"
        ref={input}
        type="number"
        inputMode="decimal"
        min={0}
        step="any"
        required
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <select
        aria-label="Unit"
        value={unit.value}
        onChange={(event) => (unit.value = event.currentTarget.value as keyof typeof kUnits)}
      >
        {Object.keys(kUnits).map((name) => (
          <option key={name}>{name}</option>
        ))}
      </select>
      <button type="submit" class="tool strong">
        Set
      </button>
    </form>
  );
}
