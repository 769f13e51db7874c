import { expect, test } from 'vitest';
import { countColours, parsePieces } from './pieces';

const sheet = `{"type":"FeatureCollection","bbox":[0,0,100,50],"features":[
{"type":"Feature","properties":{"id":"stone-1","colour":"#222222","area":100,"vertices":4,"orientation":90,"centroid":[5,5]},"geometry":{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
{"type":"Feature","properties":{"id":"stone-3","colour":"#e8e8e3","area":375,"vertices":4,"orientation":0,"centroid":[30,10]},"geometry":{"type":"Polygon","coordinates":[[[20,0],[40,0],[40,20],[20,20],[20,0]],[[25,5],[25,10],[30,10],[30,5],[25,5]]]}},
{"type":"Feature","properties":{"id":"stone-4","colour":"#222222","area":50,"vertices":3,"orientation":45,"centroid":[55,3]},"geometry":{"type":"Polygon","coordinates":[[[50,0],[60,0],[50,10],[50,0]]]}}
]}
`;

const pieces = parsePieces(new TextEncoder().encode(sheet));

test('pieces have their size, names and colours', () => {
  expect(pieces).toMatchObject({ width: 100, height: 50, count: 3, kind: 'stone', palette: ['#222222', '#e8e8e3'] });
  expect([...pieces.ids]).toEqual([1, 3, 4]);
  expect([...pieces.colours]).toEqual([0, 1, 0]);
  expect([...pieces.areas]).toEqual([100, 375, 50]);
  expect([...pieces.vertices]).toEqual([4, 4, 3]);
});

test('rings are open and lie one after another', () => {
  expect([...pieces.pieceStarts]).toEqual([0, 1, 3, 4]);
  expect([...pieces.ringStarts]).toEqual([0, 4, 8, 12, 15]);
  expect([...pieces.points.slice(0, 8)]).toEqual([0, 0, 10, 0, 10, 10, 0, 10]);
});

test('a point is a dot of its area', () => {
  const lines = [
    '{"type":"FeatureCollection","bbox":[0,0,20,10],"features":[',
    '{"type":"Feature","properties":{"id":"point-1","colour":"#000000","area":28.274,"vertices":24,"orientation":0},' +
      '"geometry":{"type":"Point","coordinates":[8,5]}}',
    ']}',
  ];
  const { count, points, ringStarts } = parsePieces(new TextEncoder().encode(lines.join('\n')));
  expect([count, ...ringStarts]).toEqual([1, 0, 16]);
  for (let k = 0; k < 16; ++k) expect(Math.hypot(points[2 * k]! - 8, points[2 * k + 1]! - 5)).toBeCloseTo(3, 3);
});

test('a sheet without pieces is empty, not an error', () => {
  const empty = '{"type":"FeatureCollection","bbox":[0,0,7,5],"features":[\n]}\n';
  expect(parsePieces(new TextEncoder().encode(empty))).toMatchObject({ width: 7, height: 5, count: 0 });
});

test('colours are counted, the most first', () => {
  const palette = ['#000000', '#ffffff', '#ff0000'];
  expect(countColours({ palette, colours: new Uint32Array([1, 2, 1, 0, 1, 2]) })).toEqual([
    { colour: '#ffffff', count: 3 },
    { colour: '#ff0000', count: 2 },
    { colour: '#000000', count: 1 },
  ]);
});
