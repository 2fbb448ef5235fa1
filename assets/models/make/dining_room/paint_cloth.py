"""Pictures of woven things: the rug, cushions, curtains, the runner on the table, a basket."""

import numpy as np
from PIL import Image, ImageDraw

from noise import cloud, save

NAVY, RED, SAND, CREAM, TEAL = (38, 44, 66), (132, 48, 40), (196, 160, 112), (226, 210, 180), (70, 104, 108)


def weave(size, threads, seed, depth=0.16):
    """Brightness of a plain weave, about 1."""
    y, x = np.mgrid[0:size, 0:size] * threads / size
    over = (np.floor(x) + np.floor(y)) % 2
    round_ = np.where(over > 0, np.sin(np.pi * (x % 1)), np.sin(np.pi * (y % 1)))
    return 1 - depth + depth * round_ + 0.16 * (cloud(size, size, threads, 4, seed, 2) - 0.5) + 0.16 * (cloud(size, size, 4, threads, seed + 1, 2) - 0.5)


def star(draw, x, y, r, fill, points=8):
    corners = []
    for k in range(2 * points):
        a, d = np.pi * k / points, r if k % 2 == 0 else r * 0.58
        corners.append((x + d * np.cos(a), y + d * np.sin(a)))
    draw.polygon(corners, fill=fill)


def diamond(draw, x, y, rx, ry, fill):
    draw.polygon([(x - rx, y), (x, y - ry), (x + rx, y), (x, y + ry)], fill=fill)


def rug(folder, width=1152, height=800):
    """Borders round a field of diamonds and stars."""
    picture = Image.new("RGB", (width, height), NAVY)
    draw = ImageDraw.Draw(picture)
    for inset, fill in ((14, SAND), (22, RED), (84, SAND), (92, NAVY), (100, CREAM), (106, RED)):
        draw.rectangle((inset, inset, width - 1 - inset, height - 1 - inset), fill=fill)
    for along, across, count in ((width, height, 22), (height, width, 15)):
        for k in range(count):
            t = 53 + (along - 106) * k / (count - 1)
            for side in (53, across - 53):
                x, y = (t, side) if along == width else (side, t)
                diamond(draw, x, y, 20, 20, CREAM if k % 2 else TEAL)
                diamond(draw, x, y, 9, 9, NAVY if k % 2 else SAND)
    left, top, right, bottom = 122, 122, width - 122, height - 122
    columns, rows = 7, 4
    for i in range(columns):
        for j in range(rows):
            x = left + (right - left) * (i + 0.5) / columns
            y = top + (bottom - top) * (j + 0.5) / rows
            rx, ry = (right - left) / columns / 2 - 3, (bottom - top) / rows / 2 - 3
            odd = (i + j) % 2
            diamond(draw, x, y, rx, ry, NAVY if odd else TEAL)
            diamond(draw, x, y, rx * 0.86, ry * 0.86, RED if odd else NAVY)
            star(draw, x, y, 36, SAND)
            star(draw, x, y, 22, NAVY if odd else RED)
            star(draw, x, y, 10, CREAM)
    colour = np.asarray(picture, float)
    rows_of_knots = 0.9 + 0.2 * cloud(height, width, height // 3, width // 3, 5, 2)
    faded = 0.82 + 0.4 * cloud(height, width, 5, 7, 6, 3)
    bands = 0.95 + 0.1 * cloud(height, width, 60, 1, 8, 2)
    # A few knots of the pile, which repeat.
    save(folder, "rug_bump.jpg", 255 * (0.25 + 0.75 * (weave(96, 6, 9, 0.7) - 0.2)) * (0.7 + 0.5 * cloud(96, 96, 12, 12, 10, 2)), 80)
    save(folder, "rug.jpg", colour * (rows_of_knots * faded * bands)[..., None], 80)


def cushion(folder, size=384):
    """Ochre linen with thin stripes."""
    x = np.arange(size) / size
    stripe = (np.abs((x * 6) % 1 - 0.5) < 0.05) | (np.abs((x * 6 + 0.16) % 1 - 0.5) < 0.02)
    base = np.where(stripe[None, :, None], np.array((216, 190, 140.0)), np.array((176, 112, 46.0)))
    save(folder, "cushion.jpg", base * np.ones((size, 1, 1)) * weave(size, 96, 31)[..., None] * 1.04, 82)


def curtain(folder, size=512):
    """Linen of a burnt red with sprigs."""
    picture = Image.new("L", (size * 2, size * 2), 0)
    draw = ImageDraw.Draw(picture)
    for cx, cy, lean in ((256, 256, 1), (768, 768, -1)):
        draw.line([(cx - 20 * lean, cy + 190), (cx, cy), (cx + 24 * lean, cy - 180)], fill=255, width=9)
        for k in range(6):
            y = cy + 150 - k * 58
            for side in (-1, 1):
                w, h = 74 - 6 * k, 26
                x = cx + side * (w / 2 + 8) + lean * (k * 7 - 20)
                draw.ellipse((x - w / 2, y - h / 2, x + w / 2, y + h / 2), fill=255)
    sprig = np.asarray(picture.resize((size, size)), float)[..., None] / 255
    base = np.array((166, 84, 52.0)) * (1 - sprig) + np.array((208, 156, 98.0)) * sprig
    save(folder, "curtain.jpg", base * weave(size, 128, 41, 0.12)[..., None] * 1.03, 78)


def runner(folder, width=1024, height=256):
    """Along u; bands towards both long edges, a row of lozenges between."""
    picture = Image.new("RGB", (width, height), (222, 214, 196))
    draw = ImageDraw.Draw(picture)
    for y, h, fill in ((20, 8, TEAL), (34, 3, TEAL), (58, 2, RED), (height - 28, 8, TEAL), (height - 37, 3, TEAL), (height - 60, 2, RED)):
        draw.rectangle((0, y, width, y + h), fill=fill)
    for k in range(24):
        x = width * (k + 0.5) / 24
        for y in (46, height - 46):
            diamond(draw, x, y, 9, 6, (150, 120, 70))
    texture = np.tile(weave(256, 64, 51, 0.14), (1, 4))[:height, :width]
    save(folder, "runner.jpg", np.asarray(picture, float) * texture[..., None] * 1.04, 80)


def basket(folder, size=384):
    """Strips of cane over and under each other, their colour and their heights."""
    y, x = np.mgrid[0:size, 0:size] * 12 / size
    over = (np.floor(x) + np.floor(y)) % 2 > 0
    a, b = np.sin(np.pi * (x % 1)) ** 0.5, np.sin(np.pi * (y % 1)) ** 0.5
    along, across = np.sin(np.pi * (y % 1)) ** 0.35, np.sin(np.pi * (x % 1)) ** 0.35
    heights = np.where(over, a * along, b * across)
    fibre = np.where(over, cloud(size, size, 6, 96, 61, 2), cloud(size, size, 96, 6, 62, 2))
    tone = (0.35 + 0.65 * heights) * (0.7 + 0.6 * fibre)
    save(folder, "basket.jpg", np.array((196, 152, 96.0)) * tone[..., None], 80)
    save(folder, "basket_bump.jpg", 255 * heights, 80)


def paint(folder):
    for part in (rug, cushion, curtain, runner, basket):
        part(folder)
