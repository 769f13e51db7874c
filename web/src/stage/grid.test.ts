import { expect, test } from 'vitest';
import { parsePieces } from '../worker/pieces';
import { gridOf, pieceAt } from './grid';

const square = (id: number, x: number, y: number, hole = '') =>
  `{"type":"Feature","properties":{"id":"stone-${id}","colour":"#222","area":64,"vertices":4,"orientation":0,` +
  `"centroid":[0,0]},"geometry":{"type":"Polygon","coordinates":[[[${x},${y}],[${x + 8},${y}],[${x + 8},${y + 8}],` +
  `[${x},${y + 8}],[${x},${y}]]${hole}]}}`;

function sheetOf(features: string[], width: number, height: number) {
  const json = `{"type":"FeatureCollection","bbox":[0,0,${width},${height}],"features":[\n${features.join(',\n')}\n]}\n`;
  return parsePieces(new TextEncoder().encode(json));
}

test('each square of a board is found, and the grout between them is not', () => {
  const features: string[] = [];
  for (let y = 0; y < 20; ++y) for (let x = 0; x < 30; ++x) features.push(square(features.length, 10 * x, 10 * y));
  const pieces = sheetOf(features, 300, 200);
  const grid = gridOf(pieces);
  for (let y = 0; y < 20; ++y) {
    for (let x = 0; x < 30; ++x) {
      expect(pieceAt(pieces, grid, 10 * x + 4, 10 * y + 4)).toBe(30 * y + x);
      expect(pieceAt(pieces, grid, 10 * x + 9, 10 * y + 4)).toBe(-1);
    }
  }
});

test('holes and the outside are empty', () => {
  const pieces = sheetOf([square(1, 0, 0, ',[[2,2],[2,6],[6,6],[6,2],[2,2]]')], 20, 20);
  const grid = gridOf(pieces);
  expect(pieceAt(pieces, grid, 1, 1)).toBe(0);
  expect(pieceAt(pieces, grid, 4, 4)).toBe(-1);
  expect(pieceAt(pieces, grid, -1, 1)).toBe(-1);
  expect(pieceAt(pieces, grid, 25, 1)).toBe(-1);
});

test('no pieces, nothing found', () => {
  const pieces = sheetOf([], 10, 10);
  expect(pieceAt(pieces, gridOf(pieces), 5, 5)).toBe(-1);
});
