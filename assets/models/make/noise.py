"""Noise on arrays of numbers that repeats at its edges, and colours along a scale. All seeds are fixed."""

import numpy as np
from PIL import Image


def lattice(height, width, down, across, seed):
    """Smooth noise from 0 to 1 with `down` x `across` cells, which goes on at the other side. `seed` may be a generator."""
    cells = np.random.default_rng(seed).random((down, across))

    def axis(length, count):
        x = np.arange(length) * count / length
        i = np.floor(x).astype(int)
        t = x - i
        return i % count, (i + 1) % count, t * t * (3 - 2 * t)

    y0, y1, ty = axis(height, down)
    x0, x1, tx = axis(width, across)
    tx, ty = tx[None, :], ty[:, None]
    top = cells[np.ix_(y0, x0)] * (1 - tx) + cells[np.ix_(y0, x1)] * tx
    low = cells[np.ix_(y1, x0)] * (1 - tx) + cells[np.ix_(y1, x1)] * tx
    return top * (1 - ty) + low * ty


def cloud(height, width, down, across, seed, octaves=4):
    out, weight, total = 0, 1.0, 0.0
    for k in range(octaves):
        out = out + weight * lattice(height, width, min(down << k, height), min(across << k, width), seed * 31 + k)
        total += weight
        weight /= 2
    return out / total


def scale(value, stops):
    """A colour (0 to 255) for numbers from 0 to 1, by colours evenly spaced on the way."""
    stops = np.array(stops, float)
    x = np.clip(value, 0, 1) * (len(stops) - 1)
    i = np.clip(x.astype(int), 0, len(stops) - 2)
    t = (x - i)[..., None]
    return stops[i] * (1 - t) + stops[i + 1] * t


def image(values):
    """An array of 0 to 255, grey or colour, as a picture."""
    return Image.fromarray(np.clip(np.round(values), 0, 255).astype(np.uint8))


def save(folder, name, picture, quality=85):
    """A picture, or what is to be one, as a file: .jpg or .png by its name."""
    picture = image(picture) if isinstance(picture, np.ndarray) else picture
    if name.endswith(".jpg"):
        picture.save(folder / name, quality=quality, optimize=True)
    else:
        picture.save(folder / name, optimize=True)


def at_height(seed, points, cell):
    """Noise from -1 to 1 at points in space, for bodies that are not quite even."""
    p = np.asarray(points) / cell
    i = np.floor(p).astype(int)
    t = p - i
    t = t * t * (3 - 2 * t)
    table = np.random.default_rng(seed).random(4096) * 2 - 1
    out = 0
    for dx in (0, 1):
        for dy in (0, 1):
            for dz in (0, 1):
                key = (i[:, 0] + dx) * 73 + (i[:, 1] + dy) * 179 + (i[:, 2] + dz) * 283
                w = (t[:, 0] if dx else 1 - t[:, 0]) * (t[:, 1] if dy else 1 - t[:, 1]) * (t[:, 2] if dz else 1 - t[:, 2])
                out = out + w * table[key % 4096]
    return out
