#!/usr/bin/env python3
"""Makes the pictures of the presets in public/presets: what the native program makes of a small wave, a pavement's, and
of a piece of a sample, a mosaic's; and those of a pattern's models in public/models.

usage: python3 scripts/make_presets.py [TESSERA]     (else build/native-release/bin/tessera)
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from make_samples import decoded
from make_thumbnails import reduced
from paint_samples import png

ROOT = pathlib.Path(__file__).resolve().parents[1]
SAMPLE = ROOT / 'public/samples/fruit.png'
LEFT, TOP, WIDTH, HEIGHT = 200, 432, 152, 114  # of the piece, and the size of all pictures
MODELS = {'size': 22, 'width': WIDTH, 'height': HEIGHT}  # parameters of all models, and of some
OF_MODEL = {'points': {'size': 9, 'colors': '#22313f #e4dbcb'}, 'pixels': {'size': 5}, 'circles': {'length': 16},
            'delaunay': {'size': 15}, 'triangle': {'size': 30}, 'hexagon': {'size': 15},
            'segments': {'size': 14, 'length': 24}}
LIGHT, DARK = (232, 232, 228), (34, 34, 34)


def wave():
    """One wave, light above dark, as a picture's rows of pixels."""
    def pixel(x, y):
        edge = HEIGHT / 2 + 23.5 * math.cos(2 * math.pi * (x + 0.5 - 54) / WIDTH)
        dark = min(max(y + 1 - edge, 0), 1)  # part of the pixel
        return tuple(light + dark * (deep - light) for light, deep in zip(LIGHT, DARK))
    return [[pixel(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]


def piece(width, height, rows):
    """The piece of the sample, and which part of the sample it is."""
    pixels = [[tuple(row[3 * x:3 * x + 3]) for x in range(LEFT, LEFT + WIDTH)] for row in rows[TOP:TOP + HEIGHT]]
    return pixels, WIDTH * HEIGHT / (width * height)


def make(tessera, folder, technique, inputs, params):
    """What the program makes of pictures in the folder, by role: width, height, rows of bytes."""
    job, made = pathlib.Path(folder, 'job.json'), pathlib.Path(folder, 'made.png')
    job.write_text(json.dumps({'schemaVersion': 1, 'technique': technique, 'seed': 1, 'params': params,
                               'inputs': inputs}), encoding='utf-8')
    subprocess.run([tessera, 'run', job, '-o', made, '--backend', 'cpu', '--quiet'], check=True)
    return decoded(made.read_bytes())


def main():
    tessera = sys.argv[1] if len(sys.argv) > 1 else ROOT / 'build/native-release/bin/tessera'
    presets = json.loads((ROOT / 'web/src/techniques/presets.json').read_text(encoding='utf-8'))
    photo, part = piece(*decoded(SAMPLE.read_bytes()))
    with tempfile.TemporaryDirectory() as folder:
        for technique, role, picture in (('pavement', 'drawing', wave()), ('mosaic', 'photo', photo)):
            pathlib.Path(folder, 'input.png').write_bytes(png(picture))
            for preset in presets[technique]:
                params = dict(preset['params'])
                if technique == 'mosaic':
                    params['tiles'] = round(params.get('tiles', 2000) * part)
                result = reduced(*make(tessera, folder, technique, {role: 'input.png'}, params), WIDTH, HEIGHT)
                (ROOT / 'public' / preset['picture']).write_bytes(png(result))
        schema = json.loads(subprocess.run([tessera, 'schema', 'pattern'], check=True, capture_output=True).stdout)
        for model in schema['properties']['model']['enum']:
            params = {**MODELS, **OF_MODEL.get(model, {}), 'model': model}
            result = reduced(*make(tessera, folder, 'pattern', {}, params), WIDTH, HEIGHT)
            (ROOT / 'public/models' / f'{model}.png').write_bytes(png(result))


if __name__ == '__main__':
    main()
