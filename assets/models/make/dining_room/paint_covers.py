"""Covers of books that nobody has written: back, spine and front side by side on one picture a book."""

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from noise import cloud, save

# Title, author, width, height and thickness in millimetres, ground, ink, accent, kind of drawing.
BOOKS = [
    ("The Salt Garden", "I. Merrow", 150, 225, 34, (28, 62, 88), (236, 224, 196), (208, 140, 70), "waves"),
    ("Night Trains", "O. Vale", 140, 210, 30, (22, 24, 40), (244, 214, 120), (190, 60, 50), "moon"),
    ("A Field Guide to Clouds", "T. Arkwell", 190, 250, 28, (148, 184, 206), (250, 250, 244), (50, 80, 110), "clouds"),
    ("Orchard", "L. Finch", 160, 230, 40, (196, 72, 48), (250, 234, 200), (80, 110, 54), "tree"),
    ("Bread & Smoke", "P. Hollis", 200, 265, 36, (226, 214, 190), (60, 40, 30), (186, 96, 40), "loaf"),
    ("Seven Bridges", "N. Quill", 140, 215, 32, (176, 142, 60), (34, 30, 28), (240, 230, 200), "arches"),
    ("Lichen", "E. Brandt", 170, 240, 24, (90, 112, 84), (232, 232, 208), (204, 190, 92), "rings"),
    ("The Clockmaker's Loft", "H. Dunmore", 150, 225, 44, (94, 30, 40), (230, 196, 120), (240, 226, 190), "dial"),
    ("Small Harbours", "R. Osei", 210, 240, 26, (232, 226, 212), (36, 70, 104), (200, 66, 48), "boats"),
    ("Geometry of Rooms", "K. Lindqvist", 220, 270, 38, (240, 238, 230), (30, 30, 34), (220, 80, 44), "squares"),
    ("Ember Road", "S. Tamsin", 140, 210, 38, (40, 34, 36), (238, 122, 44), (246, 210, 130), "road"),
    ("Tall Grass", "A. Wren", 145, 220, 28, (206, 186, 92), (50, 60, 34), (96, 118, 52), "grass"),
    ("The Fox at Eleven", "M. Carrow", 150, 215, 30, (34, 84, 78), (246, 236, 214), (216, 108, 44), "fox"),
    ("Winter Kitchens", "D. Alder", 200, 255, 42, (66, 86, 120), (242, 240, 232), (206, 170, 96), "snow"),
    ("Paper Moons", "J. Ito", 150, 225, 26, (214, 160, 150), (70, 36, 52), (250, 240, 224), "phases"),
    ("On Foot", "C. Rhodes", 130, 200, 24, (108, 132, 150), (250, 244, 220), (240, 190, 70), "hills"),
    ("The Glass Bell", "V. Sorrel", 150, 230, 36, (72, 50, 92), (226, 212, 236), (230, 180, 90), "rays"),
    ("Atlas of Rivers", "B. Okafor", 230, 290, 40, (30, 74, 70), (234, 220, 180), (120, 180, 176), "rivers"),
    ("Marzipan", "G. Lutz", 145, 215, 22, (238, 190, 96), (120, 40, 36), (250, 240, 214), "dots"),
    ("Stone, Paper, Rain", "Y. Marsh", 150, 225, 32, (120, 122, 124), (246, 244, 240), (44, 60, 84), "rain"),
]


