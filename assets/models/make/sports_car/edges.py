"""Edges of a surface: those that are open, and how they are turned in."""

import numpy as np

from mesh import unit

# How often directions along a rim are evened, and the cosine of what counts as a bend.
EVENED, BEND = 6, .82


def rim(points, faces):
    """Directed edges with a face on one side alone, those on x = 0 left out."""
    seen = {(a, b) for f in faces for a, b in zip(f, f[1:] + f[:1])}
    axis = np.abs(points[:, 0]) < 1e-6
    return [(a, b) for a, b in seen if (b, a) not in seen and not (axis[a] and axis[b])]


def evened(d, ids, edges):
    """Directions along a rim without the jitter of its corners: means with the next ones, but not across a bend of the rim itself."""
    where = {v: k for k, v in enumerate(ids)}
    a, b = np.array([(where[p], where[q]) for p, q in edges]).T
    for _ in range(EVENED):
        alike = ((d[a] * d[b]).sum(1) > BEND)[:, None]
        total = 2 * d
        np.add.at(total, a, d[b] * alike)
        np.add.at(total, b, d[a] * alike)
        d = unit(total)
    return d


def folded(points, normals, faces, depth, lip):
    """A rounded edge of radius `lip` and a wall of `depth` along the rim. Points, faces, normals, normal corners."""
    edges = sorted(rim(points, faces))
    out = {}
    for a, b in edges:
        for v in (a, b):
            d = np.cross(points[b] - points[a], normals[v])
            out[v] = out.get(v, 0) + d
    ids = sorted(out)
    n = normals[ids]
    d = np.array([out[v] for v in ids])
    d = evened(unit(d - n * (d * n).sum(1, keepdims=True)), ids, edges)
    d = unit(d - n * (d * n).sum(1, keepdims=True))
    axis = np.abs(points[ids, 0]) < 1e-6
    d[axis, 0] = 0
    d = unit(d)
    base = points[ids]
    rings = [base + d * lip - n * lip, base + d * lip - n * (lip + depth)]
    ring_normals = [d, d]
    where = {v: k for k, v in enumerate(ids)}
    m, count, total = len(ids), len(points), len(normals)
    new_faces, corners = [], []
    for a, b in edges:
        i, j = where[a], where[b]
        for r in range(2):
            upper = (a, b) if r == 0 else (count + (r - 1) * m + i, count + (r - 1) * m + j)
            upper_n = (a, b) if r == 0 else (total + (r - 1) * m + i, total + (r - 1) * m + j)
            lower = (count + r * m + i, count + r * m + j)
            new_faces.append([upper[1], upper[0], lower[0], lower[1]])
            corners.append([upper_n[1], upper_n[0], total + r * m + i, total + r * m + j])
    return np.concatenate(rings), new_faces, np.concatenate(ring_normals), corners
