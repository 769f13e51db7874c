"""Drives `tessera pattern` and `tessera measure` as their users do."""
import json
import math
import struct
import unittest

from cli import CliTest, png

MODELS = ['poisson-lines', 'occupancy', 'delaunay', 'johnson-mehl', 'checkerboard', 'hexagon', 'triangle', 'gaussian',
          'segments', 'ellipses', 'circles', 'rectangles', 'pixels', 'points']
SMALL = ['--width', '120', '--height', '90', '--size', '9']


class PatternTest(CliTest):
    def features(self, name):
        return json.loads(self.bytes_of(name))['features']

    def test_lists_its_models(self):
        names = [line.split()[0] for line in self.succeed('pattern', '--list').stdout.decode().splitlines()]
        self.assertEqual(names, MODELS)

    def test_every_model_in_every_kind_of_output(self):
        kinds = ['svg', 'dxf', 'png', 'json', 'csv', 'glb']
        for model in MODELS:
            self.succeed('pattern', model, *SMALL, *(f for kind in kinds for f in ('-o', f'{model}.{kind}')))
            count = len(self.features(f'{model}.json'))
            self.assertGreater(count, 20, model)
            self.assertEqual(self.bytes_of(f'{model}.svg').count(b'<path '), count)
            self.assertEqual(self.bytes_of(f'{model}.csv').count(b'\n'), count + 1)
            self.succeed('run', f'{model}.svg', '-o', 'again.svg')
            self.assertEqual(self.bytes_of(f'{model}.svg'), self.bytes_of('again.svg'))

    def test_cells_tile_the_window(self):
        for model in MODELS[:8]:
            self.succeed('pattern', model, *SMALL, '-o', 'a.json')
            area = sum(feature['properties']['area'] for feature in self.features('a.json'))
            self.assertAlmostEqual(area / (120 * 90), 1, delta=1e-4)  # three decimals a cell

    def test_points_are_points(self):
        self.succeed('pattern', 'points', *SMALL, '--process', 'blue-noise', '-o', 'p.json')
        points = [feature['geometry'] for feature in self.features('p.json')]
        self.assertEqual({point['type'] for point in points}, {'Point'})
        places = [point['coordinates'] for point in points]
        least = min(math.dist(p, q) for i, p in enumerate(places) for q in places[:i])
        self.assertGreater(least, 9 * math.sqrt(0.68) - 0.01)

    def test_a_density_picture(self):
        self.put('left.png', png(60, 45, lambda x, y: 0 if x < 20 else 255))
        self.succeed('pattern', 'points', *SMALL, '--process', 'left.png', '-o', 'p.json', '--save-job', 'j.json')
        self.assertEqual(json.loads(self.bytes_of('j.json'))['params']['process'], 'cox')
        places = [feature['geometry']['coordinates'] for feature in self.features('p.json')]
        self.assertGreater(len(places), 60)
        self.assertLess(max(x for x, _ in places), 40.001)
        warned = self.succeed('pattern', 'points', *SMALL, '--density', 'left.png', '-o', 'q.json')
        self.assertIn(b'only the cox process', warned.stderr)

    def test_pictures_of_any_scale_and_channels(self):
        for channels, colour_type in ((1, 0), (2, 4), (4, 6)):
            self.succeed('pattern', 'occupancy', *SMALL, '--channels', channels, '--png-scale', '2.5', '-o', 'a.png')
            width, height, bits, kind = struct.unpack('>IIBB', self.bytes_of('a.png')[16:26])
            self.assertEqual((width, height, bits, kind), (300, 225, 8, colour_type))
        self.succeed('pattern', 'occupancy', *SMALL, '--channels', 4, '--colors', '#10203040', '-o', 'a.svg')
        self.assertIn(b'fill-opacity="0.251"', self.bytes_of('a.svg'))
        self.fail_with(2, 'pattern', 'occupancy', '--colors', '#10203040', '-o', 'a.svg', says=['colors', '--colors'])
        self.fail_with(2, 'pattern', 'occupancy', '--png-scale', 17, '-o', 'a.png', says=['--png-scale', '16'])

    def test_same_seed_same_bytes(self):
        for seed in (1, 1, 2):
            self.succeed('pattern', 'johnson-mehl', *SMALL, '--seed', seed, '--threads', 1, '-o', f'{len(self.names())}.svg')
        first, second, third = (self.bytes_of(name) for name in self.names() if name.endswith('.svg'))
        self.assertEqual(first, second)
        self.assertNotEqual(first, third)

    def test_what_is_wrong_is_said(self):
        self.fail_with(2, 'pattern', '-o', 'a.svg', says=['model', 'missing', '--list'])
        self.fail_with(2, 'pattern', 'cheese', '-o', 'a.svg', says=['model', 'cheese', 'occupancy'])
        self.fail_with(2, 'pattern', 'occupancy', '--width', 0, '-o', 'a.svg', says=['width', '--width'])
        self.fail_with(2, 'pattern', 'occupancy', '--intensity', -2, '-o', 'a.svg', says=['intensity'])
        self.fail_with(2, 'pattern', 'occupancy', '--intensity', 1000, '-o', 'a.svg', says=['intensity', '20 million'])
        self.fail_with(2, 'pattern', 'occupancy', '--colors', 'cheese', '--probabilities', 'x', '--border-color', 'y',
                       '-o', 'a.svg', lines=2, says=['colors', 'borderColor'])
        self.fail_with(2, 'pattern', 'occupancy', '--probabilities', '1 2', '-o', 'a.svg', says=['probabilities'])

    def test_nothing_comes_of_an_intensity_of_zero(self):
        done = self.succeed('pattern', 'occupancy', *SMALL, '--intensity', 0, '-o', 'a.svg', '-o', 'a.png', '-o', 'a.json')
        self.assertIn(b'empty', done.stderr)
        self.assertEqual(self.features('a.json'), [])


