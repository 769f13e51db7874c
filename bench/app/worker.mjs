// Answers with the milliseconds of each run, from pixels to the file's bytes.
import { createTessera } from '/package/index.js';

async function pixelsOf(bytes) {
  const file = await (await fetch(`data:image/png;base64,${bytes}`)).blob();
  const bitmap = await createImageBitmap(file);
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height);
}

onmessage = async ({ data: { technique, params, pictures, format, count, threads } }) => {
  const tessera = await createTessera({ threads });
  for (const [role, bytes] of pictures) tessera.setInput(role, await pixelsOf(bytes));
  const times = [];
  for (let i = 0; i < count; ++i) {
    // The core keeps how the wood was laid: another kerf, by a ten thousandth of a millimetre, and it begins anew.
    const own = technique === 'parquetry' ? { ...params, kerfMm: 0.2 + 1e-4 * i } : params;
    const job = tessera.readJob(JSON.stringify({ schemaVersion: 1, technique, params: own }));
    const begin = performance.now();
    tessera.run(job, { backend: 'cpu' });
    format === 'folder' ? tessera.artifacts(format) : tessera.artifact(format);
    times.push(performance.now() - begin);
  }
  postMessage(times);
};
