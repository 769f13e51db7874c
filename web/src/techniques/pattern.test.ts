import { expect, test } from 'vitest';
import { schema } from 'tessera-wasm/description';
import { fieldsOf } from '../state/form';
import { pattern } from './pattern';

const fields = fieldsOf(schema, 'pattern');
const choicesOf = (key: string) => {
  const field = fields.find((f) => f.key === key);
  return field?.kind === 'choice' ? field.choices.map(({ value }) => value) : [];
};
const shown = (params: Record<string, string | number>) =>
  fields.map(({ key }) => key).filter((key) => pattern.matters?.(key, params));

test('every parameter matters to some pattern, and the model to each', () => {
  const all = new Set<string>();
  for (const model of choicesOf('model')) {
    for (const process of choicesOf('process')) {
      const keys = shown({ model, process, variation: 'cell', border: 1 });
      expect(keys).toContain('model');
      for (const key of keys) all.add(key);
    }
  }
  expect(fields.map(({ key }) => key).filter((key) => !all.has(key))).toEqual([]);
});

test('what is for other models and processes is not shown', () => {
  expect(shown({})).not.toContain('length');
  expect(shown({})).not.toContain('family');
  expect(shown({ process: 'cluster' })).toContain('family');
  expect(shown({ model: 'hexagon', process: 'cluster' })).not.toContain('family');
  expect(shown({ model: 'circles' })).toEqual(expect.arrayContaining(['length', 'process', 'sizeVariation']));
  expect(shown({ border: 2 })).toContain('borderColor');
  expect(shown({})).not.toContain('borderColor');
});

test('a picture of densities finds points to place', () => {
  expect(pattern.forDensity?.({ process: 'cox', model: 'circles' })).toEqual({ process: 'cox', model: 'circles' });
  expect(pattern.forDensity?.({ process: 'cox', model: 'hexagon' })).toMatchObject({
    process: 'cox',
    model: 'points',
  });
});
