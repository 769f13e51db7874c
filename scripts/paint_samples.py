#!/usr/bin/env python3
"""Paints the pictures in public/samples that are no drawings: fruit.png and coast.png, shaded smoothly, for mosaics;
pebbles.png, speckled as a photo is, for pebbles.

usage: python3 scripts/paint_samples.py [FOLDER]

Everything is a formula: where a shape is, which way its surface looks there, what light does to it.
"""
import math
import pathlib
import random
import struct
import sys
import zlib

WIDTH, HEIGHT = 900, 600
LIGHT = (-0.52, -0.62, 0.59)  # from the left, above, before


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1] / 'public/samples')
    folder.mkdir(parents=True, exist_ok=True)
    for name, paint in {'fruit': fruit, 'coast': coast, 'pebbles': pebbles}.items():
        (folder / f'{name}.png').write_bytes(png(paint()))


# ---- Colours are (r, g, b), 0 to 255; a canvas is a list of rows of these

def mix(a, b, part):
    return tuple(u + (v - u) * part for u, v in zip(a, b))


def ramp(stops, at):
    """The colour at a place between (place, colour) pairs."""
    for (p, a), (q, b) in zip(stops, stops[1:]):
        if at < q:
            return mix(a, b, smooth((at - p) / (q - p)))
    return stops[-1][1]


def clamp(value, low=0.0, high=1.0):
    return min(high, max(low, value))


def smooth(part):
    part = clamp(part)
    return part * part * (3 - 2 * part)


def blank(colour_at):
    return [[colour_at(x + 0.5, y + 0.5) for x in range(WIDTH)] for y in range(HEIGHT)]


def lay(canvas, box, coverage_and_colour):
    """Lays what the function says over the canvas: None, or (coverage, colour) at a place."""
    left, top, right, bottom = box
    for y in range(max(0, int(top)), min(HEIGHT, int(bottom) + 1)):
        row = canvas[y]
        for x in range(max(0, int(left)), min(WIDTH, int(right) + 1)):
            found = coverage_and_colour(x + 0.5, y + 0.5)
            if found:
                row[x] = mix(row[x], found[1], found[0])


def glow(canvas, x, y, rx, ry, colour, strength):
    """A soft patch, of light or shade."""
    def at(px, py):
        fall = 1 - ((px - x) / rx) ** 2 - ((py - y) / ry) ** 2
        return (strength * smooth(fall), colour) if fall > 0 else None
    lay(canvas, (x - rx, y - ry, x + rx, y + ry), at)


