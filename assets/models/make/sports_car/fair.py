"""Fairing: of all surfaces near a given one, that whose curvature is most even, so that highlights run along it in calm lines; its creases stay."""

import numpy as np

from mesh import unit

# An edge is a crease where its faces meet by more than this, in degrees.
CREASE = 13.0
# Of the finest surface: how much evenness counts beside staying where it was. Waves shorter than about a quarter of a metre go.
EVEN = 600.0
# Of the wings and the bonnet so many times that, between these z, from where to where it grows and falls again.
CALMER, CALM = 5.0, (.55, 1.0, 1.85, 2.15)
# What is left of the error when the solver stops.
DONE = 1e-9


def edges_of(points, faces):
    """Every edge once, as two corners; whether it is a crease or the border, that on x = 0 left out."""
    f = np.asarray(faces)
    flat = unit(np.cross(points[f[:, 2]] - points[f[:, 0]], points[f[:, 3]] - points[f[:, 1]]))
    ends = np.sort(np.stack([f, np.roll(f, -1, 1)], -1).reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(f)), 4)
    order = np.lexsort((owner, ends[:, 1], ends[:, 0]))
    ends, owner = ends[order], owner[order]
    first = np.concatenate([[True], (ends[1:] != ends[:-1]).any(1)])
    start = np.flatnonzero(first)
    twice = np.diff(np.append(start, len(ends))) == 2
    bend = (flat[owner[start]] * flat[owner[np.minimum(start + 1, len(owner) - 1)]]).sum(1)
    ends = ends[start]
    middle = np.abs(points[ends, 0]).max(1) < 1e-7
    return ends, np.where(twice, bend < np.cos(np.radians(CREASE)), ~middle)


class Laplacian:
    """How far each point lies from the mean of its neighbours; one on a crease, from those along it; where creases meet or end, nothing."""

    def __init__(self, points, faces):
        edges, crease = edges_of(points, faces)
        axis = np.abs(points[:, 0]) < 1e-7
        self.count = len(points)
        lines = np.bincount(edges[crease].ravel(), minlength=self.count)
        along = (lines == 2) | (axis & (lines == 1))
        pairs = np.concatenate([edges, edges[:, ::-1]])
        sharp = np.concatenate([crease, crease])
        used = np.where(along[pairs[:, 0]], sharp, lines[pairs[:, 0]] == 0)
        self.a, self.b = pairs[used].T
        # A neighbour of the middle line stands for its mirror image as well.
        weight = np.where(axis[self.a] & ~axis[self.b], 2.0, 1.0)
        total = np.bincount(self.a, weight, self.count)
        self.weight = weight / total[self.a]
        self.some = total > 0
        self.fixed = ~self.some

    def times(self, v):
        return np.where(self.some, v - np.bincount(self.a, self.weight * v[self.b], self.count), 0)

    def transposed(self, v):
        v = np.where(self.some, v, 0)
        return v - np.bincount(self.b, self.weight * v[self.a], self.count)


def fair(points, faces, levels):
    """The points of a surface of quads that was subdivided so often."""
    laplacian = Laplacian(points, faces)
    even = EVEN * 16.0 ** (levels - 4)
    free = np.where(laplacian.fixed, 0.0, 1.0)
    much = 1 + np.interp(points[:, 2], CALM, (0, CALMER - 1, CALMER - 1, 0))
    middle = np.abs(points[:, 0]) < 1e-7
    out = points.copy()
    for k in range(3):
        # Across the middle line a surface goes on to its mirror image, so that there x is 0, and even.
        held = middle if k == 0 else np.zeros(len(points), bool)
        uneven = lambda v: free * np.where(held, 0, laplacian.transposed(np.where(held, 0, much * laplacian.times(v))))
        move = lambda v: np.where(held, v, v + even * uneven(np.where(held, 0, v)))
        out[:, k] += solve(move, -even * uneven(points[:, k]))
    return np.round(out, 7)


def solve(apply, right):
    """Conjugate gradients: the v for which `apply(v)` is `right`."""
    v, left = np.zeros_like(right), right.copy()
    way, size = left.copy(), left @ left
    goal = size * DONE ** 2
    while size > goal:
        ahead = apply(way)
        t = size / (way @ ahead)
        v, left = v + t * way, left - t * ahead
        size, before = left @ left, size
        way = left + size / before * way
    return v
