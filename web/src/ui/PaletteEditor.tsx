import { useSignal } from '@preact/signals';
import { ClipboardPaste, Plus, X } from 'lucide-preact';
import type { ParameterValue } from 'tessera-wasm';
import { changeValue, endStep } from '../state/edits';
import type { TextField } from '../state/form';
import {
  kMostColours,
  kUsualTiles,
  paletteText,
  parsePalette,
  readTiles,
  type Palette,
  type Tile,
} from '../state/palette';
import { outcome } from '../state/store';

interface Props {
  field: TextField;
  value: ParameterValue;
  ties: { 'aria-describedby': string; 'aria-invalid': boolean };
}

const number = new Intl.NumberFormat('en');

/** A text that is a palette, as a choice, a number, or a list of tiles to name. */
export function PaletteEditor({ field, value, ties }: Props) {
  const palette = parsePalette(String(value));
  const change = (next: Palette) => changeValue(field, paletteText(next));
  const choose = (kind: Palette['kind']) => {
    if (kind === 'own') change({ kind });
    else if (kind === 'number')
      change({ kind, count: palette.kind === 'list' ? Math.max(2, palette.tiles.length) : 16 });
    else change({ kind, tiles: palette.kind === 'number' ? foundTiles() : kUsualTiles });
    endStep();
  };
  return (
    <div class="palette">
      <div class="palette-kind">
        <select
          id={`field-${field.key}`}
          value={palette.kind}
          onChange={(event) => choose(event.currentTarget.value as Palette['kind'])}
          {...ties}
        >
          <option value="own">each tile’s own colour</option>
          <option value="number">a number of colours</option>
          <option value="list">a list of tiles</option>
        </select>
        {palette.kind === 'number' && (
          <input
            type="number"
            inputMode="numeric"
            aria-label="Number of colours"
            min={2}
            max={kMostColours}
            step={1}
            value={palette.count}
            onInput={(event) => {
              const count = Number(event.currentTarget.value);
              if (Number.isInteger(count) && count >= 2 && count <= kMostColours) change({ kind: 'number', count });
            }}
            onChange={endStep}
          />
        )}
      </div>
      {palette.kind === 'number' && <Found onName={() => choose('list')} />}
      {palette.kind === 'list' && (
        <TileList
          tiles={palette.tiles}
          change={(tiles) => change(tiles.length ? { kind: 'list', tiles } : { kind: 'own' })}
        />
      )}
    </div>
  );
}

const found = () => (outcome.value && outcome.value.colours.length <= kMostColours ? outcome.value.colours : []);
const foundTiles = (): readonly Tile[] =>
  found().length ? found().map(({ colour }, i) => ({ name: `tile ${i + 1}`, colour })) : kUsualTiles;
const countOf = (colour: string) => found().find((tile) => tile.colour === colour)?.count;

/** What the engine chose. */
function Found({ onName }: { onName(): void }) {
  const colours = found();
  if (colours.length === 0) return null;
  return (
    <>
      <ul class="swatches" aria-label="Colours of the tiles">
        {colours.map(({ colour, count }) => (
          <li key={colour} title={`${colour}: ${number.format(count)} tiles`}>
            <span class="swatch" style={{ background: colour }} />
            <span class="unseen">{colour}</span>
            {number.format(count)}
          </li>
        ))}
      </ul>
      <button type="button" class="button slim" onClick={onName}>
        Name these colours
      </button>
    </>
  );
}

function TileList({ tiles, change }: { tiles: readonly Tile[]; change(tiles: readonly Tile[]): void }) {
  const pasting = useSignal(false);
  const replace = (at: number, part: Partial<Tile>) =>
    change(tiles.map((tile, i) => (i === at ? { ...tile, ...part } : tile)));
  return (
    <>
      <ul class="tiles" aria-label="Tiles">
        {tiles.map((tile, i) => {
          const title = tile.name || tile.colour;
          const count = countOf(tile.colour);
          return (
            <li key={i}>
              <input
                type="color"
                aria-label={`Colour of ${title}`}
                value={tile.colour}
                onInput={(event) => replace(i, { colour: event.currentTarget.value })}
                onChange={endStep}
              />
              <input
                type="text"
                aria-label={`Name of ${tile.colour}`}
                placeholder={tile.colour}
                maxLength={60}
                value={tile.name}
                onChange={(event) => {
                  replace(i, { name: event.currentTarget.value });
                  endStep();
                }}
              />
              <span class="tile-count" title="tiles of this colour">
                {count === undefined ? '–' : number.format(count)}
              </span>
              <button
                type="button"
                class="tool"
                aria-label={`Remove ${title}`}
                title={`Remove ${title}`}
                onClick={() => {
                  change(tiles.filter((_, k) => k !== i));
                  endStep();
                }}
              >
                <X size={15} aria-hidden />
              </button>
            </li>
          );
        })}
      </ul>
      <div class="palette-buttons">
        <button
          type="button"
          class="button slim"
          onClick={() => {
            change([...tiles, { name: '', colour: '#808080' }]);
            endStep();
          }}
        >
          <Plus size={15} aria-hidden />
          Add a colour
        </button>
        <button
          type="button"
          class="button slim"
          aria-expanded={pasting.value}
          aria-controls="tile-paste"
          onClick={() => (pasting.value = !pasting.value)}
        >
          <ClipboardPaste size={15} aria-hidden />
          Paste a list
        </button>
      </div>
      {pasting.value && (
        <PasteBox
          use={(pasted) => {
            pasting.value = false;
            change(pasted);
            endStep();
          }}
        />
      )}
    </>
  );
}

/** Any text with a colour to a line, such as a shop's table. */
function PasteBox({ use }: { use(tiles: readonly Tile[]): void }) {
  const text = useSignal('');
  const tiles = readTiles(text.value);
  return (
    <div id="tile-paste" class="paste">
      <textarea
        aria-label="List of tile colours"
        rows={5}
        placeholder={'chalk #f4f1e8\nbrick 140, 74, 50'}
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <button type="button" class="button slim" disabled={tiles.length === 0} onClick={() => use(tiles)}>
        {tiles.length ? `Use these ${tiles.length} colours` : 'Use this list'}
      </button>
    </div>
  );
}
