"""Drives `tessera parquet` as its users do."""
import csv
import json
import os
import random
import re
import signal
import struct
import subprocess
import unittest
import xml.etree.ElementTree as xml

from cli import PROGRAM, CliTest, chunk, png

SVG = '{http://www.w3.org/2000/svg}'


def wood(width, height, seed, dpi=None, base=140):
    """A grey board with grain along x, that says its resolution."""
    generator = random.Random(seed)
    rows = [base + generator.randint(-50, 50) for _ in range(height)]
    noise = [generator.randint(-9, 9) for _ in range(997)]
    picture = png(width, height, lambda x, y: max(0, min(255, rows[y] + noise[(x * 7 + y * 131) % 997] + x * 60 // width)))
    if dpi is None:
        return picture
    per_metre = round(dpi / 0.0254)
    return picture[:33] + chunk(b'pHYs', struct.pack('>IIB', per_metre, per_metre, 1)) + picture[33:]


def disc_png(size):
    return png(size, size, lambda x, y: 40 if (x - size / 2) ** 2 + (y - size / 2) ** 2 < size * size / 9 else 210)


SMALL = ['--image-size-mm', 60, '--patch-mm', 10, '--rotations', 3]
SMALLER = ['--image-size-mm', 30, *SMALL[2:]]


class ParquetTest(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.board, cls.second = wood(300, 240, 1, dpi=60), wood(200, 160, 2, base=90)
        cls.target = disc_png(60)

    def setUp(self):
        super().setUp()
        self.put('board.png', self.board)
        self.put('second.png', self.second)
        self.put('target.png', self.target)

    def parquet(self, *arguments, **options):
        return self.succeed('parquet', 'target.png', *SMALL, *arguments, **options)

    def rows(self, folder='out'):
        with (self.folder / folder / 'pieces.csv').open(newline='') as file:
            return list(csv.DictReader(file))

    def report(self, folder='out'):
        return json.loads(self.bytes_of(f'{folder}/report.json'))

    def files(self, folder='out', but=('report.json',)):
        return {p.name: p.read_bytes() for p in (self.folder / folder).iterdir() if p.name not in but}

    def paths(self, file, layer):
        root = xml.fromstring(self.bytes_of(file))
        return {path.get('id'): path.get('d') for group in root.iter(f'{SVG}g') if group.get('id') == layer
                for path in group.iter(f'{SVG}path')}

    def test_a_folder_with_everything(self):
        self.parquet('--panel', 'board.png,name=oak', '-o', 'out')
        self.assertEqual(set(self.files()), {'job.json', 'pieces.csv', 'preview.png', 'assembly.svg', 'panel-oak.cut.svg',
                                             'panel-oak.cut.dxf', 'panel-oak.preview.png'})
        rows = self.rows()
        self.assertEqual(list(rows[0]), 'id row column target panel x_mm y_mm rotation_deg area_mm2 min_width_mm cost '
                                        'grain_deg'.split())
        self.assertEqual(len(rows), 36)
        ids = {row['id'] for row in rows}
        self.assertEqual(len(ids), 36)
        self.assertEqual(set(self.paths('out/panel-oak.cut.svg', 'cut')), {f'cut-{i}' for i in ids})
        self.assertEqual(set(self.paths('out/panel-oak.cut.svg', 'engrave')), {f'label-{i}' for i in ids})
        self.assertEqual(set(self.paths('out/assembly.svg', 'outlines')), {f'piece-{i}' for i in ids})
        root = xml.fromstring(self.bytes_of('out/panel-oak.cut.svg'))
        self.assertEqual(root.get('width'), '127mm')  # 300 px at 60 dpi
        self.assertEqual(self.bytes_of('out/panel-oak.cut.dxf').count(b'AcDbPolyline'),
                         36 + sum(d.count('M') for d in self.paths('out/panel-oak.cut.svg', 'engrave').values()))
        report = self.report()
        self.assertEqual(report['counts']['pieces'], 36)
        self.assertEqual(report['counts']['missing'], 0)
        self.assertGreater(report['metrics']['cost_per_px'], 0)
        self.assertEqual({s['name'] for s in report['stages']} >= {'panels', 'features', 'matching'}, True)
        self.assertEqual({os.path.basename(o['path']) for o in report['outputs']}, set(self.files()))
        for path in self.paths('out/panel-oak.cut.svg', 'cut').values():
            self.assertRegex(path, r'^M[^MZ]*Z$')

    def test_the_same_bytes_again_by_job_and_by_svg(self):
        self.parquet('--panel', 'board.png,name=oak', '--panel', 'second.png,dpi=60,name=fir', '-o', 'out', '--threads', 1)
        self.assertEqual(json.loads(self.bytes_of('out/job.json'))['inputs'],
                         {'target': 'target.png', 'panel-oak': 'board.png', 'panel-fir': 'second.png'})
        self.assertLessEqual({row['panel'] for row in self.rows()}, {'oak', 'fir'})
        for name in ('job.json', 'assembly.svg', 'panel-fir.cut.svg'):
            self.succeed('run', f'out/{name}', '-o', 'again')
            self.assertEqual(self.files('out'), self.files('again'))

    def test_front_and_back_are_mirrored(self):
        for side in ('front', 'back'):
            self.parquet('--panel', 'board.png,name=oak', '--side', side, '-o', side)
        self.assertEqual([{**row} for row in self.rows('front')], [{**row} for row in self.rows('back')])
        numbers = lambda d: [float(v) for v in re.findall(r'-?[\d.]+', d)]
        front, back = (self.paths(f'{side}/panel-oak.cut.svg', 'cut') for side in ('front', 'back'))
        for name, path in front.items():
            x, mirrored = numbers(path)[::2], numbers(back[name])[::2]
            self.assertAlmostEqual(min(x), 127 - max(mirrored), delta=0.01)

    def test_other_kinds_of_output(self):
        self.parquet('--panel', 'board.png', '-o', 'a.svg', '-o', 'a.dxf', '-o', 'a.csv', '-o', 'a.json', '-o', 'a.png')
        self.assertEqual(self.bytes_of('a.svg').count(b'<path '), 36)

    def test_old_cut_files_go(self):
        self.parquet('--panel', 'board.png,name=oak', '-o', 'out')
        self.put('out/notes.txt', b'mine')
        self.parquet('--panel', 'board.png,name=elm', '-o', 'out/')
        self.assertIn('panel-elm.cut.svg', self.files())
        self.assertNotIn('panel-oak.cut.svg', self.files())
        self.assertIn('notes.txt', self.files())

    def test_plan_needs_no_panel_and_forecast_makes_nothing(self):
        before = self.names()
        plan = self.parquet('--plan').stdout.decode()
        self.assertIn('36 pieces in 6 rows of 6', plan)
        self.assertIn('minutes at 20 mm/s', plan)
        self.assertIn('suffices', self.parquet('--panel', 'board.png', '--forecast').stdout.decode())
        poor = self.succeed('parquet', 'target.png', '--panel', 'board.png', '--forecast').stdout.decode()
        self.assertIn('does not suffice', poor)
        self.assertEqual(self.names(), before)

    def test_masks_and_marks_are_told(self):
        self.put('mask.png', png(300, 240, lambda x, y: 255 if x < 200 else 0))
        before = self.names()
        told = self.parquet('--panel', 'board.png,mask=mask.png,name=oak,marks=10:20', '--panel', 'second.png,dpi=60', '--masks')
        oak, second = (json.loads(line) for line in told.stdout.splitlines())
        self.assertEqual((oak['panel'], oak['width'], oak['height'], oak['marks']), ('oak', 300, 240, [[10, 20]]))
        self.assertEqual(oak['wood'], [0, 200] + [100, 200] * 239 + [100])
        self.assertEqual((second['panel'], sum(second['wood'])), ('second', 200 * 160))
        self.assertEqual(self.names(), before)

    def test_too_little_wood_makes_what_it_can(self):
        done = self.succeed('parquet', 'target.png', '--panel', 'second.png,dpi=60', '--image-size-mm', 120, '--rotations', 1,
                            '-o', 'out')
        self.assertRegex(done.stderr, rb'no wood is left for \d+ of 81 patches: .*cm2 more of .* wood would help')
        counts = self.report()['counts']
        self.assertGreater(counts['missing'], 0)
        self.assertEqual(counts['missing'] + len(self.rows()), 81)

    def test_several_targets_from_the_same_wood(self):
        self.put('other.png', png(80, 60, lambda x, y: 40 + 2 * x))
        self.succeed('parquet', 'target.png', 'other.png', *SMALLER, '--panel', 'board.png,name=oak', '-o', 'out')
        self.assertEqual(json.loads(self.bytes_of('out/job.json'))['inputs'],
                         {'target': 'target.png', 'target-2': 'other.png', 'panel-oak': 'board.png'})
        self.assertLess({'preview.png', 'preview-2.png', 'assembly.svg'}, set(self.files()))
        rows = self.rows()
        self.assertEqual([row['target'] for row in rows], ['1'] * 9 + ['2'] * 12)
        ids = {row['id'] for row in rows}
        self.assertEqual(len(ids), 21)
        self.assertLess({'1-A1', '1-C3', '2-A1', '2-D3'}, ids)
        self.assertEqual(set(self.paths('out/panel-oak.cut.svg', 'cut')), {f'cut-{i}' for i in ids})
        self.assertEqual(set(self.paths('out/assembly.svg', 'outlines')), {f'piece-{i}' for i in ids})
        self.assertAlmostEqual(float(xml.fromstring(self.bytes_of('out/assembly.svg')).get('width')[:-2]), 30 + 40, delta=1)
        report = self.report()
        costs = [report['metrics'][f'cost_target_{k}'] for k in (1, 2)]
        self.assertEqual(sum(costs), report['metrics']['cost'])
        self.assertEqual(costs, [sum(int(r['cost']) for r in rows if r['target'] == k) for k in '12'])
        self.assertEqual(report['counts']['pieces_target_2'], 12)
        self.succeed('run', 'out/job.json', '-o', 'again')
        self.assertEqual(self.files('out'), self.files('again'))
        self.succeed('parquet', 'target.png', 'other.png', *SMALLER, '--panel', 'board.png,name=oak', '--sequence', 'interleaved',
                     '-o', 'mixed')
        self.assertNotEqual(self.bytes_of('mixed/pieces.csv'), self.bytes_of('out/pieces.csv'))
        plan = self.succeed('parquet', 'target.png', 'other.png', *SMALLER, '--plan').stdout.decode()
        self.assertIn('21 pieces of 2 targets', plan)
        self.succeed('parquet', 'target.png', *SMALLER, '--panel', 'board.png,name=oak', '-o', 'out')
        self.assertNotIn('preview-2.png', self.files())

    def test_the_same_target_until_the_wood_is_gone(self):
        done = self.succeed('parquet', 'target.png', '--image-size-mm', 40, *SMALL[2:], '--panel', 'second.png,dpi=60,name=fir',
                            '--copies', 3, '-o', 'out')
        self.assertIn(b'no wood is left for', done.stderr)
        report, rows = self.report(), self.rows()
        counts, metrics = report['counts'], report['metrics']
        self.assertEqual([counts[f'pieces_target_{k}'] + counts[f'missing_target_{k}'] for k in (1, 2, 3)], [16] * 3)
        self.assertEqual(len(rows) + counts['missing'], 3 * 16)
        self.assertEqual(counts['missing_target_1'], 0)
        self.assertGreater(counts['missing_target_3'], 0)
        self.assertLess(metrics['cost_per_px_target_1'], metrics['cost_per_px_target_2'])
        missing = self.paths('out/assembly.svg', 'missing')
        self.assertEqual(len(missing), counts['missing'])
        self.assertFalse({name.removeprefix('missing-') for name in missing} & {row['id'] for row in rows})
        named = re.search(r'patches: (.*?)(?: and|;)', done.stderr.decode()).group(1).split(', ')
        self.assertLessEqual({f'missing-{name}' for name in named}, set(missing))

    def test_an_unknown_resolution_is_guessed_aloud(self):
        done = self.succeed('parquet', 'target.png', '--image-size-mm', 10, '--patch-mm', 5, '--panel', 'second.png,name=fir',
                            '-o', 'out')
        self.assertIn(b'fir', done.stderr)
        self.assertIn(b'300 dpi', done.stderr)

    def test_improving_is_kept_in_the_job(self):
        self.parquet('--panel', 'board.png', '--improve', 1, '-o', 'out')
        tries = json.loads(self.bytes_of('out/job.json'))['params']['improveTries']
        self.assertGreater(tries, 0)
        metrics = self.report()['metrics']
        self.assertLessEqual(metrics['cost'], metrics['greedy_cost'])
        self.succeed('run', 'out/job.json', '-o', 'again')
        self.assertEqual(self.files('out'), self.files('again'))

    def interrupt(self, flags):
        """Stops a run that tells its progress while it matches; what it has said by its end."""
        run = subprocess.Popen([PROGRAM, *map(str, flags)], cwd=self.folder, stderr=subprocess.PIPE)
        seen = b''
        while not re.search(rb' [1-9]\d% matching', seen):
            seen += os.read(run.stderr.fileno(), 1000) or self.fail('it ended too early')
        run.send_signal(signal.SIGINT)
        seen += run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(), 130)
        return seen

    def test_an_interrupted_run_goes_on(self):
        flags = ['parquet', 'target.png', '--panel', 'board.png,name=oak', '--image-size-mm', 70, '--adaptive-levels', 1,
                 '--min-width-mm', 2, '--progress', 'always', '--patch-mm', 5]
        quiet = [*flags[:-4], '--patch-mm']
        self.succeed(*flags, '-o', 'whole')
        seen = self.interrupt([*flags, '-o', 'out'])
        self.assertIn(b'out.checkpoint', seen)
        self.assertFalse((self.folder / 'out').exists())
        state = self.bytes_of('out.checkpoint')
        self.assertGreater(state.count(b'\n'), 3)
        self.fail_with(3, *quiet, 7, '-o', 'out', '--resume', says=['out.checkpoint', 'another job'])
        self.put('out.checkpoint', state[:-40] + b'cheese\n')
        self.fail_with(3, *quiet, 5, '-o', 'out', '--resume', says=['out.checkpoint'])
        self.put('out.checkpoint', state)
        self.succeed(*flags, '-o', 'out', '--resume')
        self.assertEqual(self.files('out'), self.files('whole'))
        self.assertFalse((self.folder / 'out.checkpoint').exists())

    def test_seams_gain_and_tile_the_target(self):
        board = ['--panel', 'board.png,name=oak', '--panel', 'second.png,dpi=60,name=fir', '--min-width-mm', 3, '--overlap-mm', 4]
        for kind in ('g0', 'g1'):
            self.parquet(*board, '--seams', kind, '--side', 'front', '-o', kind)
            metrics = self.report(kind)['metrics']
            self.assertLess(metrics['reconstruction_cost'], metrics['straight_cost'])
            self.assertIn('seams', {s['name'] for s in self.report(kind)['stages']})
            rows = self.rows(kind)
            self.assertEqual(len(rows), 36)
            self.assertAlmostEqual(sum(float(row['area_mm2']) for row in rows), 60 * 60, delta=100)
            for row in rows:
                self.assertGreaterEqual(float(row['min_width_mm']), 3)
            # A side of two pieces is drawn with the same points.
            points = {name: set(re.findall(r'-?[\d.]+[ ,]-?[\d.]+', path))
                      for name, path in self.paths(f'{kind}/assembly.svg', 'outlines').items()}
            self.assertGreater(len(points['piece-B2']), 8)
            for neighbour in ('piece-A2', 'piece-C2', 'piece-B1', 'piece-B3'):
                self.assertGreaterEqual(len(points['piece-B2'] & points[neighbour]), 2)
            self.assertEqual(points['piece-B2'] - set().union(*(p for name, p in points.items() if name != 'piece-B2')), set())
        self.succeed('run', 'g1/job.json', '-o', 'again', '--threads', 1)
        self.assertEqual(self.files('g1'), self.files('again'))
        self.parquet(*board, '-o', 'none')
        metrics = self.report('none')['metrics']
        self.assertEqual(metrics['reconstruction_cost'], metrics['cost'])

    def test_seams_of_an_interrupted_run(self):
        flags = ['parquet', 'target.png', '--panel', 'board.png,name=oak', '--image-size-mm', 70, '--patch-mm', 7,
                 '--min-width-mm', 3, '--seams', 'g1', '--progress', 'always']
        self.succeed(*flags, '-o', 'whole')
        self.interrupt([*flags, '-o', 'out'])
        self.succeed(*flags, '-o', 'out', '--resume')
        self.assertEqual(self.files('out'), self.files('whole'))

    def test_a_morphed_grid(self):
        # Dark below a diagonal; dark and light wood.
        self.put('target.png', png(90, 90, lambda x, y: 40 if y > x + 1 else 210))
        self.put('two.png', png(360, 240, lambda x, y: (40 if x < 180 else 210) + (x * 7 + y * 131) % 13))
        self.put('all.png', png(360, 240, lambda x, y: 255))
        board = ['--panel', 'two.png,name=oak,dpi=60,mask=all.png', '--min-width-mm', 4]
        self.parquet(*board, '--grid', 'regular', '-o', 'regular')
        self.parquet(*board, '--grid', 'morphed', '--pins', '4,1:41,10.5', '-o', 'out')
        self.assertIn('patches', {s['name'] for s in self.report()['stages']})
        rows = self.rows()
        self.assertGreater(len(rows), 36)
        self.assertTrue({'B2a', 'B2b', 'C3a', 'C3b', 'A2', 'B1'} <= {row['id'] for row in rows})
        self.assertAlmostEqual(sum(float(row['area_mm2']) for row in rows), 60 * 60, delta=100)
        for row in rows:
            self.assertGreaterEqual(float(row['min_width_mm']), 4)
        self.assertLess(self.report()['metrics']['cost'], 0.9 * self.report('regular')['metrics']['cost'])
        # A side of two pieces is drawn with the same points, the corner that was laid among them.
        points = {name: set(re.findall(r'-?[\d.]+[ ,]-?[\d.]+', path))
                  for name, path in self.paths('out/assembly.svg', 'outlines').items()}
        self.assertGreaterEqual(len(points['piece-B2a'] & points['piece-B2b']), 2)
        self.assertGreaterEqual(len(set.intersection(*(points[f'piece-{name}'] for name in ('D1', 'E1', 'D2', 'E2')))), 1)
        self.succeed('run', 'out/job.json', '-o', 'again', '--threads', 1)
        self.assertEqual(self.files(), self.files('again'))
        plan = self.succeed('parquet', 'target.png', *SMALL, '--grid', 'morphed', '--pins', '4,1:41,10.5', '--min-width-mm', 4,
                            '--resolution-dpi', 60, '--plan').stdout
        self.assertIn(f'{len(rows)} pieces'.encode(), plan)
        self.fail_with(2, 'parquet', 'target.png', *SMALL, *board, '--grid', 'morphed', '--seams', 'g1', '--adaptive-levels', 1,
                       '--pins', '3', '-o', 'no', lines=3, says=['seams', 'adaptiveLevels', 'pins'])
        self.fail_with(2, 'parquet', 'target.png', *SMALL, *board, '--grid', 'morphed', '--pins', '1,1:50,50', '-o', 'no',
                       says=['pins', '1,1'])
        self.fail_with(2, 'parquet', 'target.png', *SMALL, *board, '--pins', '1,1:11,11', '-o', 'no', says=['pins', 'morphed'])

    def test_a_mask_says_which_edges_count(self):
        self.put('target.png', png(90, 90, lambda x, y: 40 if x < 26 or y > 62 else 210))
        self.put('all.png', png(300, 240, lambda x, y: 255))
        self.put('none.png', png(90, 90, lambda x, y: 0))
        self.put('right.png', png(45, 45, lambda x, y: 255 if x > 20 else 0))
        self.put('wide.png', png(90, 60, lambda x, y: 255))
        board = ['--panel', 'board.png,name=oak', '--min-width-mm', 4, '--grid', 'morphed']
        outlines = {}
        for name in ('all', 'right', 'none'):
            mask = [] if name == 'all' else ['--edge-mask', f'{name}.png']
            self.parquet(*board, *mask, '-o', name)
            outlines[name] = self.paths(f'{name}/assembly.svg', 'outlines')
        # Without edges the grid is even but for whole pixels.
        off = {name: max(abs(float(row['area_mm2']) - 100) for row in self.rows(name)) for name in outlines}
        self.assertLess(off['none'], 3)
        self.assertGreater(off['right'], 10)
        self.assertGreater(off['all'], 10)
        self.assertEqual(len({str(sorted(paths.items())) for paths in outlines.values()}), 3)
        self.succeed('run', 'right/job.json', '-o', 'again')
        self.assertEqual(self.files('right'), self.files('again'))
        self.fail_with(3, 'parquet', 'target.png', *SMALL, *board, '--edge-mask', 'wide.png', '-o', 'no',
                       says=['edge-mask', '90 x 60'])
        self.fail_with(3, 'parquet', 'target.png', *SMALL, *board[:2], '--edge-mask', 'right.png', '-o', 'no',
                       says=['edge-mask', 'morphed'])

    def test_masks_keep_pieces_off(self):
        self.put('mask.png', png(300, 240, lambda x, y: 255 if x < 200 else 0))
        self.parquet('--panel', 'board.png,mask=mask.png,name=oak', '--side', 'front', '-o', 'out')
        for path in self.paths('out/panel-oak.cut.svg', 'cut').values():
            self.assertLess(max(float(v) for v in re.findall(r'-?[\d.]+', path)[::2]), 200 * 25.4 / 60 - 1)

    def test_a_label_picture_gives_the_shapes(self):
        # A disc, a thin line beside it, and two halves.
        label = lambda x, y: 0 if (x - 30) ** 2 + (y - 30) ** 2 < 200 else 200 if x == 40 else 90 if y < 30 else 150
        self.put('shapes.png', png(60, 60, label))
        flags = ['--panel', 'board.png,name=oak', '--segmentation', 'shapes.png']
        plan = self.parquet(*flags, '--plan').stdout.decode()
        done = self.parquet(*flags, '-o', 'out')
        rows = self.rows()
        self.assertIn(f'{len(rows)} pieces, ', plan)
        self.assertIn('suffices', self.parquet(*flags, '--forecast').stdout.decode())
        self.assertEqual(done.stderr, b'')
        self.assertAlmostEqual(sum(float(row['area_mm2']) for row in rows), 60 * 60, delta=60)
        self.assertGreaterEqual(min(float(row['min_width_mm']) for row in rows), 4.9)
        self.assertEqual(len({(row['row'], row['column']) for row in rows}), len(rows))
        self.assertEqual(set(self.paths('out/panel-oak.cut.svg', 'cut')), {f"cut-{row['id']}" for row in rows})
        for path in self.paths('out/panel-oak.cut.svg', 'cut').values():
            self.assertRegex(path, r'^M[^MZ]*Z$')
        self.succeed('run', 'out/job.json', '-o', 'again')
        self.assertEqual(self.files('out'), self.files('again'))
        self.fail_with(3, 'parquet', 'target.png', *SMALL, *flags, '--thin-parts', 'refuse', '-o', 'no',
                       says=['segmentation', 'only 0.8 mm wide at', 'minWidthMm'])
        self.fail_with(2, 'parquet', 'target.png', *SMALL, *flags, '--posterize', 3, '-o', 'no', says=['posterize'])
        self.put('wide.png', png(80, 60, label))
        self.fail_with(3, 'parquet', 'target.png', *SMALL, *flags[:-1], 'wide.png', '-o', 'no', says=['80 x 60'])

    def test_holes_are_kept_if_wanted(self):
        self.put('shapes.png', png(60, 60, lambda x, y: 9 * ((x - 30) ** 2 + (y - 30) ** 2 < 200)))
        self.parquet('--panel', 'board.png,name=oak', '--segmentation', 'shapes.png', '--enclosed', 'keep', '-o', 'out')
        self.assertEqual(len(self.rows()), 2)
        cuts = self.paths('out/panel-oak.cut.svg', 'cut')
        self.assertEqual(sorted(path.count('M') for path in cuts.values()), [1, 2])

    def test_an_svg_gives_the_shapes(self):
        self.put('shapes.svg', b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
                               b'<path d="M0 0h50v100h-50z"/><circle cx="100" cy="50" r="30"/></svg>')
        self.parquet('--panel', 'board.png,name=oak', '--segmentation', 'shapes.svg', '-o', 'out')
        areas = sorted(float(row['area_mm2']) for row in self.rows())
        self.assertEqual(len(areas), 3)
        self.assertAlmostEqual(areas[0], 3.14159 * 18 * 18 / 2, delta=25)
        self.assertAlmostEqual(areas[2], 1800, delta=20)
        self.succeed('run', 'out/job.json', '-o', 'again')
        self.assertEqual(self.files('out'), self.files('again'))
        self.put('open.svg', b'<svg viewBox="0 0 1 1"><path d="M0 0L1 0L1 1"/></svg>')
        self.fail_with(3, 'parquet', 'target.png', *SMALL, '--panel', 'board.png', '--segmentation', 'open.svg', '-o', 'no',
                       says=['open.svg', 'closed'])

    def test_tones_give_the_shapes(self):
        self.parquet('--panel', 'board.png,name=oak', '--posterize', 2, '-o', 'out')
        self.assertGreater(len(self.rows()), 1)
        self.parquet('--panel', 'board.png,name=oak', '--posterize', 2, '--largest-patch', 2, '-o', 'more', '--threads', 1)
        self.assertGreater(len(self.rows('more')), len(self.rows()))

    def test_what_is_wrong_is_said(self):
        panel = ['--panel', 'board.png,name=oak']
        self.fail_with(2, 'parquet', 'target.png', '-o', 'out', says=['panel', '--panel SCAN'])
        self.fail_with(3, 'parquet', 'target.png', '--panel', 'missing.png', '-o', 'out', says=['missing.png'])
        self.fail_with(2, 'parquet', 'target.png', '--panel', 'board.png,dpi=0', '-o', 'out', says=['dpi=0', 'board'])
        self.fail_with(2, 'parquet', 'target.png', '--panel', 'board.png,name=a/b', '-o', 'out', says=['a/b'])
        self.fail_with(2, 'parquet', 'target.png', *panel, *panel, '-o', 'out', says=['second panel called oak'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '--panels', 'elm dpi=300', '-o', 'out', says=['panels', 'elm'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '--patch-mm', 3, '-o', 'out', says=['patchMm', 'minWidthMm'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '--seams', 'g1', '--adaptive-levels', 1, '-o', 'out',
                       says=['adaptiveLevels', 'seams'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '--seams', 'g1', '--overlap-mm', 10, '-o', 'out',
                       says=['overlapMm', 'minWidthMm'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '--image-size-mm', 9000, '--patch-mm', 5, '-o', 'out',
                       says=['imageSizeMm'])
        self.put('mask.png', png(30, 90, lambda x, y: 255))
        self.fail_with(3, 'parquet', 'target.png', '--panel', 'board.png,mask=mask.png', '-o', 'out', says=['board', '30 x 90'])
        self.put('mask.png', png(300, 240, lambda x, y: 0))
        self.fail_with(3, 'parquet', 'target.png', '--panel', 'board.png,mask=mask.png', '-o', 'out', says=['board', 'no wood'])
        self.fail_with(3, 'parquet', 'target.png', '--panel', 'board.png,machine=1:1,50:1,50:50', '-o', 'out',
                       says=['board', '0 round marks', '3'])
        self.fail_with(4, 'parquet', 'target.png', *SMALL, *panel, '-o', 'no/such/out', says=['no/such/out'])
        self.put('file', b'mine')
        self.fail_with(4, 'parquet', 'target.png', *SMALL, *panel, '-o', 'file', says=['file'])
        self.fail_with(2, 'parquet', 'target.png', *panel, '-o', '-', says=['-'])


if __name__ == '__main__':
    unittest.main()
