"""The lower edge of the body behind the rear wheels: a dark band, as high everywhere and set in as far, up to the diffuser."""

import numpy as np

from edges import rim
from mesh import joined, smooth, unit
from panels import ARCHES, DIFFUSER
from shell import pair

# How high the band is, and how far it stands behind the body's edge.
HIGH, IN = .040, .015
# Across it, from inside of the body over its rounded foot to below the floor: how far in, and how far below the body's edge.
SECTION = ((IN, -.020), (IN, HIGH - .008), (IN + .0025, HIGH - .0025), (IN + .008, HIGH), (.10, HIGH))
# How far apart its sections stand, and how far from the arches it ends.
STEP, CLEAR = .03, .004


def border(skin):
    """The body's lower border from the middle of the nose round to the middle of the tail, at even steps."""
    after = {}
    for a, b in rim(skin.points, skin.faces):
        after.setdefault(a, []).append(b)
        after.setdefault(b, []).append(a)
    at, last = max((v for v in after if len(after[v]) == 1), key=lambda v: skin.points[v, 2]), None
    ids = []
    while at is not None:
        ids.append(at)
        at, last = next((v for v in after[at] if v != last), None), at
    path = skin.points[ids]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    even = np.linspace(0, along[-1], int(along[-1] / STEP))
    return np.stack([np.interp(even, along, path[:, k]) for k in range(3)], 1)


def runs(keep):
    """The stretches in which a row of booleans is true, as slices."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], keep.astype(int), [0]])))
    return [slice(a, b) for a, b in zip(edges[::2], edges[1::2])]


def band(path, out):
    """The band along a stretch of the border; `out` is the way outwards at each point."""
    points = np.array([[p - o * a - (0, b, 0) for a, b in SECTION] for p, o in zip(path, out)])
    n, m = points.shape[:2]
    faces = [[i * m + k, i * m + k + 1, (i + 1) * m + k + 1, (i + 1) * m + k] for i in range(n - 1) for k in range(m - 1)]
    faces += [list(range(m))[::-1], [(n - 1) * m + k for k in range(m)]]
    part = smooth("skirt", "trim_black", points.reshape(-1, 3), faces, 50)
    return part if part.normals[part.corners[0][0]] @ out[0] > 0 else part.flipped()


def all_parts(whole):
    path = border(whole)
    along = unit(np.gradient(path, axis=0))
    out = unit(np.stack([-along[:, 2], 0 * along[:, 0], along[:, 0]], 1))
    keep = (path[:, 2] < ARCHES[1][0]) & (path[:, 0] > DIFFUSER[:, 0].max())
    for z, y, r in ARCHES:
        keep &= np.hypot(path[:, 2] - z, path[:, 1] - y) > r + CLEAR
    return pair(joined("skirt", [band(path[run], out[run]) for run in runs(keep) if run.stop - run.start > 2]))
