// A field of pebbles from above beside its photo, and how alike the two are.
import { basename, dirname, join } from 'node:path';
import { root } from '../root.mjs';
import { withPage } from './chromium.mjs';

/** Both as { width, height, rgba }. `metres`: the photo's width in the GLB. */
export function topView(glb, photo, metres = 1) {
  const roots = {
    '/three/': join(root, 'node_modules/three'),
    '/glb/': dirname(glb),
    '/photo/': dirname(photo),
    '/': join(root, 'tests/e2e/browser'),
  };
  return withPage({ roots, isolated: false }, async (page, host) => {
    await page.goto(`${host.address}/top_view.html`);
    await page.waitForFunction(() => window.ready);
    const { width, height, pixels } = await page.evaluate(
      (file) => window.readPhoto(file),
      `/photo/${basename(photo)}`,
    );
    const drawn = await page.evaluate(
      (words) => window.drawTopView(...words),
      [`/glb/${basename(glb)}`, width, height, metres],
    );
    const image = (text) => ({ width, height, rgba: Buffer.from(text, 'base64') });
    return { photo: image(pixels), field: image(drawn) };
  });
}

/** Lightness, 0 to 255, of every pixel (Rec. 601). */
export const luma = ({ rgba }) =>
  Float64Array.from({ length: rgba.length / 4 }, (_, i) =>
    Math.round(0.299 * rgba[4 * i] + 0.587 * rgba[4 * i + 1] + 0.114 * rgba[4 * i + 2]),
  );

/**
 * The mean structural similarity of two pictures' lightness over the pixels for which `counts(i)` is true, by windows
 * of 7 by 7 pixels within the picture (Wang et al. 2004, with unbiased variances).
 */
export function similarity(a, b, width, height, counts) {
  const [c1, c2, half, n] = [(0.01 * 255) ** 2, (0.03 * 255) ** 2, 3, 49];
  let [sum, count] = [0, 0];
  for (let y = half; y < height - half; ++y) {
    for (let x = half; x < width - half; ++x) {
      if (!counts(y * width + x)) continue;
      let [ma, mb, aa, bb, ab] = [0, 0, 0, 0, 0];
      for (let v = y - half; v <= y + half; ++v) {
        for (let i = v * width + x - half; i <= v * width + x + half; ++i) {
          [ma, mb] = [ma + a[i], mb + b[i]];
          [aa, bb, ab] = [aa + a[i] * a[i], bb + b[i] * b[i], ab + a[i] * b[i]];
        }
      }
      [ma, mb] = [ma / n, mb / n];
      const [va, vb, vab] = [aa - n * ma * ma, bb - n * mb * mb, ab - n * ma * mb].map((s) => s / (n - 1));
      sum += ((2 * ma * mb + c1) * (2 * vab + c2)) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
      ++count;
    }
  }
  return sum / count;
}
