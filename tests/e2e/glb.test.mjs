// The native program's GLB before others: Khronos' validator, and three.js, which draws it from above beside its photo.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { validateBytes } from 'gltf-validator';
import { closeBrowser } from './browser/chromium.mjs';
import { luma, similarity, topView } from './browser/top_view.mjs';
import { inFolder, native } from './native.mjs';
import { root } from './root.mjs';

after(closeBrowser);

const sample = join(root, 'public/samples/pebbles.png');

test('the validator finds no fault with any kind of field', async () => {
  const kinds = [
    '--lod 3 --flatten 0.5',
    '--lod 2 --relief 1 --normal-map --quantize',
    '--lod 1 --layout merged --ground --ground-hole',
    '--lod 2 --layout both --collider hull',
    '--scatter 500',
    '--scatter 500 --strewing cluster --instancing false --collider hull',
    '--scatter 500 --collider hull --ground',
    '--lod 1 --flatten 0.5 --relief 1 --normal-map --quantize --layout both --ground --collider hull --scatter 500',
  ];
  await inFolder(async (folder) => {
    for (const kind of kinds) {
      const glb = join(folder, 'field.glb');
      native('pebbles', sample, '-o', glb, ...kind.split(' '));
      const { issues, info } = await validateBytes(new Uint8Array(readFileSync(glb)));
      assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], `${kind}: ${JSON.stringify(issues.messages)}`);
      assert.ok(info.totalTriangleCount > 1000, kind);
    }
  });
});

test('from above the pebbles look as in the photo', async () => {
  await inFolder(async (folder) => {
    const glb = join(folder, 'field.glb');
    native('pebbles', sample, '-o', glb);
    const { photo, field } = await topView(glb, sample);
    const drawn = (i) => field.rgba[4 * i + 3] === 255;
    const [before, after] = [luma(photo), luma(field)];
    assert.ok(before.filter((_, i) => drawn(i)).length > before.length / 2, 'most of the photo is pebbles');
    const alike = similarity(before, after, photo.width, photo.height, drawn);
    assert.ok(alike > 0.9, alike);
  });
});
