// Paves a black disc. In a browser the pixels come from a canvas: context.getImageData(0, 0, width, height).
import { createTessera } from 'tessera-wasm';

const size = 120;
const data = new Uint8Array(4 * size * size).fill(255);
for (let i = 0; i < size * size; ++i)
  if (Math.hypot((i % size) - size / 2, Math.floor(i / size) - size / 2) < size / 3) data.fill(0, 4 * i, 4 * i + 3);

const tessera = await createTessera({ threads: 1 });
tessera.setInput('drawing', { data, width: size, height: size });
const job = tessera.readJob('{"schemaVersion": 1, "technique": "pavement", "params": {"halfSide": 3}}');
const { counts } = tessera.run(job);
console.log(`${counts.stones} stones`);
console.log(new TextDecoder().decode(tessera.artifact('svg').bytes));
