// The package as a third party imports it in node: what it makes, and that the native program makes the same.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { createTessera, TesseraError } from 'tessera-wasm';
import { root } from './root.mjs';
import { assertSameStones } from './same_stones.mjs';

const tessera = join(root, 'build/native-release/bin/tessera');

/** A black disc on white: the pixels, and the same as a BMP file. */
function disc(size) {
  const data = new Uint8Array(4 * size * size).fill(255);
  const file = Buffer.alloc(54 + data.length);
  file.write('BM');
  file.writeUInt32LE(file.length, 2);
  file.writeUInt32LE(54, 10);
  file.writeUInt32LE(40, 14);
  file.writeInt32LE(size, 18);
  file.writeInt32LE(-size, 22); // rows from the top
  file.writeUInt16LE(1, 26);
  file.writeUInt16LE(32, 28);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) {
      const inside = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) < size / 3;
      if (inside) data.fill(0, 4 * (y * size + x), 4 * (y * size + x) + 3);
    }
  }
  file.set(data, 54);
  return { picture: { data, width: size, height: size }, file };
}

const [black, white] = ['#222222', '#e8e8e4'].map((colour) => colour.match(/\w\w/g).map((c) => parseInt(c, 16))); // stones

const text = (bytes) => new TextDecoder().decode(bytes);

