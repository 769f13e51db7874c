#!/usr/bin/env python3
"""Makes docs/kerf-test.svg and docs/kerf-test.dxf: ten tiles in a frame that tell a laser's kerf (docs/makers.md).

usage: python3 scripts/make_kerf_test.py
"""
import pathlib

DOCS = pathlib.Path(__file__).resolve().parents[1] / 'docs'
TILES, SIDE, HEIGHT, MARGIN = 10, 10, 20, 5  # mm
WIDTH = TILES * SIDE

# Inner lines first: what is still held does not move while it is cut.
INNER = [((x, 0), (x, HEIGHT)) for x in range(SIDE, WIDTH, SIDE)]
HOLE = [(0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT)]
FRAME = [(-MARGIN, -MARGIN), (WIDTH + MARGIN, -MARGIN), (WIDTH + MARGIN, HEIGHT + MARGIN), (-MARGIN, HEIGHT + MARGIN)]


def svg():
    def path(points, close):
        return '<path d="M' + ' L'.join(f'{x + MARGIN} {y + MARGIN}' for x, y in points) + (' Z' if close else '') + '"/>'

    paths = [path(line, False) for line in INNER] + [path(HOLE, True), path(FRAME, True)]
    width, height = WIDTH + 2 * MARGIN, HEIGHT + 2 * MARGIN
    return '\n'.join([
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
        f' width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">',
        '<g id="cut" inkscape:groupmode="layer" inkscape:label="cut" fill="none" stroke="#ff0000" stroke-width="0.01">',
        *paths, '</g>', '</svg>', ''])


def dxf():
    """Of the kind R12, with y up."""
    lines = list(INNER)
    for ring in (HOLE, FRAME):
        lines += zip(ring, ring[1:] + ring[:1])
    groups = [(0, 'SECTION'), (2, 'HEADER'), (9, '$ACADVER'), (1, 'AC1009'), (9, '$MEASUREMENT'), (70, 1), (0, 'ENDSEC'),
              (0, 'SECTION'), (2, 'ENTITIES')]
    for (x0, y0), (x1, y1) in lines:
        groups += [(0, 'LINE'), (8, 'cut'), (62, 1), (10, x0 + MARGIN), (20, HEIGHT + MARGIN - y0), (30, 0),
                   (11, x1 + MARGIN), (21, HEIGHT + MARGIN - y1), (31, 0)]
    groups += [(0, 'ENDSEC'), (0, 'EOF')]
    return ''.join(f'{code}\n{value}\n' for code, value in groups)


(DOCS / 'kerf-test.svg').write_text(svg())
(DOCS / 'kerf-test.dxf').write_text(dxf())
