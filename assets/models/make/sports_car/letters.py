"""Raised letters, of strokes of even width: the name on the tail and on the tyres."""

import numpy as np

from mesh import joined, smooth, unit
from shapes import oriented

# Strokes of each letter, in a field of its own: x from 0 to WIDE, y from 0 to 1.
WIDE = .72
STROKES = {
    "L": (((0, 1), (0, 0), (.72, 0)),),
    "U": (((0, 1), (0, .14), (.14, 0), (.58, 0), (.72, .14), (.72, 1)),),
    "C": (((.72, 1), (.14, 1), (0, .86), (0, .14), (.14, 0), (.72, 0)),),
    "E": (((.72, 1), (0, 1), (0, 0), (.72, 0)), ((.10, .5), (.62, .5))),
    "R": (((0, 0), (0, 1), (.58, 1), (.72, .86), (.72, .58), (.58, .44), (.10, .44)), ((.38, .37), (.72, 0))),
    "N": (((0, 0), (0, 1), (.72, 0), (.72, 1)),),
    "A": (((0, 0), (0, .74), (.26, 1), (.46, 1), (.72, .74), (.72, 0)), ((.10, .40), (.62, .40))),
}


def edges(line, width):
    """The two sides of a stroke, with mitred corners."""
    p = np.asarray(line, float)
    t = unit(np.diff(p, axis=0))
    across = np.stack([-t[:, 1], t[:, 0]], 1)
    first, last = np.concatenate([across[:1], across]), np.concatenate([across, across[-1:]])
    middle = unit(first + last)
    out = middle / np.maximum((middle * last).sum(1), .55)[:, None] * width / 2
    return p + out, p - out


def text(name, material, word, height, thick, place, weight=.17, gap=.34):
    """A word as bars: `place(across, up, out)` puts a point of the plane, in metres from the word's middle, into space."""
    wide = (len(word) * (WIDE + gap) - gap) * height
    bars = []
    for k, letter in enumerate(word):
        start = k * (WIDE + gap) * height - wide / 2
        for line in STROKES[letter]:
            left, right = edges(line, weight)
            n = len(left)
            points = [place(start + x * height, (y - .5) * height, out) for out in (0, thick) for side in (left, right) for x, y in side]
            a, b, c, d = 0, n, 2 * n, 3 * n
            faces = [[c + i, d + i, d + i + 1, c + i + 1] for i in range(n - 1)]
            for low, high in ((a, c), (d, b)):
                faces += [[low + i, high + i, high + i + 1, low + i + 1] for i in range(n - 1)]
            faces += [[a, b, d, c], [a + n - 1, c + n - 1, d + n - 1, b + n - 1]]
            under = [[b + i, a + i, a + i + 1, b + i + 1] for i in range(n - 1)]
            # Turned outwards by the closed body; what lies on the surface is left out.
            bar = oriented(smooth(name, material, points, faces + under, 20))
            bar.faces, bar.corners, bar.uv_corners = bar.faces[:len(faces)], bar.corners[:len(faces)], bar.uv_corners[:len(faces)]
            bars.append(bar)
    return joined(name, bars)