def front(draw, kind, x, y, w, h, ink, accent):
    """The drawing of a cover, in the rectangle from (x, y)."""
    at = lambda u, v: (x + u * w, y + v * h)
    disk = lambda u, v, r, **how: draw.ellipse((x + u * w - r * w, y + v * h - r * w, x + u * w + r * w, y + v * h + r * w), **how)
    random = np.random.default_rng(len(kind) * 7 + ord(kind[0]))
    if kind in ("waves", "rivers", "hills", "road"):
        for k in range(7):
            line = [at(u, 0.5 + 0.07 * k + 0.04 * np.sin(9 * u + k * (1.3 if kind != "rivers" else 0.4))) for u in np.linspace(0, 1, 40)]
            draw.line(line, fill=accent if k % 2 else ink, width=max(2, int(0.014 * w * (1 + (kind == "rivers") * k / 3))))
        disk(0.68, 0.36, 0.13, fill=accent)
        if kind == "road":
            draw.polygon([at(0.46, 0.52), at(0.54, 0.52), at(0.85, 1), at(0.15, 1)], fill=ink)
    elif kind in ("moon", "phases", "dial", "rings", "rays"):
        disk(0.5, 0.58, 0.3, fill=accent)
        if kind == "moon":
            disk(0.6, 0.53, 0.26, fill=ink)
        for k in range(12):
            a = 2 * np.pi * k / 12
            u, v, r = np.cos(a), np.sin(a), w / h
            if kind in ("dial", "rays"):
                draw.line([at(0.5 + 0.32 * u, 0.58 + 0.32 * v * r), at(0.5 + 0.42 * u, 0.58 + 0.42 * v * r)], fill=ink, width=int(0.02 * w))
            if kind == "phases":
                disk(0.5 + 0.38 * u, 0.58 + 0.38 * v * r, 0.02 + 0.004 * k, fill=ink)
            if kind == "rings" and k < 5:
                disk(0.5, 0.58, 0.27 - 0.05 * k, outline=ink, width=int(0.018 * w))
        if kind == "dial":
            draw.line([at(0.5, 0.42), at(0.5, 0.58), at(0.62, 0.63)], fill=ink, width=int(0.03 * w))
    elif kind in ("arches", "boats", "squares", "fox", "loaf"):
        for k in range(4):
            u = 0.06 + 0.23 * k
            if kind == "arches":
                draw.rectangle((*at(u, 0.5), *at(u + 0.21, 0.8)), fill=accent)
                draw.pieslice((*at(u + 0.03, 0.55), *at(u + 0.18, 0.85)), 180, 360, fill=ink)
                draw.rectangle((*at(u + 0.03, 0.7), *at(u + 0.18, 0.81)), fill=ink)
            elif kind == "boats":
                v = 0.46 + 0.12 * (k % 3)
                draw.polygon([at(u, v), at(u + 0.2, v), at(u + 0.15, v + 0.05), at(u + 0.05, v + 0.05)], fill=ink)
                draw.polygon([at(u + 0.1, v - 0.12), at(u + 0.1, v - 0.01), at(u + 0.19, v - 0.01)], fill=accent)
            elif kind == "squares":
                draw.rectangle((*at(0.14 + 0.08 * k, 0.42 + 0.06 * k), *at(0.86 - 0.08 * k, 0.9 - 0.06 * k)), outline=accent if k % 2 else ink, width=int(0.03 * w))
        if kind == "fox":
            draw.polygon([at(0.2, 0.44), at(0.36, 0.52), at(0.64, 0.52), at(0.8, 0.44), at(0.74, 0.66), at(0.5, 0.86), at(0.26, 0.66)], fill=accent)
            draw.polygon([at(0.5, 0.86), at(0.3, 0.68), at(0.5, 0.7), at(0.7, 0.68)], fill=ink)
            disk(0.38, 0.62, 0.025, fill=(30, 24, 24)), disk(0.62, 0.62, 0.025, fill=(30, 24, 24))
        if kind == "loaf":
            draw.ellipse((*at(0.12, 0.5), *at(0.88, 0.8)), fill=accent)
            for u in (0.3, 0.45, 0.6):
                draw.line([at(u, 0.72), at(u + 0.12, 0.57)], fill=ink, width=int(0.03 * w))
    else:
        for k in range(46):
            u, v = random.random(), 0.42 + 0.52 * random.random()
            if kind in ("clouds",):
                disk(u, v, 0.03 + 0.06 * random.random(), fill=ink)
            elif kind in ("snow", "dots"):
                disk(u, v, 0.012 + 0.03 * random.random(), fill=ink if k % 3 else accent)
            elif kind == "rain":
                draw.line([at(u, v), at(u - 0.05, v + 0.09)], fill=ink if k % 3 else accent, width=int(0.012 * w))
            elif kind == "grass":
                draw.line([at(u, 1), at(u + 0.06 * (v - 0.7), 0.42 + 0.5 * random.random())], fill=accent if k % 3 else ink, width=int(0.018 * w))
            elif kind == "tree":
                a = 2 * np.pi * random.random()
                r = 0.3 * random.random() ** 0.5
                disk(0.5 + r * np.cos(a), 0.56 + 0.7 * r * np.sin(a), 0.035, fill=accent if k % 4 else ink)
        if kind == "tree":
            draw.line([at(0.5, 0.6), at(0.5, 0.92)], fill=ink, width=int(0.04 * w))