def polygon(canvas, points, colour_at):
    """With soft edges; the points go around clockwise or not."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    edges = list(zip(points, points[1:] + points[:1]))

    def at(px, py):
        inside, nearest = False, 9.0
        for (ax, ay), (bx, by) in edges:
            if (ay > py) != (by > py) and px < ax + (py - ay) * (bx - ax) / (by - ay):
                inside = not inside
            dx, dy = bx - ax, by - ay
            t = clamp(((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy))
            nearest = min(nearest, math.hypot(px - ax - t * dx, py - ay - t * dy))
        cover = clamp(0.5 + (nearest if inside else -nearest))
        return (cover, colour_at(px, py)) if cover > 0 else None
    lay(canvas, (min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1), at)


def ball(canvas, x, y, rx, ry, skin, turn=0, gloss=0.5, taper=0):
    """A round fruit. `skin(u, v)`: its colour, u and v from -1 to 1 along its axes; `taper` narrows its upper end."""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    reach = max(rx, ry) + 2

    def at(px, py):
        dx, dy = px - x, py - y
        u, v = (c * dx + s * dy) / rx, (c * dy - s * dx) / ry
        u /= 1 - taper * (0.5 - 0.5 * v) if taper else 1
        square = u * u + v * v
        if square > 1.2:
            return None
        cover = clamp(0.5 + (1 - math.sqrt(square)) * min(rx, ry))
        if cover == 0:
            return None
        square = min(1.0, square)
        nu, nv, nz = u, v, math.sqrt(1 - square)
        nx, ny = c * nu - s * nv, s * nu + c * nv
        facing = nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]
        lit = 0.24 + 0.86 * smooth(0.5 + 0.56 * facing)
        bounce = 0.10 * max(0.0, ny) * (1 - nz)  # from the table
        colour = mix((26, 18, 40), skin(u, v), clamp(lit + bounce))
        half = 2 * facing * nz - LIGHT[2]
        shine = gloss * max(0.0, half) ** 14
        return cover, mix(colour, (255, 250, 236), clamp(shine))
    lay(canvas, (x - reach, y - reach, x + reach, y + reach), at)


# ---- Fruit on a table

def fruit():
    edge = 372  # of the table

    def room(x, y):
        if y < edge:
            wall = ramp([(0, (58, 92, 104)), (0.55, (116, 146, 140)), (1, (196, 186, 150))],
                        0.55 * x / WIDTH + 0.5 * y / edge)
            return mix(wall, (34, 52, 66), 0.55 * smooth((x - 520) / 520))
        return mix((204, 142, 84), (112, 62, 44), smooth(0.75 * (y - edge) / (HEIGHT - edge) + 0.35 * x / WIDTH - 0.2))

    canvas = blank(room)
    # A cloth that hangs over the table's front.
    polygon(canvas, [(60, 470), (240, 400), (690, 392), (850, 452), (800, 600), (120, 600)],
            lambda x, y: mix((238, 228, 208), (150, 150, 172),
                             smooth(0.5 + 0.5 * math.sin(x / 43 + (y - 430) / 120)) * smooth((y - 420) / 120) * 0.8
                             + 0.12 * smooth((x - 400) / 400)))
    for x, y, rx, ry in ((470, 505, 260, 52), (250, 515, 130, 36), (690, 505, 120, 34), (420, 552, 120, 26)):
        glow(canvas, x, y, rx, ry, (58, 40, 52), 0.75)
    bottle(canvas)
    leaf = lambda u, v: mix((70, 110, 46), (132, 160, 70), 0.5 + 0.5 * u)
    # Behind: a pear, a melon
    ball(canvas, 560, 356, 150, 138, lambda u, v: mix((78, 122, 66), (170, 190, 104),
         smooth(0.5 + 0.5 * math.sin(9 * math.asin(clamp(u, -1, 1)) + 0.7 * v))), turn=-8, gloss=0.25)
    ball(canvas, 322, 388, 84, 122, pear, turn=4, gloss=0.4, taper=0.62)
    polygon(canvas, [(320, 270), (331, 232), (338, 234), (329, 272)], lambda x, y: (76, 52, 36))
    # In front: apple, orange, lemon, plum, grapes
    ball(canvas, 214, 462, 78, 72, apple, turn=-10)
    polygon(canvas, [(206, 396), (214, 362), (221, 364), (213, 398)], lambda x, y: (66, 44, 32))
    ball(canvas, 252, 372, 40, 13, leaf, turn=-24, gloss=0.2)
    ball(canvas, 446, 470, 80, 78, lambda u, v: mix((226, 122, 30), (250, 168, 52), 0.5 - 0.5 * v), gloss=0.4)
    ball(canvas, 352, 528, 78, 46, lambda u, v: mix((224, 178, 34), (252, 222, 84), 0.5 - 0.5 * v), turn=-16, gloss=0.35)
    ball(canvas, 538, 532, 48, 45, lambda u, v: mix((72, 44, 104), (128, 74, 138), 0.5 - 0.5 * v), gloss=0.55)
    for gx, gy in ((640, 420), (684, 408), (730, 424), (618, 458), (662, 452), (706, 450), (750, 462), (634, 494),
                   (680, 490), (724, 494), (764, 498), (656, 526), (702, 528), (744, 530)):
        ball(canvas, gx, gy, 27, 27, lambda u, v: mix((106, 26, 58), (176, 62, 92), 0.5 - 0.4 * v + 0.2 * u), gloss=0.7)
    polygon(canvas, [(676, 392), (690, 346), (722, 322), (726, 328), (698, 352), (684, 394)], lambda x, y: (92, 74, 44))
    ball(canvas, 640, 372, 50, 22, leaf, turn=22, gloss=0.2)
    return canvas


def apple(u, v):
    streak = 0.5 + 0.5 * math.sin(13 * math.atan2(u, 1.35 + v))
    return mix(mix((190, 30, 34), (222, 74, 48), streak), (232, 190, 84), smooth(0.9 * (-v - 0.25)) * 0.8)


def pear(u, v):
    return mix(mix((150, 158, 54), (206, 190, 86), 0.5 - 0.5 * u), (196, 110, 60), 0.45 * smooth(u + 0.2))


def bottle(canvas):
    """Of green glass, behind everything."""
    def half(y):
        if y < 176:
            return 21 if y > 72 else 25
        return 21 + 47 * smooth((y - 176) / 76)

    def at(x, y):
        w = half(y)
        u = (x - 790) / w
        cover = clamp(0.5 + (1 - abs(u)) * w) * clamp(y - 56) * clamp(430 - y)
        if cover == 0:
            return None
        u = clamp(u, -1, 1)
        glass = mix((22, 56, 44), (74, 128, 84), smooth(1 - abs(u + 0.1)))
        shine = 0.75 * math.exp(-((u + 0.55) / 0.1) ** 2) + 0.25 * math.exp(-((u - 0.7) / 0.12) ** 2)
        if 292 < y < 386:
            glass = mix((214, 198, 160), (150, 124, 92), smooth(0.5 + 0.5 * u))
            shine *= 0.3
        return cover, mix(glass, (232, 240, 226), clamp(shine))
    lay(canvas, (720, 50, 860, 432), at)
    glow(canvas, 800, 432, 110, 22, (58, 40, 42), 0.6)


# ---- A coast in the evening

def coast():
    horizon, sun_x, sun_y = 322, 612, 250

    def sky(x, y):
        colour = ramp([(0, (44, 74, 128)), (0.38, (112, 130, 172)), (0.68, (222, 158, 140)), (0.9, (250, 200, 130)),
                       (1, (254, 222, 160))], y / horizon)
        away = math.hypot(x - sun_x, 1.25 * (y - sun_y))
        cloud = smooth(1.5 * math.sin(x / 118 + 2.2 * math.sin(y / 39)) + 1.3 * math.sin(y / 25 - x / 260) - 0.9)
        colour = mix(colour, (246, 176, 150), 0.6 * cloud * smooth((y - 20) / 90) * smooth((horizon - 60 - y) / 70))
        return mix((255, 240, 196), colour, smooth((away - 34) / 150) ** 0.55)

    def sea(x, y):
        depth = (y - horizon) / (HEIGHT - horizon)
        colour = ramp([(0, (238, 184, 142)), (0.16, (148, 146, 164)), (0.5, (58, 104, 136)), (1, (20, 52, 86))], depth)
        wave = math.sin((y - horizon) ** 0.62 * 5.2 + 0.9 * math.sin(x / (30 + 150 * depth)))
        colour = mix(colour, mix((246, 214, 170), (116, 160, 176), depth), 0.22 * smooth(wave))
        path = math.exp(-((x - sun_x) / (22 + 120 * depth)) ** 2) * smooth(0.55 + 0.75 * wave)
        return mix(colour, (255, 224, 160), 0.85 * path * (1 - 0.55 * depth))

    canvas = blank(lambda x, y: sky(x, y) if y < horizon else sea(x, y))
    ball(canvas, sun_x, sun_y, 35, 35, lambda u, v: (255, 246, 214), gloss=0)
    lay(canvas, (sun_x - 38, sun_y - 38, sun_x + 38, sun_y + 38),
        lambda x, y: (clamp(35.5 - math.hypot(x - sun_x, y - sun_y)), (255, 244, 206)))
    ridge(canvas, horizon, lambda x: 96 * smooth(1 - x / 520) * (1 + 0.16 * math.sin(x / 31) + 0.1 * math.sin(x / 13)),
          (132, 112, 142), (196, 146, 146))
    ridge(canvas, horizon + 26, lambda x: 176 * smooth(1 - x / 330) * (1 + 0.10 * math.sin(x / 23 + 1)) +
          0.1 * x * smooth(1 - x / 330), (64, 66, 96), (128, 98, 112))
    ridge(canvas, horizon + 8, lambda x: 66 * smooth((x - 700) / 200) * (1 + 0.12 * math.sin(x / 17)),
          (96, 88, 120), (168, 124, 130))
    boat(canvas, 470, 452, 1.0)
    boat(canvas, 734, 372, 0.42)
    # The slope in front, with cypresses.
    slope = lambda x: 170 * smooth(1 - x / 560) + 20 * math.sin(x / 60) * smooth(1 - x / 560)
    ridge(canvas, HEIGHT, slope, (44, 74, 46), (132, 132, 62))
    for x, tall in ((64, 210), (132, 168), (196, 190), (262, 118)):
        foot = HEIGHT - slope(x) + 26
        ball(canvas, x, foot - tall / 2, 0.13 * tall + 8, tall / 2 + 6,
             lambda u, v: mix((40, 74, 52), (104, 128, 60), 0.5 + 0.5 * math.sin(7 * v + 5 * u)), gloss=0, taper=0.75)
    return canvas


def ridge(canvas, foot, height, dark, light):
    """Land up to height(x) above its foot, lighter towards its top."""
    def at(x, y):
        up = height(x)
        cover = clamp(y - (foot - up) + 0.5) * clamp(foot - y + 0.5)
        if cover == 0 or up < 0.5:
            return None
        fold = 0.5 + 0.5 * math.sin(x / 21 + 2 * math.sin(y / 33))
        return cover, mix(light, dark, clamp(smooth((y - foot + up) / (0.8 * up + 8)) + 0.25 * fold))
    lay(canvas, (0, foot - 260, WIDTH, foot + 1), at)


def boat(canvas, x, y, size):
    p = lambda dx, dy: (x + size * dx, y + size * dy)
    glow(canvas, x, y + 22 * size, 90 * size, 16 * size, (24, 44, 70), 0.7)
    polygon(canvas, [p(-62, 0), p(66, 0), p(44, 22), p(-44, 22)],
            lambda px, py: mix((150, 62, 48), (70, 30, 40), smooth((py - y) / (22 * size))))
    polygon(canvas, [p(-1, 0), p(-1, -172), p(3, -172), p(3, 0)], lambda px, py: (78, 54, 44))
    polygon(canvas, [p(6, -168), p(64, -12), p(6, -12)],
            lambda px, py: mix((252, 240, 216), (214, 168, 150), smooth((px - x) / (64 * size))))
    polygon(canvas, [p(-4, -150), p(-4, -12), p(-50, -12)],
            lambda px, py: mix((206, 150, 128), (246, 214, 178), smooth((px - x + 50 * size) / (50 * size))))


# ---- Pebbles on dark sand

STONES = (  # colours of a river's bed, and how often each comes
    ((152, 148, 140), 4), ((118, 120, 122), 4), ((184, 164, 134), 3), ((204, 198, 186), 2), ((160, 122, 88), 2),
    ((142, 104, 90), 2), ((96, 102, 108), 3), ((124, 130, 114), 2), ((174, 178, 180), 2))
LARGEST, SMALLEST = 66, 9  # semi-axis, px
THROWS = 24000
COARSE = 4  # to this many levels of grey a colour is rounded: what a photo's noise hides, and PNG takes for less


def pebbles():
    chance = random.Random(7)
    canvas = blank(sand)
    for stone in bed(chance):
        shade_below(canvas, stone)
        lay_stone(canvas, stone)
    return [[tuple(COARSE * round(v / COARSE) for v in pixel) for pixel in row] for row in canvas]


def sand(x, y):
    tone = 0.55 * noise(x / 2.2, y / 2.2, 1) + 0.45 * noise(x / 26, y / 26, 2)
    return mix((14, 12, 11), (46, 39, 33), tone ** 1.5)


class Stone:
    """A rounded outline and what it is made of."""

    def __init__(self, chance, number, x, y, size):
        self.x, self.y, self.number = x, y, number
        self.rx, self.ry = size, size * chance.uniform(0.64, 0.95)
        self.turn = chance.uniform(0, math.pi)
        self.waves = [(k, chance.gauss(0, most), chance.uniform(0, 2 * math.pi))
                      for k, most in ((2, 0.03), (3, 0.035), (4, 0.022), (5, 0.012))]
        self.colour = chance.choices([c for c, _ in STONES], [often for _, often in STONES])[0]
        tone = chance.uniform(0.8, 1.18)
        self.colour = tuple(clamp(v * tone * chance.uniform(0.95, 1.05), 0, 255) for v in self.colour)
        self.dome = chance.uniform(0.75, 1.2)
        self.speckle = chance.choice((0.12, 0.18, 0.3))
        self.vein = chance.uniform(0, math.pi) if chance.random() < 0.16 else None

    def at(self, px, py):
        """How far out a place is, 1 on the outline, and the direction outwards."""
        dx, dy = px - self.x, py - self.y
        c, s = math.cos(self.turn), math.sin(self.turn)
        u, v = (c * dx + s * dy) / self.rx, (c * dy - s * dx) / self.ry
        angle = math.atan2(v, u)
        edge = 1 + sum(a * math.cos(k * angle + phase) for k, a, phase in self.waves)
        gx, gy = c * u / self.rx - s * v / self.ry, s * u / self.rx + c * v / self.ry
        length = math.hypot(gx, gy) or 1
        return math.hypot(u, v) / edge, gx / length, gy / length


def bed(chance):
    """Stones from large to small, each where there is room; the small ones lie lowest."""
    laid = []
    for step in range(THROWS):
        size = SMALLEST + (LARGEST - SMALLEST) * (1 - step / THROWS) ** 5 * chance.uniform(0.55, 1)
        x, y = chance.uniform(-30, WIDTH + 30), chance.uniform(-30, HEIGHT + 30)
        stone = Stone(chance, len(laid), x, y, size)
        if all(apart(stone, other) for other in laid):
            laid.append(stone)
    return laid[::-1]


def apart(a, b):
    """Whether they overlap little at most, along the line of their centres."""
    distance = math.hypot(a.x - b.x, a.y - b.y)
    if distance > a.rx + b.rx:
        return True
    return distance > 0 and 1 / a.at(b.x, b.y)[0] + 1 / b.at(a.x, a.y)[0] < 1.06


def shade_below(canvas, stone):
    """The shadow that it throws to the right and below, softer farther out."""
    drop = 0.10 * stone.ry + 1.5

    def at(px, py):
        out = (stone.at(px - drop, py - drop)[0] - 1) * stone.ry
        return (0.72 * smooth(1 - out / (0.16 * stone.ry + 4)), (8, 7, 8)) if out < 0.16 * stone.ry + 4 else None
    lay(canvas, around(stone, 1.4), at)


def lay_stone(canvas, stone):
    tint = stone.number * 7.31

    def at(px, py):
        out, ox, oy = stone.at(px, py)
        cover = clamp(0.5 + (1 - out) * stone.ry)
        if cover == 0:
            return None
        slope = stone.dome * out ** 2.2 / math.sqrt(max(0.04, 1.04 - out * out))
        nx, ny, nz = (v / math.hypot(slope, 1) for v in (slope * ox, slope * oy, 1))
        facing = nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]
        lit = (0.46 + 0.8 * max(0.0, facing)) * (1 - 0.45 * out ** 7)
        grain = noise(px / 1.5, py / 1.5, tint) - 0.5 + 0.9 * (noise(px / 5, py / 5, tint + 1) - 0.5)
        cloud = noise(px / 30 + tint, py / 30, tint + 2) - 0.5
        skin = tuple(v * (1 + stone.speckle * grain + 0.3 * cloud) for v in stone.colour)
        if stone.vein is not None:
            across = ((px - stone.x) * math.cos(stone.vein) + (py - stone.y) * math.sin(stone.vein)
                      + 5 * noise(px / 17, py / 17, tint + 3)) / stone.ry
            skin = mix(skin, (226, 220, 208), 0.55 * smooth(1 - abs(across + 0.15) / 0.07))
        return cover, tuple(clamp(v * lit, 0, 255) for v in skin)
    lay(canvas, around(stone, 1.12), at)


def around(stone, times):
    reach = times * stone.rx + 6
    return stone.x - reach, stone.y - reach, stone.x + reach, stone.y + reach


def noise(x, y, kind):
    """Between 0 and 1, smooth, the same at the same place."""
    i, j = math.floor(x), math.floor(y)
    u, v = smooth(x - i), smooth(y - j)
    top = dice(i, j, kind) * (1 - u) + dice(i + 1, j, kind) * u
    return top * (1 - v) + (dice(i, j + 1, kind) * (1 - u) + dice(i + 1, j + 1, kind) * u) * v


def dice(i, j, kind):
    n = (i * 374761393 + j * 668265263 + int(kind * 1000) * 2147483647) & 0xffffffff
    n = ((n ^ (n >> 13)) * 1274126177) & 0xffffffff
    return ((n ^ (n >> 16)) & 0xffff) / 0xffff


# ---- PNG

def png(canvas):
    width, height = len(canvas[0]), len(canvas)
    lines, above = bytearray(), bytes(3 * width)
    for pixels in canvas:
        row = bytes(round(clamp(v, 0, 255)) for pixel in pixels for v in pixel)
        lines += min((filtered(kind, row, above) for kind in range(5)),
                     key=lambda line: sum(min(v, 256 - v) for v in line[1:]))
        above = row
    header = struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)
    chunks = [(b'IHDR', header), (b'IDAT', zlib.compress(bytes(lines), 9)), (b'IEND', b'')]
    return b'\x89PNG\r\n\x1a\n' + b''.join(struct.pack('>I', len(data)) + kind + data +
                                           struct.pack('>I', zlib.crc32(kind + data)) for kind, data in chunks)


def filtered(kind, row, above):
    left, corner = bytes(3) + row[:-3], bytes(3) + above[:-3]
    if kind == 4:
        guesses = (paeth(a, b, c) for a, b, c in zip(left, above, corner))
    else:
        guesses = ((0, a, b, (a + b) // 2)[kind] for a, b in zip(left, above))
    return bytes([kind]) + bytes((v - g) & 255 for v, g in zip(row, guesses))


def paeth(a, b, c):
    pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


if __name__ == '__main__':
    main()
