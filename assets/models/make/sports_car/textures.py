"""The textures: all are drawn here, from seeded noise. Colours are those of bytes (sRGB)."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter, ImageFont

from noise import image, lattice, save


def noise(size, octaves, seed, stretch=(1, 1)):
    """Smooth noise that repeats, 0 to 1: `octaves` of (cells across, weight)."""
    rng = np.random.default_rng(seed)
    out = sum(weight * lattice(size, size, int(cells * stretch[1]), int(cells * stretch[0]), rng) for cells, weight in octaves)
    return out / sum(weight for _, weight in octaves)


def tinted(value, low, high):
    return value[..., None] * (np.array(high) - np.array(low)) + np.array(low)


def dots(size, count, seed, radii, values):
    """Round grains, one over another, that repeat."""
    rng = np.random.default_rng(seed)
    picture = Image.new("L", (size, size), 110)
    draw = ImageDraw.Draw(picture)
    for _ in range(count):
        x, y, r, v = rng.random() * size, rng.random() * size, rng.uniform(*radii), int(rng.uniform(*values))
        for dx in (-size, 0, size):
            for dy in (-size, 0, size):
                if -r < x + dx < size + r and -r < y + dy < size + r:
                    draw.ellipse((x + dx - r, y + dy - r * .8, x + dx + r, y + dy + r * .8), fill=v)
    return np.asarray(picture.filter(ImageFilter.GaussianBlur(.6)), float)


def cracks(size, seed):
    """A few thin wandering lines, 0 to 1."""
    rng = np.random.default_rng(seed)
    picture = Image.new("L", (size, size), 0)
    draw = ImageDraw.Draw(picture)
    for _ in range(4):
        x, y, a = rng.random() * size, rng.random() * size, rng.random() * 6.28
        for _ in range(int(rng.uniform(40, 110))):
            a += rng.normal(0, .45)
            u, v = x + 7 * np.cos(a), y + 7 * np.sin(a)
            for dx in (-size, 0, size):
                for dy in (-size, 0, size):
                    draw.line((x + dx, y + dy, u + dx, v + dy), fill=int(rng.uniform(150, 255)), width=1 + int(rng.random() < .3))
            x, y = u % size, v % size
    return np.asarray(picture.filter(ImageFilter.GaussianBlur(.7)), float) / 255


def asphalt(folder):
    size = 1024
    grain = dots(size, 60000, 1, (1.0, 2.9), (70, 165))
    patch = noise(size, ((3, 1), (7, .6), (17, .4)), 2)
    crack = cracks(size, 3)
    fine = noise(size, ((256, 1), (512, 1)), 4)
    value = 104 + (grain - 110) * .40 + (patch - .5) * 26 + (fine - .5) * 22 - crack * 55
    save(folder, "asphalt.jpg", value[..., None] * (1, .985, .96) + (3, 3, 4), 84)
    height = 120 + (grain - 110) * 1.3 + (fine - .5) * 40 - crack * 110
    save(folder, "asphalt-bump.jpg", height, 80)
    worn = np.clip((noise(512, ((24, 1), (60, 1), (128, 1)), 5) - .36) * 7, 0, 1)
    grain = grain[:512, :512]
    save(folder, "marking.jpg", tinted(worn, (92, 90, 88), (226, 225, 218)) + (grain[..., None] - 110) * .12, 82)


def concrete(folder):
    base = noise(512, ((4, 1), (9, .8), (30, .5), (120, .6)), 10)
    pits = dots(512, 500, 11, (.6, 2.2), (40, 90))
    value = base + np.minimum(pits - 108, 0) / 400
    save(folder, "concrete.jpg", tinted(value, (128, 124, 116), (205, 201, 192)), 82)
    base = noise(512, ((3, 1), (8, 1), (25, .8), (80, .7), (200, .5)), 12)
    warm = noise(512, ((2, 1), (5, 1)), 13)
    stone = tinted(base, (104, 97, 86), (206, 196, 178)) + (warm[..., None] - .5) * (22, 6, -22)
    save(folder, "stone.jpg", stone, 84)
    value = noise(512, ((6, 1), (16, .8), (90, 1), (220, .8)), 14)
    picture = tinted(value, (138, 132, 124), (196, 190, 180))
    y, x = np.mgrid[0:512, 0:512]
    row = y // 128
    joint = np.minimum(np.minimum(y % 128, 128 - y % 128), np.minimum((x + row % 2 * 64) % 128, 128 - (x + row % 2 * 64) % 128))
    rng = np.random.default_rng(15)
    shade = rng.uniform(-12, 12, (4, 5))[row, ((x + row % 2 * 64) // 128)]
    picture += shade[..., None]
    save(folder, "paving.jpg", np.where((joint < 2)[..., None], 70, picture), 84)


def foliage(size, count, seed, long, tones):
    """Four cells of leaves, each some heaps of another tone that leave an irregular outline, cut out by alpha."""
    rng = np.random.default_rng(seed)
    sheet = Image.new("RGBA", (2 * size, 2 * size), (*tones[0], 0))
    for cell, tone in enumerate(tones):
        picture = Image.new("RGBA", (size, size), (*tone, 0))
        draw = ImageDraw.Draw(picture)
        heaps = size * rng.uniform(.22, .78, (6, 2))
        limit = long[1] * 1.3
        for _ in range(count):
            x, y = np.clip(heaps[rng.integers(6)] + rng.normal(0, .105 * size, 2), limit, size - limit)
            t, s = rng.random() * 6.28, rng.uniform(*long)
            leaf = [(s * np.cos(u) * 1.25, s * np.sin(u) * .55) for u in np.linspace(0, 6.28, 9)[:-1]]
            g = rng.uniform(.62, 1.32)
            draw.polygon([(x + p * np.cos(t) - q * np.sin(t), y + p * np.sin(t) + q * np.cos(t)) for p, q in leaf], fill=(*(int(c * g) for c in tone), 255))
        # The first cells are at the foot of the picture, where v is 0.
        sheet.paste(picture, (cell % 2 * size, (1 - cell // 2) * size))
    return sheet


def crown(draw, rng, at, wide, high, tone, width):
    """One crown of a wood seen from afar: heaps of leaves that are lighter above, over again where the picture repeats."""
    dark = tuple(int(c * .5) for c in tone)
    for shift in (-width, 0, width):
        draw.ellipse((at[0] + shift - wide * .9, at[1] - high * .85, at[0] + shift + wide * .9, at[1] + high), fill=(*dark, 255))
    for _ in range(70):
        a, r = rng.random() * 6.28, np.sqrt(rng.random())
        heap = at[0] + wide * r * np.cos(a), at[1] - high * r * np.sin(a)
        light = .74 + .30 * r * np.sin(a) + rng.uniform(-.16, .16)
        for _ in range(16):
            x, y = heap + rng.normal(0, .10 * wide + 1.5, 2)
            s, g = rng.uniform(.9, 2.4), light * rng.uniform(.75, 1.25)
            for shift in (-width, 0, width):
                if -4 < x + shift < width + 4:
                    draw.ellipse((x + shift - s, y - s * .7, x + shift + s, y + s * .7), fill=(*(int(max(0, c * g)) for c in tone), 255))


def treeline(width, height, seed):
    """The edge of a wood over a ground that is dark to the foot, with a ragged top cut out by alpha."""
    rng = np.random.default_rng(seed)
    tones = ((57, 74, 40), (63, 79, 40), (52, 69, 40), (70, 80, 42))
    picture = Image.new("RGBA", (width, height), (44, 58, 32, 0))
    draw = ImageDraw.Draw(picture)
    draw.rectangle((0, height * .72, width, height), fill=(30, 40, 22, 255))
    for row, count in ((.42, 25), (.56, 31), (.68, 36), (.80, 44)):
        for x in rng.permutation(count):
            wide = rng.uniform(.50, 1.60) * width / count * .76
            high = min(wide * rng.uniform(.9, 1.8), height * row * .80)
            at = (x + rng.uniform(.2, .8)) * width / count, height * row + rng.normal(0, 7)
            draw.rectangle((at[0] - 2, at[1], at[0] + 2, height), fill=(30, 36, 22, 255))
            crown(draw, rng, at, wide, high, tones[rng.integers(4)], width)
    return picture


def blades(size, count, tones):
    """Four cells of grass."""
    rng = np.random.default_rng(22)
    sheet = Image.new("RGBA", (2 * size, 2 * size), (*tones[0], 0))
    for cell, tone in enumerate(tones):
        picture = Image.new("RGBA", (size, size), (*tone, 0))
        draw = ImageDraw.Draw(picture)
        for _ in range(count):
            x, lean, high, w = size * rng.uniform(.06, .94), rng.normal(0, size * .09), size * rng.uniform(.3, .95), size * rng.uniform(.006, .012)
            g = rng.uniform(.7, 1.25)
            outline = [(x - w, size), (x + w, size), (x + w * .6 + lean * .4, size - high * .6), (x + lean, size - high), (x - w * .6 + lean * .4, size - high * .6)]
            draw.polygon(outline, fill=(*(int(c * g) for c in tone), 255))
        sheet.paste(picture, (cell % 2 * size, (1 - cell // 2) * size))
    return sheet


def plants(folder):
    value = noise(1024, ((6, .5), (16, .6), (60, .9), (200, 1.2), (400, 1.4)), 20)
    dry = np.clip(noise(1024, ((5, 1), (13, 1), (40, .6), (160, .5)), 21)[..., None] * 2.4 - .7, 0, 1)
    save(folder, "grass.jpg", tinted(value, (54, 68, 25), (126, 140, 66)) * (1 - .5 * dry) + .5 * dry * (154, 140, 82), 76)
    save(folder, "blades.png", blades(256, 60, ((80, 100, 42), (92, 110, 46), (86, 104, 44), (118, 118, 62))))
    save(folder, "leaves.png", foliage(192, 190, 23, (5, 10), ((70, 96, 38), (84, 104, 42), (60, 84, 40), (102, 108, 44))))
    save(folder, "wood.png", treeline(1024, 256, 27))
    hills(folder)
    mountains(folder)


def hills(folder):
    """Fields and woods under haze, which is thickest at their foot."""
    fields = noise(512, ((5, 1), (11, .8), (24, .5)), 24, (1, 2))
    woods = np.clip((noise(512, ((9, 1), (26, 1), (70, .8)), 25, (1, .8)) - .50) * 5, 0, 1)[..., None] * .8
    leaf = noise(512, ((90, 1), (180, 1)), 26, (1, .6))
    land = tinted(fields, (104, 112, 74), (142, 138, 94)) * (1 - woods) + woods * tinted(leaf, (66, 82, 58), (94, 106, 76))
    up = np.linspace(1, 0, 512)[:, None, None]
    haze = .42 - .24 * up
    save(folder, "hills.jpg", land * (1 - haze) + haze * np.array((150, 160, 178)), 80)


def mountains(folder):
    """Slopes of wood and scree under thick haze."""
    slopes = noise(512, ((7, 1), (16, .8), (40, .6), (110, .4)), 28, (1, 1.6))
    haze = .62 + .14 * np.linspace(0, 1, 512)[:, None, None]
    save(folder, "mountains.jpg", tinted(slopes, (40, 58, 46), (150, 146, 128)) * (1 - haze) + haze * np.array((128, 146, 176)), 80)


def car(folder):
    y, x = np.mgrid[0:128, 0:128]
    weave = ((x // 16 + y // 16) // 2) % 2
    across = np.where(weave == 0, np.sin(x * np.pi / 16) ** 2, np.sin(y * np.pi / 16) ** 2)
    save(folder, "carbon.png", tinted(.25 + .75 * across * np.where(weave, .6, 1), (18, 18, 19), (62, 62, 64)))
    size = 256
    y, x = np.mgrid[0:size, 0:size] / size
    # Hexagons: two columns and rows repeat in a square that is stretched by the root of 3 in use.
    u, v = x * 4, y * 4
    a = np.hypot((u % 1 - .5), (v % 1 - .5) * 1.0)
    b = np.hypot(((u + .5) % 1 - .5), ((v + .5) % 1 - .5) * 1.0)
    hole = np.minimum(a, b) < .29
    save(folder, "mesh.png", image(np.where(hole, 0, 255)).resize((128, 128), Image.LANCZOS))
    grain = noise(512, ((40, 1), (90, 1), (170, .8)), 30)
    save(folder, "leather.png", image(tinted(grain, (206, 150, 96), (236, 184, 128))).resize((256, 256)))
    disc(folder)
    signs(folder)


def disc(folder):
    size = 512
    y, x = (np.mgrid[0:size, 0:size] + .5) / size * 2 - 1
    r, a = np.hypot(x, y), np.arctan2(y, x)
    rings = noise(size, ((128, 1),), 32)[0][np.clip((r * 300).astype(int), 0, size - 1)]
    value = 168 + 46 * (rings - .5)
    for k in range(60):
        turn, radius = k * 2 * np.pi / 60, .60 + .33 * ((k * 7) % 5) / 4
        value = np.where(np.hypot(x - radius * np.cos(turn + radius * .7), y - radius * np.sin(turn + radius * .7)) < .020, 22, value)
    save(folder, "disc.png", value)


def signs(folder):
    picture = Image.new("RGB", (1060, 240), (236, 236, 230))
    draw = ImageDraw.Draw(picture)
    draw.rounded_rectangle((8, 8, 1052, 232), 26, outline=(20, 20, 24), width=7)
    font = ImageFont.load_default(size=190)
    draw.text((530, 116), "LU 2K 26", font=font, fill=(20, 20, 26), anchor="mm", stroke_width=4, stroke_fill=(20, 20, 26))
    save(folder, "plate.png", picture.resize((530, 120), Image.LANCZOS))
    picture = Image.new("RGB", (512, 256), (6, 9, 14))
    draw = ImageDraw.Draw(picture)
    draw.arc((30, 30, 226, 226), 130, 410, fill=(230, 120, 30), width=10)
    draw.arc((50, 50, 206, 206), 130, 330, fill=(90, 160, 210), width=4)
    draw.text((128, 128), "0", font=ImageFont.load_default(size=72), fill=(240, 240, 240), anchor="mm")
    draw.rectangle((270, 40, 490, 150), fill=(20, 34, 48))
    draw.line([(280, 140), (320, 100), (350, 120), (400, 70), (480, 60)], fill=(240, 150, 60), width=6)
    for k, text in enumerate(("21.5 C", "P", "12:40")):
        draw.text((300 + k * 76, 200), text, font=ImageFont.load_default(size=26), fill=(200, 210, 220), anchor="mm")
    save(folder, "screen.png", picture)


def write(folder):
    folder.mkdir(exist_ok=True)
    asphalt(folder)
    concrete(folder)
    plants(folder)
    car(folder)
    print("textures: %.2f MB" % (sum(f.stat().st_size for f in folder.iterdir()) / 1e6))
