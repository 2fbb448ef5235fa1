"""Leaves on cards: the colour of one, and beside it what of the card is there. The stalk is below, the tip above."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from noise import cloud, save, scale


def leaf(folder, name, shape, veins, colours, width=256, height=384, seed=1):
    """`shape` draws the leaf in white and the gaps in black, `veins` draws lines; both in units of the card."""
    mask = Image.new("L", (width * 3, height * 3), 0)
    shape(Pen(mask))
    lines = Image.new("L", mask.size, 0)
    veins(Pen(lines))
    mask = mask.resize((width, height), Image.LANCZOS)
    line = np.asarray(lines.resize((width, height), Image.LANCZOS), float)[..., None] / 255
    depth = np.asarray(mask.filter(ImageFilter.GaussianBlur(16)), float) / 255
    tone = 0.55 * cloud(height, width, 7, 5, seed, 4) + 0.45 * depth
    colour = scale(tone, colours) * (1 - 0.45 * line) + np.array((170, 190, 110.0)) * 0.45 * line
    save(folder, name + ".jpg", colour, 82)
    save(folder, name + "_mask.png", mask)


class Pen:
    """Draws in units of the card: x and y from 0 to 1, y upwards."""

    def __init__(self, picture):
        self.draw, (self.w, self.h) = ImageDraw.Draw(picture), picture.size

    def at(self, points):
        return [(x * self.w, (1 - y) * self.h) for x, y in points]

    def area(self, points, fill=255):
        self.draw.polygon(self.at(points), fill=fill)

    def line(self, points, width, fill=255):
        self.draw.line(self.at(points), fill=fill, width=round(width * self.w), joint="curve")

    def hole(self, x, y, rx, ry):
        self.draw.ellipse(((x - rx) * self.w, (1 - y - ry) * self.h, (x + rx) * self.w, (1 - y + ry) * self.h), fill=0)


def heart(t):
    """Half the breadth of a broad leaf at height t, 0 to 1."""
    return 0.47 * np.sin(np.pi * np.clip(0.16 + 0.84 * t, 0, 1)) ** 0.72 * (1 - 0.18 * t)


def monstera(folder):
    def shape(pen):
        t = np.linspace(0.0, 1, 60)
        pen.area([(0.5 + heart(a), 0.05 + 0.93 * a) for a in t] + [(0.5 - heart(a), 0.05 + 0.93 * a) for a in t[::-1]])
        pen.area([(0.5, 0.17), (0.56, 0.0), (0.44, 0.0)], 0)
        for side in (-1, 1):
            for a in (0.26, 0.38, 0.5, 0.62, 0.73):
                deep, y = 0.5 + side * (0.13 + 0.1 * a), 0.05 + 0.93 * a
                edge = 0.5 + side * 0.6
                pen.area([(deep, y), (edge, y + 0.115), (edge, y + 0.03)], 0)
                pen.hole(deep, y + 0.008, 0.03, 0.014)
            for a in (0.33, 0.46, 0.58):
                pen.hole(0.5 + side * 0.1, 0.05 + 0.93 * a, 0.022, 0.02)
        pen.line([(0.5, 0), (0.5, 0.2)], 0.03)

    def veins(pen):
        pen.line([(0.5, 0), (0.5, 0.97)], 0.018)
        for side in (-1, 1):
            for a in (0.2, 0.32, 0.44, 0.56, 0.68, 0.78):
                pen.line([(0.5, 0.93 * a), (0.5 + side * 0.4, 0.93 * a + 0.15)], 0.009)

    leaf(folder, "monstera", shape, veins, [(14, 44, 20), (26, 72, 30), (44, 100, 42), (66, 124, 54)], seed=3)


def ficus(folder):
    def half(t):
        return 0.44 * np.sin(np.pi * t**0.8) ** 0.8 * (1 - 0.25 * t)

    def shape(pen):
        t = np.linspace(0, 1, 50)
        pen.area([(0.5 + half(a), 0.1 + 0.88 * a) for a in t] + [(0.5 - half(a), 0.1 + 0.88 * a) for a in t[::-1]])
        pen.line([(0.5, 0), (0.5, 0.2)], 0.035)

    def veins(pen):
        pen.line([(0.5, 0), (0.5, 0.96)], 0.025)
        for side in (-1, 1):
            for a in np.linspace(0.15, 0.85, 9):
                pen.line([(0.5, 0.88 * a + 0.04), (0.5 + side * 0.36, 0.88 * a + 0.13)], 0.008)

    leaf(folder, "ficus", shape, veins, [(34, 66, 22), (62, 104, 36), (92, 136, 50), (126, 160, 70)], 192, 320, seed=5)


def fern(folder):
    def shape(pen):
        for k in range(26):
            t = k / 25
            y = 0.06 + 0.88 * t
            reach = 0.47 * np.sin(np.pi * (0.14 + 0.84 * t)) ** 0.9
            for side in (-1, 1):
                tip = (0.5 + side * reach, y + 0.05)
                pen.area([(0.5, y - 0.011), (0.5 + side * reach * 0.5, y + 0.006), tip, (0.5 + side * reach * 0.45, y + 0.036), (0.5, y + 0.014)])
        pen.line([(0.5, 0), (0.5, 0.98)], 0.02)

    def veins(pen):
        pen.line([(0.5, 0), (0.5, 0.97)], 0.016)

    leaf(folder, "fern", shape, veins, [(52, 84, 34), (84, 122, 50), (116, 152, 66), (140, 172, 84)], 192, 512, seed=7)


def eucalyptus(folder):
    def shape(pen):
        pen.draw.ellipse((0.1 * pen.w, 0.05 * pen.h, 0.9 * pen.w, 0.85 * pen.h), fill=255)
        pen.line([(0.5, 0), (0.5, 0.2)], 0.06)

    def veins(pen):
        pen.line([(0.5, 0), (0.5, 0.9)], 0.03)
        for side in (-1, 1):
            for a in (0.3, 0.45, 0.6):
                pen.line([(0.5, a), (0.5 + side * 0.3, a + 0.14)], 0.012)

    leaf(folder, "eucalyptus", shape, veins, [(84, 112, 96), (112, 140, 120), (140, 164, 142), (164, 184, 160)], 96, 112, seed=9)


def hedge(folder, size=320, count=2600):
    """Leaves over leaves, darker below; it repeats at its edges."""
    random = np.random.default_rng(77)
    picture = Image.new("RGB", (size, size), (14, 24, 10))
    draw = ImageDraw.Draw(picture)
    for k in range(count):
        light = 0.25 + 0.75 * k / count * random.uniform(0.6, 1)
        fill = tuple(int(c * light) for c in (96 + random.integers(-24, 24), 132 + random.integers(-16, 16), 58))
        x, y, a, r = random.uniform(0, size), random.uniform(0, size), random.uniform(0, 2 * np.pi), random.uniform(5, 9)
        for dx in (-size, 0, size):
            for dy in (-size, 0, size):
                tips = [(x + dx + r * s * np.cos(a + t), y + dy + r * s * np.sin(a + t)) for s, t in ((1, 0), (0.45, 1.4), (1, np.pi), (0.45, -1.4))]
                draw.polygon(tips, fill=fill)
    save(folder, "hedge.jpg", picture, 72)


def paint(folder):
    for part in (monstera, ficus, fern, eucalyptus, hedge):
        part(folder)
