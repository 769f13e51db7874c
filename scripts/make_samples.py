#!/usr/bin/env python3
"""Draws the pictures in public/samples: NAME.svg, and NAME.png rendered from it.

usage: python3 scripts/make_samples.py [FOLDER]     (needs rsvg-convert, Debian package librsvg2-bin)

Every drawing is made of a few flat colours. Its PNG has a palette of these and of their mixtures, to be small.
"""
import math
import pathlib
import struct
import subprocess
import sys
import zlib

BLACK, WHITE = '#000000', '#ffffff'
BASALT, LIME, OCHRE, ROSE = '#26262a', '#f3eee2', '#c8923e', '#b4615a'  # stones


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1] / 'public/samples')
    folder.mkdir(parents=True, exist_ok=True)
    for name, (width, height, colours, shapes) in samples().items():
        svg = folder / f'{name}.svg'
        svg.write_text(document(width, height, shapes), encoding='utf-8')
        rendered = subprocess.run(['rsvg-convert', str(svg)], check=True, capture_output=True).stdout
        (folder / f'{name}.png').write_bytes(with_palette(rendered, mixtures(colours)))


def samples():
    """name -> (width, height, colours, shapes)"""
    return {'waves': (1024, 1024, (BLACK, WHITE), waves()),
            'ornament': (1024, 1024, (BLACK, WHITE), ornament()),
            'lettering': (1400, 700, (BLACK, WHITE), lettering()),
            'tiles': (1024, 1024, (LIME, BASALT, OCHRE, ROSE), tiles())}


# ---- Shapes: lines of SVG

def document(width, height, shapes):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}">\n' + '\n'.join(shapes) + '\n</svg>\n')


def number(value):
    return f'{round(value, 2) + 0:g}'


def polygon(points, fill=BLACK):
    return f'<path d="M{"L".join(f"{number(x)} {number(y)}" for x, y in points)}Z" fill="{fill}"/>'


def rect(x, y, width, height, fill=BLACK):
    return f'<rect x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}" fill="{fill}"/>'


def circle(x, y, radius, fill=BLACK):
    return f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}" fill="{fill}"/>'


def ring(x, y, radius, width, colour=BLACK):
    return (f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}" fill="none" stroke="{colour}" '
            f'stroke-width="{number(width)}"/>')


def frame(x, y, width, height, thickness, colour=BLACK):
    return [rect(x, y, width, thickness, colour), rect(x, y + height - thickness, width, thickness, colour),
            rect(x, y, thickness, height, colour), rect(x + width - thickness, y, thickness, height, colour)]


def placed(x, y, shapes, turn=0, mirrored=False):
    flip = ' scale(-1 1)' if mirrored else ''
    return [f'<g transform="translate({number(x)} {number(y)}) rotate({number(turn)}){flip}">', *shapes, '</g>']


def around(count, x, y, shapes, start=0):
    """`count` copies of shapes drawn about (0, 0), turned about (x, y)."""
    return [line for k in range(count) for line in placed(x, y, shapes, start + 360 * k / count)]


def ribbon(points, width, fill=BLACK):
    """A brush stroke along the points, width(t) wide where t = 0..1 is the part of them that is done."""
    left, right = [], []
    for k, (x, y) in enumerate(points):
        (ax, ay), (bx, by) = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        reach = width(k / (len(points) - 1)) / 2 / math.hypot(bx - ax, by - ay)
        left.append((x + (ay - by) * reach, y + (bx - ax) * reach))
        right.append((x - (ay - by) * reach, y - (bx - ax) * reach))
    return polygon(left + right[::-1], fill)


def arc(x, y, rx, ry, start, end, steps=40):
    """Points of an ellipse's arc between two angles in degrees, clockwise from the right where end > start."""
    angles = [math.radians(start + (end - start) * k / steps) for k in range(steps + 1)]
    return [(x + rx * math.cos(a), y + ry * math.sin(a)) for a in angles]