def words(picture, text, box, ink, size):
    """Text in the middle of a box, made smaller until it fits, broken into lines of whole words."""
    draw = ImageDraw.Draw(picture)
    x, y, w, h = box
    while size > 8:
        font = ImageFont.load_default(size)
        lines = [""]
        for word in text.split():
            longer = (lines[-1] + " " + word).strip()
            if draw.textlength(longer, font) > w and lines[-1]:
                lines.append(word)
            else:
                lines[-1] = longer
        if max(draw.textlength(line, font) for line in lines) <= w and len(lines) * size * 1.15 <= h:
            break
        size -= 1
    for k, line in enumerate(lines):
        at = (x + w / 2, y + h / 2 + (k - (len(lines) - 1) / 2) * size * 1.12)
        draw.text(at, line, fill=ink, font=font, anchor="mm", stroke_width=max(1, size // 22), stroke_fill=ink)


def cover(folder, index, scale=2.6):
    title, author, width, height, thick, ground, ink, accent, kind = BOOKS[index]
    w, h, t = (int(scale * n) for n in (width, height, thick))
    picture = Image.new("RGB", (2 * w + t, h), ground)
    draw = ImageDraw.Draw(picture)
    canvas = Image.new("RGB", (w, h), ground)
    front(ImageDraw.Draw(canvas), kind, 0, 0, w, h, ink, accent)
    picture.paste(canvas, (w + t, 0))
    words(picture, title, (w + t + 0.08 * w, 0.06 * h, 0.84 * w, 0.26 * h), ink, int(0.15 * w))
    words(picture, author, (w + t + 0.1 * w, 0.3 * h, 0.8 * w, 0.07 * h), ink, int(0.07 * w))
    for k in range(6):
        draw.line([(0.15 * w, (0.2 + 0.035 * k) * h), ((0.85 - 0.1 * (k == 5) * 3) * w, (0.2 + 0.035 * k) * h)], fill=ink, width=2)
    spine = Image.new("RGB", (h, t), ground)
    line = ImageDraw.Draw(spine)
    for u in (0.05, 0.075, 0.94):
        line.rectangle((u * h, 0, u * h + 0.012 * h, t), fill=accent)
    words(spine, title, (0.11 * h, 0, 0.56 * h, t), ink, int(0.62 * t))
    words(spine, author, (0.7 * h, 0, 0.22 * h, t), ink, int(0.36 * t))
    picture.paste(spine.rotate(-90, expand=True), (w, 0))
    array = np.asarray(picture, float)
    worn = 0.93 + 0.14 * cloud(*array.shape[:2], 9, 9, index, 4)
    joint = np.ones(array.shape[1])
    for edge in (w, w + t):
        joint[edge - 3 : edge + 3] = 0.8
    save(folder, "book_%02d.jpg" % (index + 1), array * (worn * joint)[..., None], 76)


def paint(folder):
    for index in range(len(BOOKS)):
        cover(folder, index)
