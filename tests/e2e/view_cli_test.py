"""Drives `tessera view` as its users do: with keys and a mouse, on a screen that nobody sees (Xvfb), drawn in software."""
import json
import os
import select
import signal
import struct
import subprocess
import time
import unittest
import zlib

from cli import PROGRAM, CliTest, chunk, png

PATIENCE = 60  # seconds, for what takes less than one


def read_png(data):
    """Width, height and rows of (r, g, b) of a PNG with 8 bits in one or three channels, as Tessera writes them."""
    width, height, bits, kind = struct.unpack('>IIBB', data[16:26])
    assert bits == 8 and kind in (0, 2), (bits, kind)
    channels = 3 if kind == 2 else 1
    at, packed = 8, b''
    while at < len(data):
        length = struct.unpack('>I', data[at:at + 4])[0]
        if data[at + 4:at + 8] == b'IDAT':
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, size = zlib.decompress(packed), channels * width
    above, rows = bytes(size), []
    for y in range(height):
        method, line = raw[y * (size + 1)], raw[y * (size + 1) + 1:(y + 1) * (size + 1)]
        assert method in (0, 2), method
        if method == 2:
            line = bytes((a + b) & 255 for a, b in zip(line, above))
        above = line
        rows.append([tuple(line[3 * x:3 * x + 3]) if channels == 3 else (line[x],) * 3 for x in range(width)])
    return width, height, rows


def mean_difference(rows, others):
    pairs = [(a, b) for row, other in zip(rows, others, strict=True) for a, b in zip(row, other, strict=True)]
    return sum(abs(p - q) for a, b in pairs for p, q in zip(a, b)) / (3 * len(pairs))


def shrunk(rows, factor):
    """Means of squares of so many pixels."""
    def mean(x, y):
        block = [rows[y + j][x + i] for j in range(factor) for i in range(factor)]
        return tuple(sum(p[c] for p in block) / len(block) for c in range(3))
    return [[mean(x, y) for x in range(0, len(rows[0]), factor)] for y in range(0, len(rows), factor)]


def colour_png(colour):
    """A pixel of a colour."""
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 1, 1, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(bytes((0, *colour)))) + chunk(b'IEND', b''))


def glb_of_floor(bump):
    """A grey square metre that faces up, its picture's top towards -z, with normals of this colour."""
    vertices = b''.join(struct.pack('<8f', x, 0, z, 0, 1, 0, x + 0.5, z + 0.5) for z in (-0.5, 0.5) for x in (-0.5, 0.5))
    parts = [vertices, struct.pack('<6H', 0, 2, 1, 1, 2, 3), colour_png((128, 128, 128)), colour_png(bump)]
    views, packed = [], b''
    for part in parts:
        views.append({'buffer': 0, 'byteOffset': len(packed), 'byteLength': len(part)})
        packed += part + bytes(-len(part) % 4)
    views[0]['byteStride'] = 32
    accessors = [{'bufferView': 0, 'byteOffset': at, 'componentType': 5126, 'count': 4, 'type': kind}
                 for at, kind in ((0, 'VEC3'), (12, 'VEC3'), (24, 'VEC2'))]
    accessors[0].update(min=[-0.5, 0, -0.5], max=[0.5, 0, 0.5])
    accessors.append({'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'})
    text = json.dumps({
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'NORMAL': 1, 'TEXCOORD_0': 2}, 'indices': 3, 'material': 0}]}],
        'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}, 'normalTexture': {'index': 1}}],
        'textures': [{'source': 0}, {'source': 1}], 'accessors': accessors, 'bufferViews': views,
        'images': [{'bufferView': 2, 'mimeType': 'image/png'}, {'bufferView': 3, 'mimeType': 'image/png'}],
        'buffers': [{'byteLength': len(packed)}]}).encode()
    text += b' ' * (-len(text) % 4)
    return (struct.pack('<4sII', b'glTF', 2, 28 + len(text) + len(packed)) + struct.pack('<I4s', len(text), b'JSON') + text +
            struct.pack('<I4s', len(packed), b'BIN\0') + packed)