def spiral(x, y, first, last, start, end, steps=100):
    """Points of a logarithmic spiral about (x, y) between two radii and two angles in degrees."""
    parts = [k / steps for k in range(steps + 1)]
    polar = [(first * (last / first) ** t, math.radians(start + (end - start) * t)) for t in parts]
    return [(x + r * math.cos(a), y + r * math.sin(a)) for r, a in polar]


def petal(inner, outer, half, fill=BLACK, belly=0.62):
    """A leaf that points up, between two distances from (0, 0), widest at `belly` of its length."""
    low, high = inner + (outer - inner) * belly * 0.55, inner + (outer - inner) * (0.45 + 0.55 * belly)
    n = number
    slim = half * 0.7  # at the tip
    return (f'<path d="M0 {n(-inner)}C{n(half)} {n(-low)} {n(slim)} {n(-high)} 0 {n(-outer)}'
            f'C{n(-slim)} {n(-high)} {n(-half)} {n(-low)} 0 {n(-inner)}Z" fill="{fill}"/>')


# ---- Pictures

def waves():
    """Bands whose neighbouring edges swing in opposite phase, with fuller crests than a sine's."""
    period, spacing, swing = 512, 1024 / 6, 64

    def edge(k):
        y, side = (k + 0.5) * spacing, swing if k % 2 == 0 else -swing
        phases = [(x, 2 * math.pi * x / period) for x in range(0, 1025, 4)]
        return [(x, y + side * math.sin(p + 0.1 * math.sin(2 * p))) for x, p in phases]

    return [rect(0, 0, 1024, 1024, WHITE), *(polygon(edge(k) + edge(k + 1)[::-1]) for k in range(-1, 6, 2))]


def ornament():
    centre = 512
    swell = lambda t: 4 + 17 * math.sin(math.pi * t) ** 1.2
    volute = [ribbon(spiral(53, -341, 76, 12, 134, -420), swell), circle(53, -341, 15)]
    sector = [petal(86, 268, 62), petal(118, 228, 22, WHITE), *volute, *placed(0, 0, volute, mirrored=True)]
    between = [petal(226, 424, 26), petal(92, 190, 20), circle(0, -208, 8)]
    side = [petal(40, 124, 20)]
    corner = [petal(36, 156, 30), *placed(0, 0, side, 34), *placed(0, 0, side, -34), circle(0, 0, 24)]
    return [rect(0, 0, 1024, 1024, WHITE),
            ring(centre, centre, 488, 14), ring(centre, centre, 441, 5),
            *around(72, centre, centre, [circle(0, -464, 8)]),
            *around(8, centre, centre, sector), *around(8, centre, centre, between, 22.5),
            ring(centre, centre, 60, 13), circle(centre, centre, 30),
            *around(4, centre, centre, placed(0, -470 * math.sqrt(2), corner, 180), 45)]


def lettering():
    word, x = [], 0
    for letter in 'TESSERA':
        shapes, width = CAPITALS[letter]()
        word += placed(x, 0, shapes)
        x += width + 20
    branch = garland(52, 560, 9)
    return [rect(0, 0, 1400, 700, WHITE), *frame(24, 24, 1352, 652, 18), *frame(54, 54, 1292, 592, 6),
            *placed(700 - (x - 20) / 2, 118, word),
            *placed(700, 560, branch), *placed(700, 560, branch, mirrored=True),
            *around(8, 700, 560, [petal(12, 42, 11)]), circle(700, 560, 9)]


def garland(x0, x1, leaves):
    """A branch to the right, with pairs of leaves and a berry at its end."""
    step = (x1 - x0) / leaves
    pairs = [line for k in range(leaves) for turn in (58, 122)
             for line in placed(x0 + (k + 0.1) * step, 0, [petal(6, 50, 15)], turn)]
    return [rect(x0, -2.5, x1 - x0, 5), *pairs, circle(x1, 0, 9)]


