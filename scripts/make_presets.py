#!/usr/bin/env python3
"""Makes the pictures of the mosaic's presets in public/presets: what the native program makes of a piece of a sample.

usage: python3 scripts/make_presets.py [TESSERA]     (else build/native-release/bin/tessera)
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from make_samples import decoded
from paint_samples import png

ROOT = pathlib.Path(__file__).resolve().parents[1]
SAMPLE = ROOT / 'public/samples/fruit.png'
LEFT, TOP, WIDTH, HEIGHT = 200, 432, 152, 114  # of the piece


def main():
    tessera = sys.argv[1] if len(sys.argv) > 1 else ROOT / 'build/native-release/bin/tessera'
    presets = json.loads((ROOT / 'web/src/techniques/presets.json').read_text(encoding='utf-8'))['mosaic']
    width, height, rows = decoded(SAMPLE.read_bytes())
    piece = [[tuple(row[3 * x:3 * x + 3]) for x in range(LEFT, LEFT + WIDTH)] for row in rows[TOP:TOP + HEIGHT]]
    part = WIDTH * HEIGHT / (width * height)
    with tempfile.TemporaryDirectory() as folder:
        photo, job = pathlib.Path(folder, 'piece.png'), pathlib.Path(folder, 'job.json')
        photo.write_bytes(png(piece))
        for preset in presets:
            params = {**preset['params'], 'tiles': round(preset['params'].get('tiles', 2000) * part)}
            job.write_text(json.dumps({'schemaVersion': 1, 'technique': 'mosaic', 'seed': 1, 'params': params,
                                       'inputs': {'photo': photo.name}}), encoding='utf-8')
            made = pathlib.Path(folder, 'made.png')
            subprocess.run([tessera, 'run', job, '-o', made, '--quiet'], check=True)
            (ROOT / 'public' / preset['picture']).write_bytes(png(reduced(*decoded(made.read_bytes()))))


def reduced(width, height, rows):
    """The piece's size again; the program draws a small picture larger."""
    step = width // WIDTH
    return [[tuple(sum(rows[y * step + j][3 * (x * step + i) + c] for j in range(step) for i in range(step)) / step ** 2
                   for c in range(3)) for x in range(WIDTH)] for y in range(HEIGHT)]


if __name__ == '__main__':
    main()