class ViewTest(CliTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        ready, write = os.pipe()
        cls.server = subprocess.Popen(['Xvfb', '-displayfd', str(write), '-screen', '0', '800x600x24', '-nolisten', 'tcp', '-noreset'],
                                      pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        if not select.select([ready], [], [], PATIENCE)[0]:
            raise AssertionError('Xvfb does not start')
        with os.fdopen(ready) as pipe:
            display = pipe.readline().strip()
        cls.screen = {**os.environ, 'DISPLAY': ':' + display, 'LIBGL_ALWAYS_SOFTWARE': '1'}
        cls.screen.pop('WAYLAND_DISPLAY', None)

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait()

    def shot(self, *arguments, size=(400, 300)):
        """What `tessera view` shows, once the result is there."""
        self.succeed('view', *arguments, '--size', *size, '--screenshot', 'shot.png', '--exit', env=self.screen)
        width, height, rows = read_png(self.bytes_of('shot.png'))
        self.assertEqual((width, height), size)
        return rows

    def start(self, *arguments):
        window = subprocess.Popen([PROGRAM, 'view', *arguments], cwd=self.folder, env=self.screen, stderr=subprocess.PIPE)
        self.addCleanup(window.stderr.close)
        self.addCleanup(window.wait)
        self.addCleanup(window.kill)
        return window

    def xdotool(self, *arguments):
        return subprocess.run(['xdotool', *map(str, arguments)], env=self.screen, check=True, capture_output=True,
                              timeout=PATIENCE).stdout.decode()

    def title_with(self, words):
        """Waits for a window with these words in its title, and gives it the keyboard."""
        found = self.xdotool('search', '--sync', '--onlyvisible', '--name', words).split()[0]
        self.xdotool('windowfocus', '--sync', found)
        self.window_id = found

    def drag(self, *points):
        """With the left button, along points of the window."""
        moves = [('mousemove', '--window', self.window_id, x, y) for x, y in points]
        self.xdotool(*moves[0], 'mousedown', 1, *(word for move in moves[1:] for word in move), 'mouseup', 1)

    def saved(self, window, name):
        """What is seen, by the key s."""
        self.xdotool('key', 's')
        self.assertEqual(window.stderr.readline().decode(), f'tessera: saved {name}\n')
        return read_png(self.bytes_of(name))[2]

    def test_a_pavement_is_seen_as_its_png_has_it(self):
        self.succeed('pave', 'disc.png', '--half-side', '5', '-o', 'disc.svg', '-o', 'exact.png', '--png-scale', '2.5',
                     '--save-job', 'job.json')
        exact = read_png(self.bytes_of('exact.png'))[2]
        for name in ('job.json', 'disc.svg'):
            rows = self.shot(name)
            self.assertLess(mean_difference([row[50:350] for row in rows], exact), 0.01)
            self.assertEqual({pixel for row in rows for pixel in row[:49] + row[351:]}, {(48, 50, 54)})

    def test_a_job_may_be_changed(self):
        self.succeed('pave', 'disc.png', '--save-job', 'job.json', '-o', 'a.csv')
        self.succeed('run', 'job.json', '--set', 'grout=2', '-o', 'exact.png', '--png-scale', '2.5')
        rows = self.shot('job.json', '--set', 'grout=2')
        self.assertLess(mean_difference([row[50:350] for row in rows], read_png(self.bytes_of('exact.png'))[2]), 0.01)

    def test_a_mosaic_carries_its_job(self):
        self.put('photo.png', png(80, 60, lambda x, y: 40 + 2 * x if (x - 40) ** 2 + (y - 30) ** 2 < 500 else 220 - y))
        self.succeed('mosaic', 'photo.png', '--tiles', '150', '-o', 'm.svg', '-o', 'exact.png', '--png-scale', '5')
        self.assertLess(mean_difference(self.shot('m.svg'), read_png(self.bytes_of('exact.png'))[2]), 0.01)

    def test_pictures_are_seen_whole(self):
        def level(x, y):
            return x * 255 // 799 if y < 300 else 255 - y * 255 // 599
        self.put('ramp.png', png(800, 600, level))
        exact = [[(level(x, y),) * 3 for x in range(800)] for y in range(600)]
        self.assertLess(mean_difference(self.shot('ramp.png'), shrunk(exact, 2)), 1)

    def test_the_folder_of_a_parquetry_shows_its_preview(self):
        self.put('wood/preview.png', png(40, 30, lambda x, y: 200 if x < 20 else 50))
        rows = self.shot('wood')
        self.assertEqual((rows[150][50], rows[150][350]), ((200,) * 3, (50,) * 3))
        (self.folder / 'empty').mkdir()
        self.fail_with(3, 'view', 'empty', says=['empty', 'preview.png'], env=self.screen)

    def beach(self):
        self.put('beach.png', png(180, 120, lambda x, y: 30 if (x % 60 - 30) ** 2 + (y % 60 - 30) ** 2 > 484 else 170))
        self.succeed('pebbles', 'beach.png', '-o', 'p.glb', '-o', 'p.gltf', '--save-job', 'p.json')

    def test_pebbles_are_solid(self):
        self.beach()
        rows = self.shot('p.glb')
        ground = (196, 203, 210)
        stones = [pixel for row in rows for pixel in row if pixel != ground]
        self.assertGreater(len(stones), 0.15 * 400 * 300)  # six discs of 0.42 of what they lie on, seen from the side
        self.assertLess(len(stones), 0.6 * 400 * 300)
        bright = sorted(sum(pixel) / 3 for pixel in stones)
        self.assertAlmostEqual(bright[len(bright) * 9 // 10], 170, delta=20)  # the photo's, where the sun is
        self.assertLess(bright[len(bright) // 20], 150)                       # and shade
        for name in ('p.gltf', 'p.json'):
            self.assertLess(mean_difference(self.shot(name), rows), 1)

    def test_normal_maps_bend_the_light(self):
        def brightness(bump):
            self.put('floor.glb', glb_of_floor(bump))
            return sum(self.shot('floor.glb')[150][200])
        flat = brightness((128, 128, 255))
        # The sun stands to the left (-x) and in front (+z), which is down in the picture.
        for towards, away in (((88, 128, 248), (168, 128, 248)), ((128, 88, 248), (128, 168, 248))):
            self.assertGreater(brightness(towards), flat)
            self.assertLess(brightness(away), flat - 10)

    def test_keys_and_mouse(self):
        self.put('quarters.png', png(40, 30, lambda x, y: 60 * (1 + (x >= 20) + 2 * (y >= 15)) - 50))
        window = self.start('quarters.png', '--size', '400', '300', '--screenshot', 'seen.png')
        self.title_with('quarters.png - tessera - h: keys')
        first = self.saved(window, 'seen.png')
        corners = [(5, 5), (5, 394), (294, 5), (294, 394)]
        colours = [first[y][x] for y, x in corners]
        self.assertEqual(colours, [(level,) * 3 for level in (10, 70, 130, 190)])
        self.xdotool('mousemove', '--window', self.window_id, 5, 5, 'click', '--repeat', '8', '--delay', '1', 4)  # the wheel, away: closer
        closer = self.saved(window, 'seen.png')
        self.assertEqual({pixel for row in closer for pixel in row}, {colours[0]})
        self.xdotool('key', '0')
        self.assertEqual(self.saved(window, 'seen.png'), first)
        self.xdotool('key', '--repeat', '2', 'plus')
        self.xdotool('key', 'minus', 'minus')
        self.assertEqual([self.saved(window, 'seen.png')[y][x] for y, x in corners], colours)
        self.xdotool('key', 'Left')  # the content moves right by an eighth
        self.assertEqual(self.saved(window, 'seen.png')[5][20], (48, 50, 54))
        self.xdotool('key', '0')
        self.drag((200, 150), (230, 150), (260, 170))
        moved = self.saved(window, 'seen.png')
        self.assertEqual((moved[19][200], moved[20][59], moved[20][60]), ((48, 50, 54), (48, 50, 54), colours[0]))
        self.xdotool('key', 'q')
        self.assertEqual(window.wait(PATIENCE), 0)

    def test_pebbles_turn_and_lie_flat(self):
        self.beach()
        window = self.start('p.json', '--size', '200', '150', '--screenshot', 'seen.png')
        self.title_with('p.json - tessera - h: keys')
        first = self.saved(window, 'seen.png')
        self.xdotool('key', 'Up')
        self.assertGreater(mean_difference(self.saved(window, 'seen.png'), first), 1)
        self.xdotool('key', '0')
        self.assertEqual(self.saved(window, 'seen.png'), first)
        self.drag((100, 75), (120, 75), (140, 75))
        self.assertGreater(mean_difference(self.saved(window, 'seen.png'), first), 1)
        self.xdotool('key', 'Tab')
        flat = self.saved(window, 'seen.png')
        self.assertEqual(flat[3][100], (48, 50, 54))  # 180 x 120 in 200 x 150: bars above and below
        self.xdotool('key', 'Escape')
        self.assertEqual(window.wait(PATIENCE), 0)

    def start_long_job(self):
        self.put('large.png', self.large_disc)
        self.put('long.json', json.dumps({'schemaVersion': 1, 'technique': 'pavement', 'inputs': {'drawing': 'large.png'},
                                          'params': {'halfSide': 1.5, 'iterations': 1000}}).encode())
        window = self.start('long.json', '--size', '400', '300', '--screenshot', 'seen.png')
        self.title_with('long.json - tessera - [a-z]+ [0-9]+ %')
        return window

    def test_iterations_are_seen_while_they_go_on_and_quitting_ends_them(self):
        window = self.start_long_job()
        deadline = time.monotonic() + PATIENCE
        while len({pixel for row in self.saved(window, 'seen.png') for pixel in row[60:340]}) < 4:  # black, white, borders
            self.assertLess(time.monotonic(), deadline)
        self.assertIsNone(window.poll())
        self.xdotool('key', 'q')
        self.assertEqual(window.wait(PATIENCE), 0)
        self.assertEqual(window.stderr.read(), b'')

    def test_an_interrupt_ends_it(self):
        window = self.start_long_job()
        window.send_signal(signal.SIGINT)
        self.assertEqual(window.wait(PATIENCE), 130)
        self.assertEqual(window.stderr.read(), b'tessera: interrupted\n')

    def test_what_cannot_be_shown(self):
        self.fail_with(3, 'view', 'nothing.png', says=['nothing.png'], env=self.screen)
        self.put('a.txt', b'cheese')
        self.fail_with(3, 'view', 'a.txt', says=['a.txt'], env=self.screen)
        self.put('a.glb', b'glTF\2\0\0\0\x0c\0\0\0')
        self.fail_with(3, 'view', 'a.glb', says=['a.glb', 'glTF'], env=self.screen)
        self.put('a.json', b'{"schemaVersion": 1, "technique": "cheese"}')
        self.fail_with(2, 'view', 'a.json', says=['a.json', 'cheese'], env=self.screen)
        self.put('b.json', b'{"schemaVersion": 1, "technique": "pavement", "inputs": {"drawing": "gone.png"}}')
        self.fail_with(3, 'view', 'b.json', says=['gone.png'], env=self.screen)
        self.fail_with(2, 'view', 'disc.png', '--set', 'seed=2', says=['disc.png', '--set'], env=self.screen)
        self.fail_with(2, 'view', 'disc.png', '--size', '3', '9', says=['--size'], env=self.screen)
        self.fail_with(4, 'view', 'disc.png', '--screenshot', 'no/such/a.png', '--exit', says=['no/such/a.png'], env=self.screen)

    def test_without_a_display(self):
        nowhere = {name: value for name, value in os.environ.items() if name not in ('DISPLAY', 'WAYLAND_DISPLAY')}
        self.fail_with(4, 'view', 'disc.png', says=['no window', 'DISPLAY'], env=nowhere)
        self.fail_with(4, 'view', 'disc.png', says=['no window'], env={**nowhere, 'DISPLAY': ':4711'})


if __name__ == '__main__':
    unittest.main()
