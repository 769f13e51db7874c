#!/usr/bin/env python3
"""Makes the pictures in docs/images from what scripts/demo has left in out/.

usage: python3 scripts/make_images.py     (needs rsvg-convert, Debian package librsvg2-bin)
"""
import pathlib
import re
import subprocess

from make_samples import mixtures, with_palette

ROOT = pathlib.Path(__file__).resolve().parents[1]
PIXELS_A_SOURCE_PIXEL = 3

# name -> (SVG in out/, x, y, width, height of the detail in source pixels)
DETAILS = {'waves': ('waves.svg', 330, 360, 320, 150)}


def main():
    folder = ROOT / 'docs/images'
    folder.mkdir(parents=True, exist_ok=True)
    for name, (source, *box) in DETAILS.items():
        svg = detail((ROOT / 'out' / source).read_text(encoding='utf-8'), *box)
        done = subprocess.run(['rsvg-convert', '--format', 'png'], input=svg.encode(), check=True, capture_output=True)
        colours = sorted(set(re.findall(r'fill="(#[0-9a-f]{6})"', svg)))
        (folder / f'{name}.png').write_bytes(with_palette(done.stdout, mixtures(colours)))


def detail(svg, x, y, width, height):
    """The SVG with another window on the same drawing."""
    size = (f'width="{width * PIXELS_A_SOURCE_PIXEL}" height="{height * PIXELS_A_SOURCE_PIXEL}" '
            f'viewBox="{x} {y} {width} {height}"')
    return re.sub(r'width="[^"]*" height="[^"]*" viewBox="[^"]*"', size, svg, count=1)


if __name__ == '__main__':
    main()
