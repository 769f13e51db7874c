#!/usr/bin/env python3
"""Makes docs/gallery.md and its pictures in docs/images/gallery: the comparisons of "Computational Parquetry" (Fig. 5, 8,
10 to 13 and 18) with samples of the project's own.

usage: python3 scripts/make_gallery.py [TESSERA]     (else build/native-release/bin/tessera; needs cjpeg, Debian package
                                                      libjpeg-turbo-progs)
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

from make_samples import decoded

ROOT = pathlib.Path(__file__).resolve().parents[1]
SAMPLES, FOLDER = ROOT / 'public/samples', ROOT / 'docs/images/gallery'
BOARD = 'panels/walnut.png'
QUALITY = 75  # of the JPEGs
MEAN = 'its pieces in their mean colours'  # instead of options: made of the picture before the last two

COMMAND = 'tessera parquet fruit.png --panel walnut.png --image-size-mm 80'
COARSE, MIDDLE, FINE = '--patch-mm 16', '--patch-mm 10', '--patch-mm 6.5'

# (title, text, command, rows of pictures: (name, options, what one sees))
SECTIONS = [
    ('Resolution and shape of the pieces (Fig. 8)',
     'From left to right larger to smaller pieces; below all the paper\'s baseline, each square in the mean colour of its '
     'wood.',
     COMMAND,
     [[('squares-16', COARSE, 'No fruit can be told; the grain makes some edges.'),
       ('squares-10', MIDDLE, 'Apple and grapes are blocks; grain draws the bottle\'s neck.'),
       ('squares-6', FINE, 'Apple, melon and bottle can be told.')],
      [('morphed-16', f'{COARSE} --grid morphed', 'Some sides run along the table\'s edge and the melon\'s foot.'),
       ('morphed-10', f'{MIDDLE} --grid morphed', 'The apple is round at its foot, the bottle has a neck.'),
       ('morphed-6', f'{FINE} --grid morphed', 'Apple and melon are round, the bottle has shoulders.')],
      [('seams-16', f'{COARSE} --seams g1',
        'Pieces end where light meets dark; the apple is round at its foot.'),
       ('seams-10', f'{MIDDLE} --seams g1', 'The apple has no corners left, the cloth\'s edge fewer steps.'),
       ('seams-6', f'{FINE} --seams g1', 'The melon\'s rind is a curve, the bottle\'s neck goes on from piece to piece.')],
      [('mean-16', MEAN, 'Without the grain there is no picture.'),
       ('mean-10', MEAN, 'A mosaic of pixels.'),
       ('mean-6', MEAN, 'The melon\'s stripes are left, all edges are gone.')]]),
    ('Histogram matching (Fig. 5 and 10)',
     'How far the picture\'s tones are moved to those of the board, which has more light wood than dark. The cost is that '
     'of the picture with its tones moved.',
     f'{COMMAND} --patch-mm 8',
     [[('histogram-0', '--weight-histogram 0', 'The picture\'s own tones: a grey background.'),
       ('histogram-5', '--weight-histogram 0.5', 'Half of the way, as by default.'),
       ('histogram-10', '--weight-histogram 1', 'The darkest and the lightest wood are used, too; contrast is highest.')]]),
    ('Weights of the features (Fig. 12)',
     'Brightness against edges. The cost is that of equal weights for all three.',
     f'{COMMAND} --patch-mm 8',
     [[('weights-10', '--weight-intensity 1 --weight-edge 0', 'Even areas are even; edges are where grain happens to be.'),
       ('weights-5', '--weight-intensity 0.5 --weight-edge 0.5', 'Both, as by default.'),
       ('weights-2', '--weight-intensity 0.2 --weight-edge 0.8', 'The bottle\'s and the fruit\'s edges are kept, areas are less even.')]]),
    ('Seams on and off (Fig. 13)',
     'Pieces cut straight, where the picture gains most with corners, and smoothly.',
     f'{COMMAND} --patch-mm 12',
     [[('seams-none', '--seams none', 'Squares.'),
       ('seams-g0', '--seams g0', 'Apple and melon have round outlines, a light edge ends at the bottle.'),
       ('seams-g1', '--seams g1', 'The same without corners.')]]),
    ('Adaptive patches (Fig. 11)',
     'Squares of 24 mm are quartered, once or twice, where their quarters cost less than the factor times as much. With the '
     'paper\'s factors of 1.2 and 1.5 all squares are, on this board.',
     f'{COMMAND} --patch-mm 24 --min-width-mm 4',
     [[('adaptive-1-7', '--adaptive-levels 1 --adaptive-factor 0.7', 'Background and bottle are quartered, the fruit in front is not.'),
       ('adaptive-2-7', '--adaptive-levels 2 --adaptive-factor 0.7', 'Small pieces for the bottle and the melon.'),
       ('adaptive-2-5', '--adaptive-levels 2 --adaptive-factor 0.55', 'Fewer of them: the melon stays whole.')]]),
    ('Pieces of any shape (Fig. 18)',
     'A picture in few tones, whose regions are the pieces, and a drawing whose shapes are.',
     'tessera parquet PICTURE --panel walnut.png --image-size-mm 80',
     [[('posterize-4', 'fruit.png --posterize 4', 'A few large pieces, as in marquetry.'),
       ('posterize-8', 'fruit.png --posterize 8', 'Stripes of the melon and the bottle\'s label have pieces.'),
       ('segmentation', 'tiles.png --segmentation tiles.svg --min-width-mm 3', 'The drawing\'s shapes, each of one piece of wood.')]]),
]


# ---- Pictures are lists of rows of (r, g, b); levels lists of rows of numbers

def read_png(path):
    width, _, rows = decoded(path.read_bytes())
    return [[tuple(row[3 * x:3 * x + 3]) for x in range(width)] for row in rows]


def spans(length, parts):
    """For each part the pixels in it, and how much of each."""
    scale = length / parts
    for k in range(parts):
        low, high = k * scale, (k + 1) * scale
        yield [(i, min(i + 1, high) - max(i, low)) for i in range(int(low), min(length, int(high - 1e-9) + 1))]


def resized(levels, width, height):
    """Means of areas."""
    across = [[sum(row[i] * part for i, part in span) for span in spans(len(row), width)] for row in levels]
    scale = width * height / (len(levels) * len(levels[0]))
    return [[scale * sum(across[i][x] * part for i, part in span) for x in range(width)]
            for span in spans(len(levels), height)]


def intensity(picture):
    return [[(77 * r + 150 * g + 29 * b) / 256 for r, g, b in row] for row in picture]


def edges(levels):
    """A quarter of Sobel's gradient."""
    height, width = len(levels), len(levels[0])
    found = []
    for y in range(height):
        above, here, below = levels[max(0, y - 1)], levels[y], levels[min(height - 1, y + 1)]
        line = []
        for x in range(width):
            l, r = max(0, x - 1), min(width - 1, x + 1)
            across = above[r] - above[l] + 2 * (here[r] - here[l]) + below[r] - below[l]
            down = below[l] - above[l] + 2 * (below[x] - above[x]) + below[r] - above[r]
            line.append(min(255, (across * across + down * down) ** 0.5 / 4))
        found.append(line)
    return found


