"""The pictures on the wall, and rims, peels and shades: everything that is painted by hand."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from noise import cloud, lattice, save, scale


def landscape(folder, width=960, height=640):
    """Hills in haze below a low sun, in broad strokes."""
    y, x = np.mgrid[0:height, 0:width] / np.array([height, width]).reshape(2, 1, 1)
    stroke = cloud(height, width, 60, 14, 3, 3) - 0.5
    sky = scale(y * 1.5 + 0.16 * stroke, [(58, 92, 124), (126, 150, 158), (222, 182, 132), (238, 206, 150)])
    disk = np.hypot((x - 0.64) * 1.5, y - 0.36)
    glow = np.clip(1 - disk / 0.42, 0, 1)[..., None] ** 2
    picture = sky * (1 - 0.6 * glow) + np.array((250, 214, 140.0)) * 0.6 * glow
    picture[disk < 0.068 + 0.006 * stroke] = (248, 226, 178)
    layers = [(0.47, 0.1, (142, 150, 152)), (0.56, 0.12, (98, 122, 126)), (0.66, 0.12, (66, 98, 90)), (0.77, 0.1, (112, 102, 54)), (0.88, 0.08, (58, 62, 40))]
    for k, (base, size, colour) in enumerate(layers):
        ridge = lattice(1, width, 1, 4 + k, 70 + k)[0] * 0.7 + lattice(1, width, 1, 13 + 3 * k, 90 + k)[0] * 0.3
        edge = base + size * (0.5 - ridge)
        inside = (y > edge[None, :])[..., None]
        depth = np.clip((y - edge) / 0.16, 0, 1)[..., None]
        strokes = cloud(height, width, 46 + 10 * k, 22, 110 + k, 3)[..., None] - 0.5
        paint = np.array(colour, float) * (0.9 + 0.9 * strokes) * (1.15 - 0.35 * depth) + 18 * (1 - depth)
        picture = np.where(inside, paint, picture)
    soft = Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8)).filter(ImageFilter.ModeFilter(7))
    canvas = 1 + 0.1 * (lattice(height, width, height // 2, width // 2, 9) - 0.5)
    save(folder, "landscape.jpg", np.asarray(soft, float) * 1.18 * canvas[..., None], 82)


def botanical(folder, width=320, height=448):
    """A single fern on paper."""
    scale_up = 3
    picture = Image.new("RGB", (width * scale_up, height * scale_up), (232, 224, 204))
    draw = ImageDraw.Draw(picture)
    w, h = picture.size
    for k in range(30):
        t = k / 29
        x, y = w * (0.5 + 0.06 * np.sin(3 * t)), h * (0.9 - 0.76 * t)
        reach = w * 0.36 * (np.sin(np.pi * (0.12 + 0.86 * t)) ** 0.8)
        for side in (-1, 1):
            tip = (x + side * reach, y - reach * 0.45)
            middle = (x + side * reach * 0.5, y - reach * 0.14)
            draw.polygon([(x, y), (middle[0], middle[1] - 9), tip, (middle[0], middle[1] + 20)], fill=(52 + 2 * k, 84 + k, 52))
    draw.line([(w * (0.5 + 0.06 * np.sin(3 * t)), h * (0.96 - 0.82 * t)) for t in np.linspace(0, 1, 40)], fill=(60, 66, 38), width=7)
    small = np.asarray(picture.resize((width, height), Image.LANCZOS), float)
    save(folder, "botanical.jpg", small * (0.95 + 0.1 * cloud(height, width, 9, 7, 4, 4))[..., None], 82)


def plate(folder, size=512):
    """Seen from above: glaze with a blue band and leaves round the rim."""
    big = Image.new("RGB", (size * 2, size * 2), (236, 232, 222))
    draw = ImageDraw.Draw(big)
    c = size
    for r, width, colour in ((0.965, 14, (44, 70, 112)), (0.70, 6, (44, 70, 112)), (0.68, 2, (120, 140, 168))):
        r *= size
        draw.ellipse((c - r, c - r, c + r, c + r), outline=colour, width=width)
    for k in range(28):
        a = 2 * np.pi * k / 28
        for lean, reach in ((0.06, 0.06), (-0.06, 0.06)):
            p = [(c + size * r * np.cos(a + s), c + size * r * np.sin(a + s)) for r, s in ((0.78, 0), (0.84, lean + 0.02), (0.91, lean), (0.85, lean - 0.03))]
            draw.polygon(p, fill=(64, 96, 140))
    save(folder, "plate.png", big.resize((size, size), Image.LANCZOS).quantize(32))


def peels(folder, size=256):
    """u runs round the fruit, v from its foot to its stalk."""
    y, x = np.mgrid[0:size, 0:size] / size
    v = 1 - y
    blush = np.clip(0.5 + 0.5 * np.sin(2 * np.pi * x) + 0.7 * (cloud(size, size, 3, 5, 1, 4) - 0.5), 0, 1)
    streaks = cloud(size, size, 3, 60, 2, 3)
    apple = scale(np.clip(1.15 * blush + 0.6 * (streaks - 0.5), 0, 1), [(178, 168, 62), (196, 122, 46), (164, 34, 30), (126, 18, 24)])
    apple = apple * (1 - 0.3 * np.clip((v - 0.86) / 0.1, 0, 1)[..., None]) + 30 * np.clip((v - 0.9) / 0.1, 0, 1)[..., None]
    freckles = (lattice(size, size, 90, 90, 5) > 0.93)[..., None]
    save(folder, "apple.jpg", np.where(freckles, apple + 40, apple), 82)
    skin = cloud(size, size, 8, 8, 6, 3)
    orange = scale(skin, [(206, 92, 14), (226, 118, 20), (238, 140, 34)])
    save(folder, "orange.jpg", orange, 80)
    save(folder, "orange_bump.jpg", 255 * (1 - 0.8 * np.clip((lattice(size, size, 56, 56, 7) - 0.62) * 3, 0, 1)), 80)
    pear = scale(0.7 * cloud(size, size, 4, 4, 8, 4) + 0.3 * v, [(150, 150, 48), (186, 178, 70), (206, 186, 84), (192, 146, 70)])
    spots = (lattice(size, size, 100, 100, 9) > 0.9)[..., None]
    save(folder, "pear.jpg", np.where(spots, pear * 0.72, pear), 82)


def shade(folder, width=64, height=256):
    """How bright a lampshade is, from its lower edge to its upper: brightest beside the bulb, cloth between ribs."""
    v = 1 - np.arange(height)[:, None] / height
    glow = 0.34 + 0.66 * np.exp(-(((v - 0.42) / 0.3) ** 2))
    cloth = 0.94 + 0.12 * lattice(height, width, 128, 4, 3)
    edge = np.where((v < 0.035) | (v > 0.965), 0.55, 1)
    grey = glow * cloth * edge * np.ones((1, width))
    save(folder, "shade.jpg", 255 * np.stack([grey, grey**1.12, grey**1.4], axis=2), 88)


def paint(folder):
    for part in (landscape, botanical, plate, peels, shade):
        part(folder)
