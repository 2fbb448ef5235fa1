"""Fairing: a dense surface is smoothed a little, so that highlights run along it in even lines; its creases stay."""

import numpy as np

from mesh import unit

# An edge is a crease where its faces meet by more than this, in degrees.
CREASE = 13.0


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


def fair(points, faces, rounds):
    """The points of a surface of quads, moved in some rounds half-way to the mean of their neighbours; those on a crease, of their neighbours
    along it. Where creases meet or end, none is moved."""
    edges, crease = edges_of(points, faces)
    axis = np.abs(points[:, 0]) < 1e-7
    n = len(points)
    lines = np.bincount(edges[crease].ravel(), minlength=n)
    along = (lines == 2) | (axis & (lines == 1))
    pairs = np.concatenate([edges, edges[:, ::-1]])
    sharp = np.concatenate([crease, crease])
    used = np.where(along[pairs[:, 0]], sharp, lines[pairs[:, 0]] == 0)
    a, b = pairs[used].T
    count = np.bincount(a, minlength=n)
    p = points.copy()
    for _ in range(rounds):
        mean = np.stack([np.bincount(a, p[b, k], n) for k in range(3)], 1) / np.maximum(count, 1)[:, None]
        p = np.where(count[:, None] > 0, (p + mean) / 2, p)
        p[axis, 0] = 0
    return p
