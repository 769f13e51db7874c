#!/usr/bin/env python3
"""Paints public/samples/panels/walnut.png: a board of veneer to start a parquetry from, light sapwood to dark heartwood.

usage: python3 scripts/paint_panel.py [FILE]

A log's yearly rings are cylinders around its pith, a little uneven; the board is where a plane cuts them. 32 colours keep
the file small; it tells its resolution.
"""
import math
import pathlib
import struct
import sys
import zlib

from paint_samples import clamp, noise, ramp, smooth

WIDTH, HEIGHT, DPI = 1000, 760, 100
COLOURS = 32
TONES = [(0.0, (244, 222, 184)), (0.3, (222, 186, 136)), (0.6, (166, 116, 72)), (0.85, (104, 64, 38)), (1.0, (52, 30, 20))]
PALETTE = [ramp(TONES, i / (COLOURS - 1)) for i in range(COLOURS)]


def darkness(x, y):
    """0 to 1 at a place of the board, whose grain runs along x."""
    pith = HEIGHT * 0.62 + 60 * noise(x / 420, 1.5, 1)
    across = (y - pith) / HEIGHT
    depth = 0.16 + 0.2 * ((x - WIDTH * 0.4) / WIDTH) ** 2 + 0.03 * noise(x / 160, y / 60, 2)  # of the pith below the plane
    radius = math.hypot(across, depth)
    heart = smooth(1.25 - 1.7 * radius)
    year = 42 * radius + 0.5 * noise(x / 240, y / 24, 3)
    late = (year - math.floor(year)) ** 2.2  # wood gets darker towards a year's end
    pore = smooth(4 * noise(x / 34, y / 1.6, 4) - 2.9)
    return clamp(0.04 + 0.74 * heart + (0.14 + 0.16 * heart) * late + 0.2 * pore)


def png(levels):
    lines = b''.join(b'\0' + bytes(row) for row in levels)
    per_metre = round(DPI / 0.0254)
    colours = bytes(round(v) for colour in PALETTE for v in colour)
    chunks = [(b'IHDR', struct.pack('>IIBBBBB', WIDTH, HEIGHT, 8, 3, 0, 0, 0)),
              (b'pHYs', struct.pack('>IIB', per_metre, per_metre, 1)), (b'PLTE', colours),
              (b'IDAT', zlib.compress(lines, 9)), (b'IEND', b'')]
    return b'\x89PNG\r\n\x1a\n' + b''.join(struct.pack('>I', len(data)) + kind + data +
                                           struct.pack('>I', zlib.crc32(kind + data)) for kind, data in chunks)


def main():
    path = pathlib.Path(sys.argv[1] if len(sys.argv) > 1
                        else pathlib.Path(__file__).parents[1] / 'public/samples/panels/walnut.png')
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(png([[round((COLOURS - 1) * darkness(x + 0.5, y + 0.5)) for x in range(WIDTH)] for y in range(HEIGHT)]))


if __name__ == '__main__':
    main()