CAPITAL, STEM, HAIR = 336, 58, 22  # height of the letters, and their thick and thin strokes


def slab(x, width=STEM):
    """The thin foot under a stem."""
    return rect(x - 18, CAPITAL - HAIR, width + 36, HAIR)


def wedge(x, y, down, inwards):
    """How a thin arm ends."""
    return polygon([(x, y), (x, y + down * 84), (x + inwards * 10, y + down * 84),
                    (x + inwards * 44, y + down * HAIR), (x + inwards * 44, y)])


def capital_t():
    width, stem = 154, (154 - STEM) / 2
    return [rect(0, 0, width, HAIR), wedge(0, 0, 1, 1), wedge(width, 0, 1, -1), rect(stem, 0, STEM, CAPITAL),
            slab(stem)], width


def capital_e():
    width, middle = 136, 150
    return [rect(14, 0, STEM, CAPITAL), rect(0, 0, width - 6, HAIR), wedge(width - 6, 0, 1, -1),
            rect(14, middle, 88, HAIR), rect(92, middle - 30, 12, HAIR + 60),
            rect(0, CAPITAL - HAIR, width, HAIR), wedge(width, CAPITAL, -1, -1)], width


def capital_s():
    width, upper, lower = 142, 84, 95
    middle = width / 2
    spine = (arc(middle, upper, 48, upper - HAIR / 2, -32, -270)[:-1] +
             arc(middle, CAPITAL - lower, 48, lower - HAIR / 2, -90, 148))
    thick = lambda t: HAIR + (STEM + 4 - HAIR) * max(0, math.cos(math.pi * (t - 0.5) / 0.74)) ** 1.5
    return [ribbon(spine, thick), circle(*spine[0], 21), circle(*spine[-1], 21)], width


def capital_r():
    width, bowl = 174, 88
    right = 14 + STEM
    outer = [(right, 0)] + arc(right + 22, bowl, 62, bowl, -90, 90) + [(right, 2 * bowl)]
    inner = [(right, HAIR)] + arc(right + 22, bowl, 62 - STEM + 10, bowl - HAIR, -90, 90) + [(right, 2 * bowl - HAIR)]
    leg = [(82, 2 * bowl - HAIR), (82 + STEM, 2 * bowl - HAIR), (width - 8, CAPITAL), (width - 8 - STEM, CAPITAL)]
    return [polygon(outer), polygon(inner, WHITE), rect(14, 0, STEM, CAPITAL), rect(0, 0, 40, HAIR),
            slab(18, STEM - 8), polygon(leg), rect(width - 16 - STEM, CAPITAL - HAIR, STEM + 16, HAIR)], width


def capital_a():
    width, apex = 192, 90
    thin = [(20, CAPITAL), (apex - 14, 0), (apex + 12, 0), (20 + 26, CAPITAL)]
    heavy = [(width - 22 - STEM - 8, CAPITAL), (apex - 14, 0), (apex + STEM - 14, 0), (width - 22, CAPITAL)]
    return [polygon(thin), polygon(heavy), rect(46, 214, 90, HAIR), slab(22, 22),
            slab(width - 26 - STEM, STEM + 4)], width


CAPITALS = {'T': capital_t, 'E': capital_e, 'S': capital_s, 'R': capital_r, 'A': capital_a}


