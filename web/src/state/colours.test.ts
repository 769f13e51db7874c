import { expect, test } from 'vitest';
import { coloursText, partsOf, readColours, sharesText, withColour, withNewColour, withoutColour } from './colours';

test('colours and shares, there and back', () => {
  const list = readColours('#B5533C, #fff\n#010203', '0.5 1 0.5')!;
  expect(coloursText(list)).toBe('#b5533c #ffffff #010203');
  expect(sharesText(list)).toBe('0.5 1 0.5');
  expect(partsOf(list)).toEqual([0.25, 0.5, 0.25]);
});

test('without shares all are alike', () => {
  const list = readColours('#111111 #222222', ' ')!;
  expect(sharesText(list)).toBe('');
  expect(partsOf(list)).toEqual([0.5, 0.5]);
});

test('what is no list of colours is none', () => {
  for (const [colours, shares] of [
    ['', ''],
    ['red', ''],
    ['#12345', ''],
    ['#111 #222', '1'],
    ['#111 #222', '1 0'],
    ['#111 #222', '1 x'],
  ] as const)
    expect(readColours(colours, shares)).toBeNull();
});

test('a colour takes its share with it, and a new one gets the mean', () => {
  const list = readColours('#111111 #222222 #333333', '1 2 3')!;
  expect(withoutColour(list, 1)).toEqual({ colours: ['#111111', '#333333'], shares: [1, 3] });
  expect(withNewColour(list, '#444444').shares).toEqual([1, 2, 3, 2]);
  expect(withColour(list, 0, '#abcdef')).toEqual({ colours: ['#abcdef', '#222222', '#333333'], shares: [1, 2, 3] });
  const alike = readColours('#111111 #222222', '')!;
  expect(withNewColour(alike, '#444444').shares).toEqual([]);
});
