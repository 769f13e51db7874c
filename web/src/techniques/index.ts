// The tabs, in order. A technique that the engine does not have yet is shown, and says so.

import type { TechniqueEntry } from './entry';
import { mosaic } from './mosaic';
import { parquetry } from './parquetry';
import { pattern } from './pattern';
import { pavement } from './pavement';
import { pebbles } from './pebbles';

export const techniques: readonly TechniqueEntry[] = [pavement, mosaic, pebbles, pattern, parquetry];

export const entryOf = (name: string): TechniqueEntry | undefined => techniques.find((t) => t.name === name);
