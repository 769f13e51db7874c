import type { Rgba } from './preview';

/** Of "#rrggbb". */
export function rgbaOf(hex: string): Rgba {
  const n = parseInt(hex.slice(1), 16);
  return [(n >> 16) & 255, (n >> 8) & 255, n & 255, 255];
}
