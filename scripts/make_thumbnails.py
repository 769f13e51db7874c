#!/usr/bin/env python3
"""Makes public/samples/thumbnails: every sample reduced to what its button shows, so that a page which opens need not
decode the pictures themselves.

usage: python3 scripts/make_thumbnails.py     (needs rsvg-convert, Debian package librsvg2-bin)
"""
import pathlib
import subprocess

from make_samples import decoded
from paint_samples import png

SAMPLES = pathlib.Path(__file__).resolve().parents[1] / 'public/samples'
WIDTH, HEIGHT = 152, 112  # twice the button's, for fine screens


def pixels_of(sample):
    """(width, height, rows of RGB bytes); a drawing's PNG has a palette, so its original is taken."""
    drawing = sample.with_suffix('.svg')
    if drawing.exists():
        return decoded(subprocess.run(['rsvg-convert', str(drawing)], check=True, capture_output=True).stdout)
    return decoded(sample.read_bytes())


def reduced(width, height, rows, new_width, new_height):
    """The middle of the picture in the new size's proportions, each pixel the mean of those it stands for."""
    scale = min(width / new_width, height / new_height)
    left, top = (width - new_width * scale) / 2, (height - new_height * scale) / 2

    def span(start, k):
        return range(int(start + k * scale), max(int(start + k * scale) + 1, int(start + (k + 1) * scale)))

    def mean(columns, lines, c):
        return sum(rows[y][3 * x + c] for y in lines for x in columns) / (len(columns) * len(lines))

    return [[tuple(mean(span(left, i), span(top, j), c) for c in range(3)) for i in range(new_width)]
            for j in range(new_height)]


def main():
    folder = SAMPLES / 'thumbnails'
    folder.mkdir(exist_ok=True)
    for sample in SAMPLES.glob('*.png'):
        (folder / sample.name).write_bytes(png(reduced(*pixels_of(sample), WIDTH, HEIGHT)))


if __name__ == '__main__':
    main()
