import type { JobSchema } from 'tessera-wasm';
import { expect, test } from 'vitest';
import { differing, fieldsOf, parseValue, sameParams, stepOf, withValue, type Field } from './form';

const schema: JobSchema = {
  $defs: {
    paving: {
      title: 'paving',
      description: '',
      properties: {
        size: {
          title: 'Size',
          description: 'How large',
          type: 'number',
          default: 4,
          minimum: 1,
          maximum: 512,
          'x-ui-minimum': 2,
          'x-ui-maximum': 24,
          'x-unit': 'px',
          'x-symbol': 's_x',
        },
        angle: { title: 'Angle', description: '', type: 'integer', default: 0, minimum: 0, 'x-unit': 'deg' },
        method: {
          title: 'Method',
          description: '',
          type: 'string',
          default: 'flow',
          enum: ['flow', 'paper'],
          'x-enum-descriptions': ['new', 'old'],
          'x-advanced': true,
        },
        round: { title: 'Round', description: '', type: 'boolean', default: true },
      },
    },
  },
};

const fields = fieldsOf(schema, 'paving');
const field = (key: string): Field => fields.find((f) => f.key === key)!;

test('fields follow the schema, in its order', () => {
  expect(fields.map((f) => [f.key, f.kind])).toEqual([
    ['size', 'number'],
    ['angle', 'number'],
    ['method', 'choice'],
    ['round', 'toggle'],
  ]);
  expect(field('size')).toMatchObject({ min: 1, max: 512, low: 2, high: 24, step: 0.1, unit: 'px' });
  expect(field('size').symbol).toEqual({ base: 's', sub: 'x' });
  expect(field('angle')).toMatchObject({ whole: true, unit: '°', low: 0, symbol: null });
  expect(field('method')).toMatchObject({ advanced: true, choices: [{ value: 'flow', help: 'new' }, {}] });
});

test('a technique the schema does not have has no fields', () => expect(fieldsOf(schema, 'mosaic')).toEqual([]));

test('steps are round', () => {
  expect(stepOf(22, false)).toBe(0.1);
  expect(stepOf(1, false)).toBe(0.01);
  expect(stepOf(6, true)).toBe(1);
  expect(stepOf(50000, true)).toBe(100);
});

test('only what differs from a default is kept', () => {
  const changed = withValue({}, field('size'), 6);
  expect(changed).toEqual({ size: 6 });
  expect(withValue(changed, field('size'), 4)).toEqual({});
  expect(differing(fields, { size: 4, method: 'paper', unknown: 1 })).toEqual({ method: 'paper' });
});

test('text becomes a value of the right type, or nothing', () => {
  expect(parseValue(field('size'), '6.5')).toBe(6.5);
  expect(parseValue(field('size'), 'six')).toBeUndefined();
  expect(parseValue(field('size'), ' ')).toBeUndefined();
  expect(parseValue(field('round'), 'false')).toBe(false);
  expect(parseValue(field('method'), 'paper')).toBe('paper');
});

test('params are compared by content', () => {
  expect(sameParams({ a: 1, b: 2 }, { b: 2, a: 1 })).toBe(true);
  expect(sameParams({ a: 1 }, { a: 2 })).toBe(false);
  expect(sameParams({ a: 1 }, { a: 1, b: 2 })).toBe(false);
});
