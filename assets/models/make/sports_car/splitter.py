"""The splitter: a blade under the front bumper that stands out ahead of it, thin at its rounded edge, and ends at each side in a fin before the wheel."""

import numpy as np

from edges import rim
from mesh import unit
from shapes import oriented, soft_loft
from sculpt import step

# Across the blade, from below the bumper to its edge and back: how far from the root (0 to 1), and how high.
SECTION = ((0, .116), (.55, .1155), (.80, .113), (.94, .108), (1, .102), (.96, .097), (.80, .094), (.40, .093), (0, .093))
# How far it reaches under the bumper, and ahead of it: by x.
UNDER = .06
REACH = ((0, .35, .62, .80, .875, .93), (.068, .066, .064, .058, .046, .030))
# How far the edge is lifted where it runs back to the wheel.
LIFT = .010


def lower_edge(skin):
    """Corners of the front bumper's open lower edge, from the middle outwards and back to the arch."""
    ids = {v for e in rim(skin.points, skin.faces) for v in e}
    p = skin.points[sorted(ids)]
    p = p[(p[:, 1] < .16) & (p[:, 2] > 1.66)]
    p = p[np.lexsort((np.round(-p[:, 2], 5), np.round(p[:, 0] - .5 * p[:, 2], 5)))][:, [0, 2]]
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(p, axis=0).T))])
    even = np.linspace(0, along[-1], 17)
    q = np.stack([np.interp(even, along, p[:, k]) for k in (0, 1)], 1)
    for _ in range(3):
        q[1:-1] = (q[:-2] + 2 * q[1:-1] + q[2:]) / 4
    q[0, 0] = 0
    return q


def blade(skin):
    p = lower_edge(skin)
    t = unit(np.gradient(p, axis=0))
    out = np.stack([-t[:, 1], t[:, 0]], 1)
    out[0] = (0, 1)
    rows = []
    back = step((2.05 - p[:, 1]) / .36)
    for q, d, b in zip(p, out, back):
        reach = np.interp(q[0], *REACH) * (1 - .45 * b)
        rows.append([(*(q + d * (-UNDER + (UNDER + reach) * s)), y + LIFT * b * s ** 3) for s, y in SECTION])
    half = [[(x, y, z) for x, z, y in row] for row in rows]
    other = [[(-x, y, z) for x, y, z in row] for row in half[:0:-1]]
    return oriented(soft_loft("splitter", "trim_black", other + half, 1))


def all_parts(skin):
    return [blade(skin)]
