// Two SVGs of stones, piece by piece.
import assert from 'node:assert/strict';

function stonesOf(svg) {
  const stones = new Map();
  for (const [, attributes] of svg.matchAll(/<path ([^>]*)\/>/g)) {
    const id = /id="([^"]+)"/.exec(attributes)[1];
    const d = /\bd="([^"]+)"/.exec(attributes)[1];
    stones.set(id, { fill: /fill="([^"]+)"/.exec(attributes)[1], numbers: d.match(/-?[\d.]+/g).map(Number) });
  }
  return stones;
}

/** The same stones with the same colours, vertices within 0.01 px. */
export function assertSameStones(one, other) {
  const a = stonesOf(one);
  const b = stonesOf(other);
  assert.ok(a.size > 0, 'there are no stones');
  assert.equal(a.size, b.size, 'numbers of stones differ');
  for (const [id, stone] of a) {
    const twin = b.get(id);
    assert.ok(twin, `${id} is in one only`);
    assert.equal(stone.fill, twin.fill, id);
    assert.equal(stone.numbers.length, twin.numbers.length, id);
    stone.numbers.forEach((value, i) => assert.ok(Math.abs(value - twin.numbers[i]) <= 0.0101, `${id}: ${value}`));
  }
}
