"""`tessera pave --tiles`: a drawing read row by row and its stones written as they are laid."""
import json
import math
import re
import unittest
import zlib

from cli import CliTest, chunk, png


def waves(width, height):
    return png(width, height, lambda x, y: 0 if (y + 12 * math.sin(x / 17) + 60) % 50 < 25 else 255)


class TilesTest(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.waves = waves(300, 220)

    def setUp(self):
        super().setUp()
        self.put('waves.png', self.waves)

    def pave(self, *arguments):
        return self.succeed('pave', 'waves.png', '--half-side', 1.5, '--tiles', 128, '--backend', 'cpu', *arguments)

    def test_what_is_written_in_pieces_is_what_is_written_at_once(self):
        self.pave('-o', 'pieces.svg', '--report', 'report.json', '--save-job', 'job.json')
        self.pave('-o', 'whole.svg', '-o', 'whole.csv')  # two outputs: in memory
        self.assertEqual(self.bytes_of('pieces.svg'), self.bytes_of('whole.svg'))
        report = json.loads(self.bytes_of('report.json'))
        self.assertEqual(report['counts']['stones'], self.bytes_of('whole.csv').count(b'\n') - 1)
        self.assertEqual((report['inputs'][0]['width'], report['inputs'][0]['height']), (300, 220))
        self.assertEqual(len(report['inputs'][0]['sha256']), 64)
        self.assertEqual(report['outputs'][0]['bytes'], len(self.bytes_of('pieces.svg')))
        for job in ['job.json', 'pieces.svg']:
            self.succeed('run', job, '--backend', 'cpu', '-o', 'again.svg')
            self.assertEqual(self.bytes_of('again.svg'), self.bytes_of('pieces.svg'))
        self.succeed('pave', 'waves.png', '--half-side', 1.5, '--tiles', 128, '--backend', 'cpu', '--format', 'svg', '-o', '-')

    def test_ids_are_each_once(self):
        self.pave('-o', 'pieces.svg')
        ids = [int(i) for i in re.findall(rb'id="stone-(\d+)"', self.bytes_of('pieces.svg'))]
        self.assertEqual(ids, list(range(1, len(ids) + 1)))

    def test_the_bare_flag_means_tiles_of_2048_px(self):
        self.succeed('pave', '--tiles', 'waves.png', '-o', 'a.svg', '--save-job', 'job.json')
        self.assertEqual(json.loads(self.bytes_of('job.json'))['params']['tiles'], 2048)
        self.succeed('pave', 'waves.png', '-o', 'a.svg', '--tiles')

    def test_no_limit_of_pixels_where_memory_is_none_of_the_picture(self):
        self.pave('-o', 'pieces.svg', '--max-pixels', 1000)
        self.fail_with(3, 'pave', 'waves.png', '--half-side', 1.5, '--tiles', 128, '--max-pixels', 1000, '-o', 'a.csv',
                       says=['waves.png', '--max-pixels'])

    def test_broken_pictures_leave_nothing(self):
        for name, data in [('cut.png', self.waves[:len(self.waves) * 2 // 3]), ('head.png', self.waves[:40]),
                           ('text.png', b'cheese'), ('pixels.png', png(300, 220, lambda x, y: 0, claimed=(300, 400)))]:
            self.put(name, data)
            self.fail_with(3, 'pave', name, '--half-side', 1.5, '--tiles', 128, '-o', 'stones.svg', says=[name])
        self.fail_with(3, 'pave', 'none.png', '--tiles', '-o', 'stones.svg', says=['none.png'])
        self.fail_with(4, 'pave', 'waves.png', '--tiles', '-o', 'no/where.svg', says=['no/where.svg'])

    def test_wrong_tiles_are_refused(self):
        self.fail_with(2, 'pave', 'waves.png', '--tiles', 100, '-o', 'a.svg', says=['--tiles', '64 times halfSide'])
        self.fail_with(2, 'pave', 'waves.png', '--tiles', 256, '--method', 'paper', '-o', 'a.svg', says=['--tiles', 'paper'])
        self.fail_with(2, 'pave', 'waves.png', '--tiles', -1, '-o', 'a.svg', says=['--tiles'])

    def test_alpha_and_palettes_are_as_in_other_runs(self):
        header = b'\0\0\0\x78\0\0\0\x50\x08\x06\0\0\0'  # 120 x 80, RGBA
        rows = b''.join(b'\0' + bytes(v for x in range(120) for v in (0, 0, 0, 255 if (x // 20 + y // 20) % 2 else 0))
                        for y in range(80))
        self.put('alpha.png', b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows)) +
                 chunk(b'IEND', b''))
        for outputs in [['-o', 'a.svg'], ['-o', 'b.svg', '-o', 'b.csv']]:
            self.succeed('pave', 'alpha.png', '--tiles', 256, '--backend', 'cpu', *outputs)
        self.assertEqual(self.bytes_of('a.svg'), self.bytes_of('b.svg'))


if __name__ == '__main__':
    unittest.main()
