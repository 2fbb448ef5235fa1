"""Raised letters, of strokes of even width: the name on the tail and on the tyres."""

import numpy as np

from mesh import joined, smooth, unit
from shapes import oriented

# Strokes of each letter, in a field of its own: x from 0 to its width, y from 0 to 1.
WIDTHS = {"L": .62, "U": .74, "C": .72, "E": .64, "R": .70, "N": .86, "A": .88}
STROKES = {
    "L": (((0, 1), (0, 0), (.62, 0)),),
    "U": (((0, 1), (0, .16), (.16, 0), (.58, 0), (.74, .16), (.74, 1)),),
    "C": (((.72, 1), (.14, 1), (0, .86), (0, .14), (.14, 0), (.72, 0)),),
    "E": (((.64, 1), (0, 1), (0, 0), (.64, 0)), ((.08, .5), (.56, .5))),
    "R": (((0, -.07), (0, 1), (.56, 1), (.70, .86), (.70, .60), (.56, .46), (.08, .46)), ((.36, .42), (.72, -.07))),
    "N": (((0, -.07), (0, 1.07)), ((.86, -.07), (.86, 1.07)), ((.02, 1), (.84, 0))),
    "A": (((0, -.07), (.40, 1.02)), ((.88, -.07), (.48, 1.02)), ((.18, .28), (.70, .28))),
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
    starts = np.cumsum([0] + [WIDTHS[letter] + gap for letter in word])
    wide = (starts[-1] - gap) * height
    bars = []
    for k, letter in enumerate(word):
        start = starts[k] * height - wide / 2
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
