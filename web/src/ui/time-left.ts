/** "4 s left", or nothing where it is too early to say or too little to matter. */
export function timeLeft(fraction: number, elapsed: number): string {
  if (fraction < 0.08 || elapsed < 400) return '';
  const seconds = ((1 - fraction) / fraction) * (elapsed / 1000);
  if (seconds < 1) return '';
  if (seconds < 90) return `${Math.round(seconds)} s left`;
  return `${Math.round(seconds / 60)} min left`;
}
