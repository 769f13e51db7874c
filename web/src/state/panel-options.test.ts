import { expect, test } from 'vitest';
import {
  isPanelName,
  onlyOf,
  panelName,
  readPanelOptions,
  renamed,
  withOption,
  writePanelOptions,
} from './panel-options';

const text = 'oak dpi=300 margin=5; walnut machine=10:10,160:10,10:110';

test('what is read is written', () => {
  expect(readPanelOptions(text).get('walnut')).toEqual({ machine: '10:10,160:10,10:110' });
  expect(writePanelOptions(readPanelOptions(text))).toBe(text);
  expect(readPanelOptions(' ;\n ').size).toBe(0);
});

test('an option is set, changed and taken out', () => {
  expect(withOption('', 'oak', 'dpi', '600')).toBe('oak dpi=600');
  expect(readPanelOptions(withOption(text, 'oak', 'dpi', '200')).get('oak')).toEqual({ margin: '5', dpi: '200' });
  expect(withOption('oak dpi=600', 'oak', 'dpi', '')).toBe('');
});

test('panels are renamed and removed', () => {
  expect(renamed(text, 'oak', 'ash')).toBe(text.replace('oak', 'ash'));
  expect(renamed(text, 'walnut', null)).toBe('oak dpi=300 margin=5');
  expect(onlyOf(text, ['walnut', 'elm'])).toBe('walnut machine=10:10,160:10,10:110');
});

test('files become names, none twice', () => {
  expect(panelName('Oak board (2).jpg', [])).toBe('Oak-board-2');
  expect(panelName('oak.png', ['oak'])).toBe('oak-2');
  expect(panelName('樫.png', [])).toBe('panel');
  expect(isPanelName(panelName('ä'.repeat(90), []))).toBe(true);
  expect(isPanelName('oak 1')).toBe(false);
});
