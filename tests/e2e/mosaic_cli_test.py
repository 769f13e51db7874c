"""Drives `tessera mosaic` as its users do."""
import json
import unittest

from cli import CliTest, png


class MosaicTest(CliTest):
    QUICK = ['--tiles', '60', '--iterations', '3']

    def mosaic(self, *arguments):
        return self.succeed('mosaic', 'disc.png', *self.QUICK, *arguments)

    def test_every_kind_of_output(self):
        names = ['a.svg', 'a.dxf', 'a.png', 'a.json', 'a.csv', 'a.bom.csv', 'a.apng']
        self.mosaic('--palette', '3', '--width-mm', '240', *[word for name in names for word in ('-o', name)])
        tiles = self.bytes_of('a.svg').count(b'<path id="tile-')
        self.assertGreater(tiles, 40)
        self.assertEqual(self.bytes_of('a.csv').count(b'\n'), tiles + 1)
        bill = [line.split(',') for line in self.bytes_of('a.bom.csv').decode().splitlines()]
        self.assertEqual(bill[0], ['colour', 'name', 'count', 'area_px2', 'area_mm2', 'share'])
        self.assertEqual(sum(int(line[2]) for line in bill[1:]), tiles)
        self.assertLessEqual(len(bill), 4)
        for line in bill[1:]:
            self.assertAlmostEqual(float(line[4]), 4 * float(line[3]), delta=0.01)
            self.assertEqual(self.bytes_of('a.svg').count(f'fill="{line[0]}"'.encode()), int(line[2]))

    def test_an_animation_by_name(self):
        self.mosaic('-o', 'a.svg', '--animate', 'moving.png', '-o', 'b.apng')
        self.assertIn(b'acTL', self.bytes_of('moving.png'))
        self.assertEqual(self.bytes_of('moving.png'), self.bytes_of('b.apng'))
        self.fail_with(2, 'pebbles', 'disc.png', '-o', 'a.glb', '--animate', 'moving.png', says=['animate'])

    def test_a_seamless_texture(self):
        self.mosaic('--seamless', '-o', 'a.svg', '-o', 'a.json')
        pieces = json.loads(self.bytes_of('a.json'))['features']
        numbers = [v for piece in pieces for point in piece['geometry']['coordinates'][0] for v in point]
        self.assertLess(min(numbers), -1)  # tiles reach over the border
        self.succeed('run', 'a.svg', '-o', 'b.svg')
        self.assertEqual(self.bytes_of('a.svg'), self.bytes_of('b.svg'))

    def test_a_palette_from_a_file(self):
        self.put('tiles.txt', b'old brick #a03020\nchalk #f4f1e8\n')
        self.mosaic('--palette', 'tiles.txt', '-o', 'a.bom.csv', '--save-job', 'job.json')
        colours = [line.split(',')[:2] for line in self.bytes_of('a.bom.csv').decode().splitlines()[1:]]
        self.assertLessEqual({tuple(c) for c in colours}, {('#a03020', 'old brick'), ('#f4f1e8', 'chalk')})
        self.assertIn('chalk', json.loads(self.bytes_of('job.json'))['params']['palette'])
        self.fail_with(2, 'mosaic', 'disc.png', '-o', 'a.svg', '--palette', 'brick red', says=['palette: is no palette'])

    def test_more_pictures(self):
        def changed(role, picture):
            self.put(f'{role}.png', picture)
            self.mosaic(f'--{role}', f'{role}.png', '-o', f'{role}.svg', '--save-job', f'{role}.job.json')
            self.succeed('run', f'{role}.job.json', '-o', f'{role}.again.svg')
            self.assertEqual(self.bytes_of(f'{role}.svg'), self.bytes_of(f'{role}.again.svg'))
            self.assertEqual(json.loads(self.bytes_of(f'{role}.job.json'))['inputs'],
                             {'photo': 'disc.png', role: f'{role}.png'})
            return self.bytes_of(f'{role}.svg')

        self.mosaic('-o', 'plain.svg')
        results = [self.bytes_of('plain.svg'), changed('edges', png(60, 60, lambda x, y: 0 if x == y else 255)),
                   changed('direction', png(9, 9, lambda x, y: 60)), changed('regions', png(20, 20, lambda x, y: 12 * x))]
        self.assertEqual(len(set(results)), 4)
        self.fail_with(3, 'mosaic', 'disc.png', '--edges', 'missing.png', '-o', 'a.svg', says=['missing.png'])

    def test_shapes_and_styles(self):
        for shape in ('quad', 'square', 'rectangle', 'ellipse', 'cell'):
            for style in ('opus-vermiculatum', 'hausner'):
                self.mosaic('--shape', shape, '--style', style, '-o', 'a.svg')
                self.assertGreater(self.bytes_of('a.svg').count(b'<path id="tile-'), 40, (shape, style))

    def test_any_number_of_threads_makes_the_same_bytes(self):
        for threads in (1, 2, 4):
            self.mosaic('-o', f'{threads}.svg', '--threads', threads)
        self.assertEqual(self.bytes_of('1.svg'), self.bytes_of('2.svg'))
        self.assertEqual(self.bytes_of('1.svg'), self.bytes_of('4.svg'))

    def test_pictures_that_say_nothing(self):
        for name, picture in (('dot', png(1, 1, lambda x, y: 9)), ('black', png(40, 30, lambda x, y: 0)),
                              ('line', png(50, 1, lambda x, y: 5 * x)),
                              ('checker', png(40, 40, lambda x, y: 255 * ((x + y) % 2)))):
            self.put(f'{name}.png', picture)
            self.succeed('mosaic', f'{name}.png', '-o', 'a.svg', *self.QUICK)
            self.assertIn(b'<path id="tile-1"', self.bytes_of('a.svg'), name)


if __name__ == '__main__':
    unittest.main()
