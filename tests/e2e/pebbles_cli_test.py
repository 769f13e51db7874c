"""Drives `tessera pebbles` as its users do."""
import json
import math
import struct
import unittest
from xml.etree import ElementTree

from cli import CliTest, png


class PebblesTest(CliTest):
    """Six pale discs on dark ground, 60 px apart."""

    def setUp(self):
        super().setUp()

        def pixel(x, y):
            dx, dy = x % 60 - 30, y % 60 - 30
            return 30 if dx * dx + dy * dy > 484 else 150 + 40 * (x // 60) - dx

        self.put('beach.png', png(180, 120, pixel))

    def found(self, *arguments):
        self.succeed('pebbles', 'beach.png', '-o', 'p.csv', '--report', 'r.json', *arguments)
        return json.loads(self.bytes_of('r.json'))['counts']['pebbles']

    def test_every_kind_of_output(self):
        kinds = ['glb', 'gltf', 'svg', 'dxf', 'png', 'json', 'csv', 'labels.png', 'overlay.png']
        self.succeed('pebbles', 'beach.png', '--width-m', '1.8', *(f for kind in kinds for f in ('-o', 'p.' + kind)))
        glb = self.bytes_of('p.glb')
        self.assertEqual(struct.unpack('<4sII', glb[:12]), (b'glTF', 2, len(glb)))
        scene = json.loads(glb[20:20 + struct.unpack('<I', glb[12:16])[0]])
        self.assertEqual([n['name'] for n in scene['nodes']], [f'pebble-{k}' for k in range(1, 7)])
        first = scene['nodes'][0]
        self.assertAlmostEqual(first['translation'][0], -0.6, delta=0.02)  # metres from the middle
        self.assertAlmostEqual(first['translation'][2], -0.3, delta=0.02)
        self.assertAlmostEqual(first['extras']['area_px'], 484 * 3.1416, delta=30)
        self.assertEqual(len(json.loads(self.bytes_of('p.gltf'))['nodes']), 6)
        rows = self.bytes_of('p.csv').decode().splitlines()
        self.assertEqual(len(rows), 7)
        b_mm = float(rows[1].split(',')[rows[0].split(',').index('b_mm')])
        self.assertAlmostEqual(b_mm, 440, delta=10)
        header = struct.unpack('>IIBB', self.bytes_of('p.labels.png')[16:26])
        self.assertEqual(header, (180, 120, 16, 0))

    def test_cumulative_plot_agrees_with_the_report(self):
        self.succeed('pebbles', 'beach.png', '--width-m', '1.8', '--plots', 'plots', '--report', 'r.json')
        self.assertEqual(self.names(), ['beach.png', 'disc.png', 'plots/cumulative.svg', 'plots/sizes.svg', 'r.json'])
        metrics = json.loads(self.bytes_of('r.json'))['metrics']
        svg = ElementTree.fromstring(self.bytes_of('plots/cumulative.svg'))
        texts = [(t.text, t.attrib) for t in svg.findall('.//{*}text')]
        ticks = [(float(text), float(a['x'])) for text, a in texts if a.get('text-anchor') == 'middle' and text[0].isdigit()]
        (low, left), (high, right) = ticks[0], ticks[-1]
        dots = [float(dot.attrib['cx']) for dot in svg.findall('.//{*}circle')]
        self.assertEqual(len(dots), 3)
        for percent, x in zip([16, 50, 84], dots):
            size = metrics[f'd{percent}_mm']
            self.assertAlmostEqual(low * (high / low) ** ((x - left) / (right - left)) / size, 1, places=3)
            self.assertIn(f'D{percent} {size:.3g} mm, psi {math.log2(size):.2f}', [text for text, _ in texts])
        curves = [p.attrib['d'] for p in svg.findall('.//{*}path') if p.attrib.get('stroke-width')]
        self.assertEqual(len(curves), 2)  # by number and by area
        for curve in curves:
            points = [tuple(map(float, p.split(' '))) for p in curve[1:].split('L')]
            self.assertEqual(sorted(points, key=lambda p: (p[0], -p[1])), points)

    def test_names_for_some_outputs(self):
        self.succeed('pebbles', 'beach.png', '--labels', 'a', '--overlay', 'b', '-o', 'p.labels.png')
        self.assertEqual(self.bytes_of('a'), self.bytes_of('p.labels.png'))
        self.assertEqual(self.bytes_of('b')[:4], b'\x89PNG')

    def test_flags_need_no_value(self):
        self.succeed('pebbles', '--ground', 'beach.png', '--quantize', '-o', 'p.glb', '--save-job', 'j.json')
        params = json.loads(self.bytes_of('j.json'))['params']
        self.assertEqual((params['ground'], params['quantize'], params['groundHole']), (True, True, False))
        self.succeed('pebbles', '--ground', 'false', 'beach.png', '-o', 'q.glb')

    def test_strewn_pebbles_are_instances_or_nodes(self):
        def scene(*arguments):
            self.succeed('pebbles', 'beach.png', '--scatter', '40', '--prototypes', '3', *arguments, '-o', 'p.gltf')
            return json.loads(self.bytes_of('p.gltf'))

        nodes = scene()['nodes']
        self.assertEqual(len(nodes), 3)
        self.assertTrue(all('EXT_mesh_gpu_instancing' in n['extensions'] for n in nodes))
        for strewing in ('blue-noise', 'inhibition', 'cluster', 'poisson'):
            plain = scene('--strewing', strewing, '--instancing', 'false')
            self.assertNotIn('extensionsUsed', plain)
            self.assertEqual(len({n['name'] for n in plain['nodes']}), 40)
            self.assertEqual(len({tuple(n['translation']) for n in plain['nodes']}), 40)
            self.assertEqual(len({n['mesh'] for n in plain['nodes']}), 3)
        self.fail_with(2, 'pebbles', 'beach.png', '--scatter', '9', '--prototypes', '0', '-o', 'x.glb', says=['prototypes'])

    def test_labels_from_elsewhere(self):
        self.found('--labels', 'labels.png')
        self.assertEqual(self.found('--segmenter', 'labels.png', '--labels', 'again.png'), 6)
        self.assertEqual(len(self.bytes_of('p.csv').splitlines()), 7)
        self.put('small.png', png(9, 9, lambda x, y: 1))
        self.fail_with(3, 'pebbles', 'beach.png', '--segmenter', 'small.png', '-o', 'q.glb', says=['9 x 9', '180 x 120'])
        self.fail_with(3, 'pebbles', 'beach.png', '--segmenter', 'labels', '-o', 'q.glb', says=['segmentation'])
        self.fail_with(2, 'pebbles', 'beach.png', '--segmenter', 'cheese', '-o', 'q.glb', says=['cheese', 'tree'])

    def test_corrections(self):
        self.assertEqual(self.found('--edits', 'delete 30,30'), 5)
        self.put('edits.txt', b'# the upper row\nmerge 30,30 90,30\nmerge 90,30 150,30\n')
        self.assertEqual(self.found('--edits', 'edits.txt'), 4)
        self.assertEqual(self.found('--edits', 'split 20,30 40,30; add 0,55 20,55 20,65 0,65'), 8)
        self.assertIn(b'1 of 1 edits', self.succeed('pebbles', 'beach.png', '--edits', 'delete 0,0', '-o', 'x.csv').stderr)
        self.fail_with(2, 'pebbles', 'beach.png', '--edits', 'cheese 3', '-o', 'q.glb', says=['edits', 'merge'])

    def test_any_number_of_threads_makes_the_same_bytes(self):
        for threads in (1, 2, 3):
            self.succeed('pebbles', 'beach.png', '-o', f'{threads}.glb', '--threads', threads)
        self.assertEqual(self.bytes_of('1.glb'), self.bytes_of('2.glb'))
        self.assertEqual(self.bytes_of('1.glb'), self.bytes_of('3.glb'))

    def test_pictures_without_pebbles(self):
        self.put('plain.png', png(90, 60, lambda x, y: 128))
        self.put('dot.png', png(1, 1, lambda x, y: 128))
        self.put('noise.png', png(90, 60, lambda x, y: (x * 7919 + y * 104729) * 2654435761 >> 7 & 255))
        for name in ('plain.png', 'dot.png', 'noise.png'):
            for segmenter in ('tree', 'rays'):
                done = self.succeed('pebbles', name, '--segmenter', segmenter, '-o', 'p.glb', '-o', 'p.csv')
                if name != 'noise.png':
                    self.assertIn(b'found no pebbles', done.stderr)


if __name__ == '__main__':
    unittest.main()
