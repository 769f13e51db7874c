// Paves a picture with WebGL2 in a canvas of this worker, which loses its context after the iteration `loseAt`.
import { createTessera } from '/package/index.js';

onmessage = async ({ data: { address, threads, loseAt } }) => {
  const bitmap = await createImageBitmap(await (await fetch(address)).blob());
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);

  const tessera = await createTessera({ threads });
  const canvas = new OffscreenCanvas(1, 1);
  const graphics = tessera.useCanvas(canvas);
  tessera.setInput('drawing', context.getImageData(0, 0, bitmap.width, bitmap.height));
  const job = tessera.readJob('{"schemaVersion": 1, "technique": "pavement", "params": {"iterations": 5}}');
  const warnings = [];
  const result = tessera.run(job, {
    backend: 'gl',
    onWarning: (message) => warnings.push(message),
    onIteration: ({ index }) => {
      if (index === loseAt) canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext();
    },
  });
  postMessage({ graphics, result, warnings, svg: new TextDecoder().decode(tessera.artifact('svg').bytes) });
};
