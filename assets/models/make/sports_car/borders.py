"""Lines where two regions of the skin meet, and edges that are turned in along them."""

import numpy as np

from mesh import smooth, unit

# In how many steps an edge bends.
BENDS = 5


class Line:
    """Points at even steps; at each the way out of the surface, and the way along it into the inner region. `closed`, or from the middle line on."""

    def __init__(self, points, out, inner, closed):
        self.points, self.out, self.inner, self.closed = points, out, inner, closed


def line(skin, inner, outer, step=.012, evened=2):
    """Where faces of the labels `inner` meet those of `outer`; with no `outer`, where the surface ends."""
    faces = skin.faces_of(inner)
    sides = {(a, b) for f in faces for a, b in zip(f, f[1:] + f[:1])}
    other = {(b, a) for f in (skin.faces_of(outer) if outer else skin.faces) for a, b in zip(f, f[1:] + f[:1])}
    after = {a: b for a, b in sides if (b, a) not in sides and ((a, b) in other) == bool(outer) and max(skin.points[[a, b], 0]) > 1e-6}
    starts = set(after) - set(after.values())
    ids = [min(starts) if starts else min(after)]
    while after.get(ids[-1]) not in (None, ids[0]):
        ids.append(after[ids[-1]])
    closed = not starts
    if closed:
        ids.append(ids[0])
    path, out = skin.points[ids], skin.normals[ids]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    even = np.linspace(0, along[-1], int(along[-1] / step) + 1)
    path, out = (np.stack([np.interp(even, along, rows[:, k]) for k in range(3)], 1) for rows in (path, out))
    if closed:
        path, out = path[:-1], out[:-1]
    for _ in range(evened):
        path, out = evenly(path, closed), evenly(out, closed)
    out = unit(out)
    ways = (np.roll(path, -1, 0) - np.roll(path, 1, 0)) if closed else np.gradient(path, axis=0)
    middle = np.abs(path[:, :1]) < 1e-6
    ways = np.where(middle, ways * (1, 0, 0), ways)
    return Line(path, out, unit(np.cross(out, ways)), closed)


def evenly(rows, closed):
    """Means with the next ones, but for the ends of what is not closed."""
    mean = (np.roll(rows, 1, 0) + 2 * rows + np.roll(rows, -1, 0)) / 4
    return mean if closed else np.concatenate([rows[:1], mean[1:-1], rows[-1:]])


def bend(edge, into, radius, depth):
    """Rows of points along a line: from it the surface bends by `radius` towards `into` and goes on until it is `depth` below (one, or one a point)."""
    depth = np.broadcast_to(depth, len(edge.points))[:, None]
    rows = [edge.points + edge.inner * radius * np.sin(a) + into * radius * (1 - np.cos(a)) for a in np.linspace(0, np.pi / 2, BENDS)]
    return [*rows, rows[-1] + into * (depth - radius)]


def strip(name, material, rows, closed, out=None, angle=70):
    """A surface through rows of points; `out`: the way out along the first, after which it is turned and, there, shaded."""
    points = np.stack(rows, 1)
    n, m = points.shape[:2]
    faces = [[i * m + k, i * m + k + 1, (i + 1) % n * m + k + 1, (i + 1) % n * m + k] for i in range(n if closed else n - 1) for k in range(m - 1)]
    part = smooth(name, material, points.reshape(-1, 3), faces, angle)
    if out is None:
        return part
    if part.normals[part.corners[0][0]] @ out[0] < 0:
        part = part.flipped()
    for face, corners in zip(part.faces, part.corners):
        for v, c in zip(face, corners):
            if v % m == 0:
                part.normals[c] = out[v // m]
    return part
