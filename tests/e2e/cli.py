"""What the tests of the program share: a folder for each, pictures made from the letter of PNG's specification, and the
program run in it. Nothing but the standard library is needed.

The program is named by the environment variable TESSERA.
"""
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.path.abspath(os.environ.get('TESSERA', 'tessera'))


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png(width, height, pixel, claimed=None):
    """A grey picture of 8 bits; pixel(x, y) is its brightness. `claimed` is the size its header tells instead."""
    rows = b''.join(b'\0' + bytes(pixel(x, y) for x in range(width)) for y in range(height))
    header = struct.pack('>IIBBBBB', *(claimed or (width, height)), 8, 0, 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def disc(size):
    return png(size, size, lambda x, y: 0 if (x - size / 2) ** 2 + (y - size / 2) ** 2 < size * size / 9 else 255)


class CliTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.disc = disc(120)
        cls.large_disc = disc(400)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='tessera-cli-'))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.put('disc.png', self.disc)

    def put(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return path

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def names(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob('*') if p.is_file())

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, timeout=300,
                              **options)

    def succeed(self, *arguments, **options):
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fail_with(self, status, *arguments, lines=1, says=(), **options):
        """Runs what must fail: with this status, so many lines that say so, and nothing left behind."""
        before = self.names()
        done = self.run_program(*arguments, **options)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, status, text)
        self.assertEqual(text.count('\n'), lines, text)
        for line in text.splitlines():
            self.assertTrue(line.startswith('tessera: '), line)
        for words in says:
            self.assertIn(words, text)
        self.assertEqual(self.names(), before)
        return done
