// What presets.json says, which scripts/make_presets.py reads, too.

import type { Preset } from './entry';
import presets from './presets.json';

export const presetsOf = (technique: keyof typeof presets): readonly Preset[] =>
  presets[technique] as unknown as readonly Preset[]; // JSON's types are narrower than a parameter's