class MeasureTest(CliTest):
    def measure(self, *arguments):
        return json.loads(self.succeed('measure', *arguments).stdout)

    def test_cells_points_and_pictures(self):
        self.succeed('pattern', 'occupancy', *SMALL, '-o', 'a.svg', '-o', 'a.json', '-o', 'a.png', '-o', 'a.csv')
        cells = self.measure('a.svg')
        self.assertEqual(cells['kind'], 'cells')
        self.assertEqual(cells['comparison']['model'], 'occupancy')
        self.assertAlmostEqual(cells['sides']['mean'], 6, delta=0.5)
        self.assertIsNone(self.measure('a.json')['comparison'])
        self.assertEqual(self.measure('a.csv')['kind'], 'points')
        picture = self.measure('a.png', '--model', 'occupancy', '--lambda', 1 / 81 / 16)  # drawn four times as large
        self.assertEqual(picture['kind'], 'picture')
        self.assertEqual(len(picture['classes']), 4)
        for needles in picture['needles']:
            self.assertAlmostEqual(needles['same_cell'], needles['expected'], delta=0.12)

    def test_files_and_plots(self):
        self.succeed('pattern', 'checkerboard', *SMALL, '-o', 'a.svg')
        self.succeed('measure', 'a.svg', '-o', 'w.csv', '--report', 'r.json', '--plots', 'plots')
        report = json.loads(self.bytes_of('r.json'))
        self.assertEqual(report['technique'], 'measure')
        self.assertEqual(len(report['inputs'][0]['sha256']), 64)
        self.assertEqual(self.bytes_of('w.csv').count(b'\n'), 1 + len(report['same_cell']))
        self.assertIn(b'closed form', self.bytes_of('plots/same_cell.svg'))
        self.assertEqual(json.loads(self.succeed('measure', '-', input=self.bytes_of('a.svg')).stdout)['kind'], 'cells')

    def test_what_is_wrong_is_said(self):
        self.put('p.csv', b'x,y\n1,2\n3,cheese\n')
        self.fail_with(3, 'measure', 'p.csv', says=['p.csv', 'line 3'])
        self.fail_with(3, 'measure', 'missing.json', says=['missing.json'])
        self.put('broken.png', self.disc[:80])
        self.fail_with(3, 'measure', 'broken.png', says=['broken.png'])
        self.put('p.csv', b'1,2\n3,4\n')
        self.fail_with(2, 'measure', 'p.csv', '--model', 'cheese', '--needles', 0, '-o', 'a.svg', lines=4,
                       says=['cheese', 'lambda', 'needles', 'a.svg'])
        self.fail_with(2, 'measure', says=['FILE'])


class FitTest(CliTest):
    def test_a_picture_becomes_a_job(self):
        for model, flags in (('occupancy', []), ('checkerboard', []), ('gaussian', ['--variation', 'none'])):
            self.succeed('pattern', model, '--width', 300, '--height', 300, '--size', 12, *flags, '-o', 'a.png')
            self.succeed('fit', 'a.png', '-o', 'j.json', '--report', 'r.json')
            report = json.loads(self.bytes_of('r.json'))
            self.assertEqual(report['model'], model)
            self.succeed('run', 'j.json', '-o', 'b.svg')
            self.assertGreater(self.bytes_of('b.svg').count(b'<path '), 300)

    def test_what_is_wrong_is_said(self):
        self.put('flat.png', png(60, 60, lambda x, y: 9))
        self.fail_with(3, 'fit', 'flat.png', says=['flat.png', 'one colour'])
        self.put('small.png', png(20, 20, lambda x, y: 255 * (x % 2)))
        self.fail_with(3, 'fit', 'small.png', says=['small.png', '32 x 32'])
        self.fail_with(3, 'fit', 'missing.png', says=['missing.png'])


if __name__ == '__main__':
    unittest.main()
