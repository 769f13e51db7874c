import { beforeEach, expect, test, vi } from 'vitest';
import { drawnPictures, kNothingDrawn, type Drawn } from './drawn';

const line = [
  { x: 1, y: 2 },
  { x: 30, y: 40 },
];
const size = { width: 90, height: 60 };
let made: { width: number; height: number; fills: string[]; strokes: string[] }[];

beforeEach(() => {
  made = [];
  vi.stubGlobal('Path2D', class {});
  vi.stubGlobal(
    'OffscreenCanvas',
    class {
      private readonly log;
      constructor(width: number, height: number) {
        this.log = { width, height, fills: [] as string[], strokes: [] as string[] };
        made.push(this.log);
      }
      getContext() {
        const { log } = this;
        return {
          fillStyle: '',
          strokeStyle: '',
          lineWidth: 0,
          beginPath() {},
          moveTo() {},
          lineTo() {},
          fillRect() {
            log.fills.push(this.fillStyle);
          },
          stroke() {
            log.strokes.push(`${this.strokeStyle} ${this.lineWidth}`);
          },
        };
      }
      convertToBlob() {
        return Promise.resolve(new Blob());
      }
    },
  );
});

test('nothing drawn, no pictures', async () => {
  expect(await drawnPictures(kNothingDrawn, size)).toEqual([]);
  expect(made).toEqual([]);
});

test('guides are black lines on white, regions their colours on that of the figure, of the size of the picture', async () => {
  const drawn: Drawn = {
    ...kNothingDrawn,
    guides: [line, line],
    regions: [{ width: 12, colour: '#0000ff', points: line }],
  };
  const pictures = await drawnPictures(drawn, size);
  expect(pictures.map(({ role, name }) => [role, name])).toEqual([
    ['edges', 'edges.png'],
    ['regions', 'regions.png'],
  ]);
  expect(made).toEqual([
    { ...size, fills: ['#ffffff'], strokes: ['#000 3', '#000 3'] },
    { ...size, fills: ['#00ff00'], strokes: ['#0000ff 12'] },
  ]);
});

test('a picture of densities goes as it is', async () => {
  const density = { name: 'dark.png', blob: new Blob(['x']) };
  expect(await drawnPictures({ ...kNothingDrawn, density }, size)).toEqual([{ role: 'density', ...density }]);
  expect(made).toEqual([]);
});

test('the same drawing is made once, anew for another size or another drawing', async () => {
  const drawn: Drawn = { ...kNothingDrawn, guides: [line], regions: [] };
  const [first] = await drawnPictures(drawn, size);
  const [again] = await drawnPictures({ ...drawn, regions: [] }, size);
  expect(again?.blob).toBe(first?.blob);
  const [larger] = await drawnPictures(drawn, { width: 180, height: 120 });
  expect(larger?.blob).not.toBe(first?.blob);
  await drawnPictures({ ...drawn, guides: [line] }, { width: 180, height: 120 });
  expect(made.length).toBe(3);
});

test('edges count where nobody has painted; a file of shapes is as it is', async () => {
  const edgeMask = [{ width: 9, colour: '#000000', points: line }];
  const blob = new Blob(['shapes']);
  const drawn: Drawn = { ...kNothingDrawn, edgeMask, shapes: { name: 'shapes.svg', blob } };
  const pictures = await drawnPictures(drawn, size);
  expect(pictures.map(({ role, name }) => [role, name])).toEqual([
    ['segmentation', 'shapes.svg'],
    ['edge-mask', 'edge-mask.png'],
  ]);
  expect(pictures[0]!.blob).toBe(blob);
  expect(made).toEqual([{ width: 90, height: 60, fills: ['#ffffff'], strokes: ['#000000 9'] }]);
});