def tiles():
    """Four painted tiles; their corners and edges make new figures together."""
    big = [petal(40, 232, 92, BASALT), petal(62, 206, 62, OCHRE), petal(92, 176, 20, LIME)]
    small = [petal(36, 214, 56, BASALT), petal(66, 184, 28, ROSE)]
    corner = [circle(0, 0, 138, BASALT), circle(0, 0, 122, ROSE), circle(0, 0, 84, LIME),
              *around(8, 0, 0, [petal(20, 78, 24, BASALT)]), circle(0, 0, 22, OCHRE)]
    edge = [*around(2, 0, 0, [petal(14, 96, 34, BASALT)]), circle(0, 0, 22, BASALT), circle(0, 0, 12, OCHRE)]
    grid = (0, 512, 1024)
    shapes = [rect(0, 0, 1024, 1024, LIME)]
    for x in (256, 768):
        for y in (256, 768):
            shapes += around(4, x, y, small, 45) + around(4, x, y, big)
            shapes += [circle(x, y, 50, BASALT), circle(x, y, 38, LIME), circle(x, y, 22, ROSE)]
    for x in grid:
        for y in grid:
            shapes += placed(x, y, corner)
            shapes += placed(x + 256, y, edge, 90) + placed(x, y + 256, edge)
    return shapes


# ---- PNG with a palette

def mixtures(colours, steps=15):
    """The colours and what anti-aliasing makes of two of them, as a palette of (r, g, b)."""
    rgb = [tuple(int(c[k:k + 2], 16) for k in (1, 3, 5)) for c in colours]
    pairs = [(a, b) for i, a in enumerate(rgb) for b in rgb[i + 1:]]
    mixed = {tuple(round(u + (v - u) * k / steps) for u, v in zip(a, b)) for a, b in pairs for k in range(steps + 1)}
    return sorted(mixed)


def with_palette(png, palette):
    """The same picture with each pixel replaced by the nearest palette entry."""
    width, height, rows = decoded(png)
    bits = 4 if len(palette) <= 16 else 8
    nearest = {}
    lines = bytearray()
    for row in rows:
        indices = []
        for k in range(0, len(row), 3):
            pixel = bytes(row[k:k + 3])
            if pixel not in nearest:
                nearest[pixel] = min(range(len(palette)), key=lambda i: math.dist(pixel, palette[i]))
            indices.append(nearest[pixel])
        lines.append(0)
        lines += bytes(indices) if bits == 8 else bytes(a << 4 | b for a, b in zip(indices[::2], indices[1::2]))
    header = struct.pack('>IIBBBBB', width, height, bits, 3, 0, 0, 0)
    chunks = [(b'IHDR', header), (b'PLTE', bytes(v for entry in palette for v in entry)),
              (b'IDAT', zlib.compress(bytes(lines), 9)), (b'IEND', b'')]
    return b'\x89PNG\r\n\x1a\n' + b''.join(struct.pack('>I', len(data)) + kind + data +
                                           struct.pack('>I', zlib.crc32(kind + data)) for kind, data in chunks)


def decoded(png):
    """(width, height, rows of RGB bytes) of a PNG of 8 bits, RGB or by a palette."""
    at, data, palette = 8, b'', None
    while at < len(png):
        length, kind = struct.unpack('>I4s', png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b'IHDR':
            width, height, *layout = struct.unpack('>IIBBBBB', body)
            assert layout in ([8, 2, 0, 0, 0], [8, 3, 0, 0, 0]), layout
        elif kind == b'PLTE':
            palette = [body[k:k + 3] for k in range(0, length, 3)]
        elif kind == b'IDAT':
            data += body
        at += 12 + length
    step = 1 if palette else 3  # bytes a pixel
    data, stride, rows, above = zlib.decompress(data), step * width, [], bytearray(step * width)
    for y in range(height):
        line = data[y * (stride + 1):(y + 1) * (stride + 1)]
        above = unfiltered(line[0], bytearray(line[1:]), above, step)
        rows.append(b''.join(palette[i] for i in above) if palette else above)
    return width, height, rows


def unfiltered(kind, row, above, step):
    for i in range(len(row)):
        left, up, corner = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
        if kind == 4:
            guess = min((abs(up - corner), 0, left), (abs(left - corner), 1, up),
                        (abs(left + up - 2 * corner), 2, corner))[2]
        else:
            guess = (0, left, up, (left + up) // 2)[kind]
        row[i] = (row[i] + guess) & 255
    return row


if __name__ == '__main__':
    main()