def matched(levels, wood, weight):
    """Eq. 2: by `weight` of the way to the wood's level with as many below."""
    flat = sorted(v for row in levels for v in row)
    ranks = {}
    for i, v in enumerate(flat):
        first, _ = ranks.get(round(v), (i, i))
        ranks[round(v)] = (first, i)
    wood = sorted(v for row in wood for v in row)

    def moved(v):
        first, last = ranks[round(v)]
        return (1 - weight) * v + weight * wood[min(len(wood) - 1, (first + last) * len(wood) // (2 * len(flat)))]
    return [[moved(v) for v in row] for row in levels]


def cost(picture, target, wood, weight):
    """Eq. 8 a pixel, of what one sees: edges where pieces meet are among the picture's."""
    have, want = intensity(picture), resized(intensity(target), len(picture[0]), len(picture))
    features = zip((have, edges(have)), (matched(want, wood, weight), edges(want)))
    squares = sum((a - b) ** 2 for ours, theirs in features for u, v in zip(ours, theirs) for a, b in zip(u, v))
    return squares / (len(have) * len(have[0]))


def in_mean_colours(picture, across, down):
    """The picture of a grid of squares, each in its mean colour."""
    height, width = len(picture), len(picture[0])
    rows = [list(row) for row in picture]
    for j in range(down):
        for i in range(across):
            ys, xs = (range(k * size // parts, (k + 1) * size // parts)
                      for k, size, parts in ((j, height, down), (i, width, across)))
            pixels = [picture[y][x] for y in ys for x in xs]
            mean = tuple(round(sum(p[c] for p in pixels) / len(pixels)) for c in range(3))
            for y in ys:
                rows[y][xs.start:xs.stop] = [mean] * len(xs)
    return rows


def write_jpeg(path, picture):
    ppm = f'P6 {len(picture[0])} {len(picture)} 255\n'.encode() + bytes(v for row in picture for p in row for v in p)
    done = subprocess.run(['cjpeg', '-quality', str(QUALITY), '-optimize'], input=ppm, check=True, capture_output=True)
    path.write_bytes(done.stdout)


# ---- The page

class Gallery:
    def __init__(self, tessera):
        self.tessera = tessera
        self.wood = intensity(read_png(SAMPLES / BOARD))
        self.made = {}  # name -> picture, pieces across and down

    def make(self, name, words):
        """The picture, and how many pieces it has and what it costs."""
        sample = next(word for word in words if word.endswith('.png'))
        with tempfile.TemporaryDirectory() as folder:
            paths = [str(SAMPLES / word) if (SAMPLES / word).is_file() else word for word in words]
            out = pathlib.Path(folder, 'made')
            subprocess.run([self.tessera, *paths, '-o', out, '--quiet'], check=True)
            picture = read_png(out / 'preview.png')
            job = json.loads((out / 'job.json').read_text(encoding='utf-8'))
            with open(out / 'pieces.csv', newline='', encoding='utf-8') as file:
                rows = list(csv.DictReader(file))
        self.made[name] = picture, max(int(row['column']) for row in rows), max(int(row['row']) for row in rows)
        weight = job['params'].get('weightHistogram', 0.5)
        return picture, len(rows), cost(picture, read_png(SAMPLES / sample), self.wood, weight)

    def make_mean(self, name):
        base = name.replace('mean', 'squares')
        picture, across, down = self.made[base]
        flat = in_mean_colours(picture, across, down)
        return flat, across * down, cost(flat, read_png(SAMPLES / 'fruit.png'), self.wood, 0.5)

    def entry(self, command, name, options):
        if options == MEAN:
            picture, pieces, price = self.make_mean(name)
        else:
            words = command.replace(' PICTURE', '').split()[1:] + options.split()
            picture, pieces, price = self.make(name, [BOARD if word == 'walnut.png' else word for word in words])
        write_jpeg(FOLDER / f'{name}.jpg', picture)
        return f'{pieces} pieces, cost {price:.0f}'

    def section(self, title, text, command, rows):
        lines = [f'## {title}', '', text, '', '```', command, '```', '']
        for number, pictures in enumerate(rows):
            cells = [[f'![{name}](images/gallery/{name}.jpg)' for name, _, _ in pictures],
                     [options if options == MEAN else f'`{options}`' for _, options, _ in pictures],
                     [self.entry(command, name, options) for name, options, _ in pictures],
                     [seen for _, _, seen in pictures]]
            if number == 0:
                cells.insert(1, ['---'] * len(pictures))
            lines += ['| ' + ' | '.join(row) + ' |' for row in cells]
        return '\n'.join(lines) + '\n'


INTRODUCTION = """# Gallery of wood parquetry

What the parameters of [parquetry](parquetry.md) do: the comparisons of the paper, made by `scripts/make_gallery.py` from
the samples `fruit.png`, `tiles.png` and `panels/walnut.png`. All of it is one painted board of 254 x 193 mm; several kinds
of wood do better. The cost is Eq. 8 a pixel, measured on the picture that one sees.
"""


def main():
    gallery = Gallery(sys.argv[1] if len(sys.argv) > 1 else ROOT / 'build/native-release/bin/tessera')
    FOLDER.mkdir(parents=True, exist_ok=True)
    sections = [gallery.section(*section) for section in SECTIONS]
    (ROOT / 'docs/gallery.md').write_text('\n'.join([INTRODUCTION, *sections]), encoding='utf-8')


if __name__ == '__main__':
    main()
