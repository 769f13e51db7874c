import { unzipSync } from 'fflate';
import { expect, test } from 'vitest';
import { cornersOnPanel, matchingDpi, nameOf, readLaid } from './growing';
import { noPieces } from './pieces';
import { cutOrder, turnedBack, woodPieces, zipped } from './wood';

const near = (found: readonly number[], wanted: readonly number[]) => {
  expect(found.length).toBe(wanted.length);
  found.forEach((value, i) => expect(value).toBeCloseTo(wanted[i]!, 9));
};

test('a piece lies on its panel turned back, its centroid where the table says', () => {
  const square = [0, 0, 2, 0, 2, 2, 0, 2];
  near(turnedBack(square, 0, { x: 11, y: 21 }), [10, 20, 12, 20, 12, 22, 10, 22]);
  // A quarter clockwise into the finished piece: there its top left was at the bottom left.
  near(turnedBack(square, 90, { x: 1, y: 1 }), [0, 2, 0, 0, 2, 0, 2, 2]);
  const triangle = [0, 0, 3, 0, 0, 3]; // centroid at 1, 1
  near(turnedBack(triangle, 0, { x: 5, y: 6 }), [4, 5, 7, 5, 4, 8]);
});

test('what has been laid is read from where one was', () => {
  const line = '0 1 2 0 0 20 10 10 10 0 1 3 4 77 90 25 15 100 50';
  const state = `tessera parquetry state 2\n0123456789abcdef\n${line}\n${line.replace('77', '78')}\n`;
  expect(readLaid(state, 0).map(({ cost }) => cost)).toEqual([77, 78]);
  const [laid] = readLaid(state, 1);
  expect(laid).toMatchObject({
    row: 1,
    column: 2,
    x: 20,
    y: 10,
    width: 10,
    height: 10,
    panel: 0,
    cost: 78,
    turn: 90,
  });
  near(cornersOnPanel(laid!), [95, 55, 95, 45, 105, 45, 105, 55]);
  expect(readLaid(state, 2)).toEqual([]);
});

test('names are those of a spreadsheet', () => {
  expect([nameOf(0, 0), nameOf(11, 2), nameOf(0, 25), nameOf(0, 26), nameOf(0, 701), nameOf(0, 702)]).toEqual([
    'A1',
    'C12',
    'Z1',
    'AA1',
    'ZZ1',
    'AAA1',
  ]);
});

test('panels are matched at the coarsest, at most 150 dpi', () => {
  expect(matchingDpi([{ dpi: 600 }, { dpi: 300 }], 0)).toBe(150);
  expect(matchingDpi([{ dpi: 600 }, { dpi: 100 }], 0)).toBe(100);
  expect(matchingDpi([{ dpi: 0 }], 0)).toBe(150);
  expect(matchingDpi([{ dpi: 100 }], 200)).toBe(200);
});

test('cuts in their order; a table without rows', () => {
  expect(cutOrder('<path id="label-A1"/><path id="cut-B2" d="M0"/><path id="cut-A1"/>')).toEqual(['B2', 'A1']);
  expect(woodPieces('id,row,column\n', noPieces(1, 1), 1)).toEqual([]);
});

test('the folder is packed as it is, the same bytes each time', async () => {
  const bytes = new TextEncoder().encode('id\nA1\n');
  const made = {
    files: [{ name: 'folder/pieces.csv', mediaType: 'text/csv', bytes }],
    report: { seed: 1 },
    masks: { 'oak-mask.png': bytes },
  };
  const zip = new Uint8Array(await zipped(made).arrayBuffer());
  const inside = unzipSync(zip);
  expect(Object.keys(inside)).toEqual(['oak-mask.png', 'pieces.csv', 'report.json']);
  expect(inside['pieces.csv']).toEqual(bytes);
  expect(new Uint8Array(await zipped(made).arrayBuffer())).toEqual(zip);
});
