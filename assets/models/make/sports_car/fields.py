"""Outlines in a plane as signed distances, negative inside, from which panels, windows and holes are cut."""

import numpy as np

SIDE, TOP, FRONT = (2, 1), (0, 2), (0, 1)


def fillet(points, radius, steps=5):
    """Rounds the corners of a closed polygon. `radius`: one for all, or one a corner."""
    p = np.asarray(points, float)
    n = len(p)
    radii = np.broadcast_to(radius, n)
    out = []
    for k in range(n):
        a, b, c = p[k - 1], p[k], p[(k + 1) % n]
        u, v = a - b, c - b
        lu, lv = np.linalg.norm(u), np.linalg.norm(v)
        u, v = u / lu, v / lv
        half = np.arccos(np.clip(u @ v, -1, 1)) / 2
        cut = min(radii[k] / max(np.tan(half), 1e-3), 0.48 * lu, 0.48 * lv)
        if cut < 1e-4:
            out.append(b)
            continue
        start, end = b + u * cut, b + v * cut
        for s in np.linspace(0, 1, steps):
            out.append((1 - s) ** 2 * start + 2 * s * (1 - s) * b + s * s * end)
    return np.array(out)


def curve(points, steps=6):
    """An open Catmull-Rom curve through points of a plane."""
    p = np.asarray(points, float)
    p = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    out = []
    for k in range(1, len(p) - 2):
        for s in np.arange(steps) / steps:
            a, b, c, d = p[k - 1:k + 3]
            out.append(0.5 * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s * s + (3 * b - a - 3 * c + d) * s ** 3))
    return np.array(out + [p[-2]])


def mirrored(points):
    """A polygon through the points and their mirror images; the first and the last should lie on the axis."""
    p = np.asarray(points, float)
    q = p[::-1] * (-1, 1)
    return np.concatenate([p, [r for r in q if abs(r[0]) > 1e-9]])


class Outline:
    """The signed distance of positions, seen along an axis, to a closed polygon."""

    def __init__(self, points, axes, radius=0.0):
        self.points = fillet(points, radius) if np.any(np.asarray(radius) > 0) else np.asarray(points, float)
        self.axes = axes

    def __call__(self, positions):
        p = positions[:, list(self.axes)]
        distance = np.full(len(p), np.inf)
        inside = np.zeros(len(p), bool)
        a = self.points
        for u, v in zip(a, np.roll(a, -1, 0)):
            e, w = v - u, p - u
            t = np.clip((w @ e) / max(e @ e, 1e-18), 0, 1)
            distance = np.minimum(distance, np.hypot(*(w - t[:, None] * e).T))
            above = u[1] > p[:, 1]
            if abs(e[1]) > 1e-12:
                cross = (above != (v[1] > p[:, 1])) & (p[:, 0] < e[0] * (p[:, 1] - u[1]) / e[1] + u[0])
                inside ^= cross
        return np.where(inside, -distance, distance)


def circle(centre, radius, axes=SIDE):
    return lambda positions: np.hypot(*(positions[:, list(axes)] - centre).T) - radius


def below(axis, value):
    return lambda positions: positions[:, axis] - value