for (const threads of [1, 2]) {
  test(`makes what the native program makes, with ${threads} thread(s)`, async () => {
    const core = await createTessera({ threads });
    assert.equal(core.threads, threads);
    assert.equal(core.version, readFileSync(join(root, 'VERSION'), 'utf8').trim());
    const { picture, file } = disc(200);
    const job = core.readJob('{"schemaVersion": 1, "technique": "pavement", "inputs": {"drawing": "disc.bmp"}}');
    core.setInput('drawing', picture);
    const result = core.run(job);
    assert.equal(result.backend, 'cpu');
    const svg = text(core.artifact('svg').bytes);

    const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
    try {
      writeFileSync(join(folder, 'disc.bmp'), file);
      writeFileSync(join(folder, 'job.json'), JSON.stringify(job));
      execFileSync(tessera, ['run', join(folder, 'job.json'), '-o', join(folder, 'stones.svg'), '--backend', 'cpu', '--quiet']);
      assertSameStones(svg, readFileSync(join(folder, 'stones.svg'), 'utf8'));
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
}

test('reports stages, progress and iterations, and draws them', async () => {
  const core = await createTessera({ threads: 1 });
  core.setInput('drawing', disc(120).picture);
  const job = core.readJob('{"schemaVersion": 1, "technique": "pavement", "params": {"iterations": 3}}');
  const seen = { stages: [], progress: [], iterations: [], previews: [] };
  let late;
  core.run(job, {
    onStage: (name) => seen.stages.push(name),
    onProgress: (fraction) => seen.progress.push(fraction),
    onIteration: (iteration) => {
      late = iteration;
      seen.iterations.push(iteration.index);
      seen.previews.push(iteration.draw(5000, 50));
    },
  });
  assert.deepEqual(seen.iterations, [0, 1, 2, 3]);
  assert.ok(seen.stages.includes('diagram'));
  assert.equal(seen.progress.at(-1), 1);
  assert.deepEqual(seen.progress, seen.progress.toSorted((a, b) => a - b));
  for (const { width, height, cells, sites, palette } of seen.previews) {
    assert.ok(width * height <= 5000 && cells.length === width * height);
    assert.ok(sites.length > 0 && sites.length <= 4 * 50);
    assert.deepEqual([...palette], [...black, ...white]);
  }
  assert.throws(() => late.draw(1, 1), /only during onIteration/);
});

test('names every problem with its field', async () => {
  const core = await createTessera({ threads: 1 });
  const job = { schemaVersion: 1, technique: 'pavement', seed: 1, params: { halfSide: 0, colors: 99 }, inputs: {} };
  assert.deepEqual(core.validate(job).map((problem) => problem.field), ['halfSide', 'colors']);
  assert.throws(() => core.readJob('no job'), TesseraError);
  assert.throws(() => core.setInput('drawing', { data: new Uint8Array(3), width: 1, height: 1 }), TesseraError);
  assert.throws(() => core.artifact('svg'), TesseraError);
  const good = core.readJob('{"schemaVersion": 1, "technique": "pavement"}');
  assert.throws(() => core.run(good), /drawing is missing/);
  core.setInput('drawing', disc(40).picture);
  core.run(good);
  assert.throws(() => core.artifact('labels.png'), TesseraError);
});

test('stops when it is told to', async () => {
  const core = await createTessera({ threads: 2 });
  core.setInput('drawing', disc(200).picture);
  const job = core.readJob('{"schemaVersion": 1, "technique": "pavement"}');
  const stopAtTheSecond = ({ index }) => index === 1 && Atomics.store(core.stopFlag, 0, 1);
  assert.throws(() => core.run(job, { onIteration: stopAtTheSecond }), (error) => error.problems[0].code === 'cancelled');
  assert.ok(core.run(job).counts.stones > 0);
});

const pattern = (params) => ({ schemaVersion: 1, technique: 'pattern', seed: 3, params, inputs: {} });

/** What `tessera COMMAND` reports of a file with these bytes. */
function nativeReport(command, name, bytes) {
  const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
  try {
    writeFileSync(join(folder, name), bytes);
    const { tessera: _, technique, inputs, seed, ...report } = JSON.parse(execFileSync(tessera, [command, join(folder, name)]));
    return report;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Squares in black and white by chance, a little turned: the pixels, and the same as a BMP file. */
function board(size, side) {
  const { picture, file } = disc(size);
  const [cos, sin] = [Math.cos(0.3), Math.sin(0.3)];
  for (let i = 0; i < size * size; ++i) {
    const [x, y] = [i % size, Math.floor(i / size)];
    const [u, v] = [x * cos + y * sin, y * cos - x * sin].map((along) => Math.floor(along / side));
    const level = Math.sin(u * 12.9898 + v * 78.233) * 43758.5453;
    picture.data.fill(level - Math.floor(level) < 0.5 ? 0 : 255, 4 * i, 4 * i + 3);
  }
  file.set(picture.data, 54);
  return { picture, file };
}

for (const threads of [1, 2]) {
  test(`measures and fits as the native program does, with ${threads} thread(s)`, async () => {
    const core = await createTessera({ threads });
    for (const params of [{ model: 'occupancy' }, { model: 'hexagon', size: 17 }, { model: 'points', size: 11 }]) {
      core.run(core.readJob(JSON.stringify(pattern(params))));
      const { bytes } = core.artifact('svg');
      const { report, csv, plots } = core.measure(bytes);
      assert.deepEqual(report, nativeReport('measure', 'pattern.svg', bytes));
      assert.equal(csv.trim().split('\n').length, 25);
      const [first] = plots;
      assert.equal(first.series.length, 2, 'what was measured, and the closed form');
      assert.equal(first.series[0].points.length, 24);
      assert.match(first.svg, /^<\?xml|^<svg/);
      if (params.model !== 'points') {
        assert.deepEqual(plots.map(({ name }) => name), ['same_cell', 'areas', 'sides']);
        const { bins, series } = plots[2];
        assert.equal(bins.length, series[0].values.length);
      }
    }
    const { picture, file } = board(240, 12);
    assert.deepEqual(core.measure(picture).report, nativeReport('measure', 'board.bmp', file));
    const progress = [];
    const fit = core.fit(picture, { onProgress: (fraction) => progress.push(fraction) });
    assert.deepEqual(fit, nativeReport('fit', 'board.bmp', file));
    assert.equal(fit.model, 'checkerboard');
    assert.equal(progress.at(-1), 1);
    assert.ok(core.run(fit.job).counts.cells > 300);
  });
}

test('names what cannot be measured or fitted', async () => {
  const core = await createTessera({ threads: 1 });
  const problems = (act) => {
    try {
      act();
    } catch (error) {
      return error.problems.map(({ field }) => field);
    }
    return [];
  };
  const points = new TextEncoder().encode('x,y\n1,2\n3,4\n7,3\n');
  assert.equal(core.measure(points).report.kind, 'points');
  const wrong = { model: 'cheese', distances: [1, -1], needles: 0.5, colors: 1, window: [1], seed: -1 };
  assert.deepEqual(problems(() => core.measure(points, wrong)), ['model', 'lambda', 'distances', 'window', 'needles', 'colors', 'seed']);
  assert.deepEqual(problems(() => core.measure(points, { seed: null, colors: 'x' })), ['colors', 'seed']);
  assert.throws(() => core.measure(new TextEncoder().encode('cheese')), /neither/);
  assert.throws(() => core.measure(new Uint8Array()), /empty/);
  assert.throws(() => core.measure({ data: new Uint8Array(3), width: 1, height: 1 }), TesseraError);
  assert.throws(() => core.fit({ data: new Uint8Array(4), width: 1, height: 1 }), /smaller than 32/);
  assert.throws(() => core.fit({ data: new Uint8Array(4 * 64 * 64).fill(255), width: 64, height: 64 }), /one colour/);
  assert.throws(() => core.fit(board(64, 8).picture, { seed: -1 }), /seed/);
});

test('statistics and fits stop when they are told to', async () => {
  const core = await createTessera({ threads: 2 });
  const { picture } = board(240, 12);
  const stop = () => Atomics.store(core.stopFlag, 0, 1);
  const cancelled = (error) => error.problems[0].code === 'cancelled';
  assert.throws(() => core.fit(picture, { onStage: (stage) => stage === 'models' && stop() }), cancelled);
  assert.throws(() => core.measure(picture, { onStage: (stage) => stage === 'needles' && stop() }), cancelled);
  core.run(core.readJob(JSON.stringify(pattern({ model: 'occupancy' }))));
  const { bytes } = core.artifact('svg');
  assert.throws(() => core.measure(bytes, { onProgress: stop }), cancelled);
  assert.equal(core.measure(bytes).report.kind, 'cells');
});

test('the example works', () => {
  const output = execFileSync('node', [join(root, 'web/package/examples/pave.mjs')], { encoding: 'utf8' });
  assert.match(output, /^\d+ stones\n<\?xml [^>]*>\n<svg /);
});

test('packs into one file that works where nothing else is', () => {
  const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
  try {
    const [packed] = JSON.parse(
      execFileSync('npm', ['pack', '--json', '--ignore-scripts', '--pack-destination', folder], {
        cwd: join(root, 'web/package'),
        encoding: 'utf8',
      }),
    );
    assert.equal(packed.version, readFileSync(join(root, 'VERSION'), 'utf8').trim());
    const names = packed.files.map(({ path }) => path);
    const besides = names.filter((name) => !name.startsWith('dist/')).sort();
    assert.deepEqual(besides, ['LICENSE', 'NOTICE', 'README.md', 'examples/pave.mjs', 'package.json']);
    for (const name of ['index.js', 'index.d.ts', 'api.d.ts', 'parameters.d.ts', 'description.js', 'description.d.ts'])
      assert.ok(names.includes(`dist/${name}`), name);
    for (const variant of ['threads', 'single'])
      for (const ending of ['js', 'mjs', 'wasm'])
        assert.ok(names.includes(`dist/engine/tessera-${variant}.${ending}`), `${variant}.${ending}`);

    const installed = join(folder, 'node_modules/tessera-wasm');
    mkdirSync(installed, { recursive: true });
    execFileSync('tar', ['-xzf', join(folder, packed.filename), '--strip-components=1', '-C', installed]);
    copyFileSync(join(installed, 'examples/pave.mjs'), join(folder, 'pave.mjs'));
    const output = execFileSync('node', [join(folder, 'pave.mjs')], { encoding: 'utf8' });
    assert.match(output, /^\d+ stones\n<\?xml /);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('a morphed grid relaxes step by step, and is laid as a job has it', async () => {
  const core = await createTessera({ threads: 1 });
  const { picture } = disc(120);
  core.setInput('target', picture);
  core.setInput('panel-oak', { ...picture, dpi: 50 });
  const params = { imageSizeMm: 60, patchMm: 10, grid: 'morphed' };
  const begin = (more) => core.beginGrid(core.readJob(JSON.stringify({ schemaVersion: 1, technique: 'parquetry', params: { ...params, ...more } })));
  const settled = (grid) => {
    let steps = 0;
    for (let more = 1; more > 0; steps += more) more = grid.step(7);
    return steps;
  };
  const grid = begin({});
  assert.deepEqual([grid.across, grid.down, Math.round(grid.widthMm)], [6, 6, 60]);
  const even = [...grid.vertices()];
  assert.equal(even.length, 2 * 49);
  assert.ok(settled(grid) > 10);
  assert.notDeepEqual([...grid.vertices()], even);
  const { width, height, found, counting } = grid.edges();
  assert.equal(found.length, width * height);
  assert.ok(found.some((kind) => kind > 0));
  assert.deepEqual(counting, found);
  const [x, y] = grid.vertices().slice(2 * 24);
  for (let i = 0; i < 60; ++i) {
    grid.drag(3, 3, x + 1.5, y - 1);
    grid.step(1);
  }
  const pins = grid.lay();
  assert.match(pins, /^3,3:/);
  const laid = [...grid.vertices()];
  const again = begin({ pins });
  settled(again);
  assert.deepEqual([...again.vertices()], laid);
  assert.throws(() => begin({ pins: '9,9:1,1' }), (error) => error instanceof TesseraError && error.problems[0].field === 'pins');
  assert.throws(() => begin({ grid: 'regular' }), TesseraError);
});

test('closed shapes of an SVG are painted as numbers', async () => {
  const core = await createTessera({ threads: 1 });
  const { data, width, height } = core.paintShapes('<svg viewBox="0 0 2 1"><rect width="1" height="1"/></svg>');
  const number = (x) => data.slice(4 * x, 4 * x + 4);
  assert.equal(width, 2 * height);
  assert.deepEqual([...number(0)], [0, 0, 1, 255]);
  assert.deepEqual([...number(width - 1)], [0, 0, 0, 255]);
  assert.throws(() => core.paintShapes('<svg viewBox="0 0 2 1"><path d="M0 0L1 0L1 1"/></svg>'), /closed/);
});
