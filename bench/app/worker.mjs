// Answers with the milliseconds of each run, from pixels to the file's bytes.
import { createTessera } from '/package/index.js';

onmessage = async ({ data: { technique, role, format, bytes, count, threads } }) => {
  const file = await (await fetch(`data:image/png;base64,${bytes}`)).blob();
  const bitmap = await createImageBitmap(file);
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  const tessera = await createTessera({ threads });
  tessera.setInput(role, context.getImageData(0, 0, bitmap.width, bitmap.height));
  const job = tessera.readJob(JSON.stringify({ schemaVersion: 1, technique }));
  const times = [];
  for (let i = 0; i < count; ++i) {
    const begin = performance.now();
    tessera.run(job, { backend: 'cpu' });
    tessera.artifact(format);
    times.push(performance.now() - begin);
  }
  postMessage(times);
};
