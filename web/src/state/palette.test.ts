import { expect, test } from 'vitest';
import { paletteText, parsePalette, readTiles } from './palette';

test('the three kinds, there and back', () => {
  for (const text of ['', '12', 'warm chalk #f4f1e8, #8c4a32']) expect(paletteText(parsePalette(text))).toBe(text);
  expect(parsePalette(' 12 ')).toEqual({ kind: 'number', count: 12 });
  expect(parsePalette('warm chalk #f4f1e8, #8c4a32')).toEqual({
    kind: 'list',
    tiles: [
      { name: 'warm chalk', colour: '#f4f1e8' },
      { name: '', colour: '#8c4a32' },
    ],
  });
});

test('a name cannot end its entry or begin a colour', () => {
  const tiles = [{ name: 'a, b; #fff\nc', colour: '#010203' }];
  expect(paletteText({ kind: 'list', tiles })).toBe('a b fff c #010203');
});

test('lists as shops have them', () => {
  const chalk = [{ name: 'Chalk 12', colour: '#f4f1e8' }];
  for (const line of [
    'Chalk 12 #F4F1E8',
    '#f4f1e8 Chalk 12',
    '"Chalk 12";"#f4f1e8"',
    'Chalk 12\t#f4f1e8',
    'Chalk 12: #f4f1e8',
  ])
    expect(readTiles(line)).toEqual(chalk);
  expect(readTiles('Brick, 140, 74, 50\nSnow - rgb(255,250,250)')).toEqual([
    { name: 'Brick', colour: '#8c4a32' },
    { name: 'Snow', colour: '#fffafa' },
  ]);
  expect(readTiles('white #fff, black #000')).toEqual([
    { name: 'white', colour: '#ffffff' },
    { name: 'black', colour: '#000000' },
  ]);
});

test('what is no colour is none', () => {
  expect(readTiles('no colours here\n300 1 2\n#12345\n#1234567')).toEqual([]);
});
