"""Shapes as plain arrays: positions in metres (y up), faces counter-clockwise from outside, and a uv a corner or none."""

from math import acos, ceil, cos, pi, sin

import numpy as np


class Shape:
    def __init__(self, points, faces, uvs=None):
        self.points = np.asarray(points, float).reshape(-1, 3)
        self.faces = [list(face) for face in faces]
        self.uvs = uvs

    def moved(self, x=0.0, y=0.0, z=0.0):
        return Shape(self.points + np.array([x, y, z]), self.faces, self.uvs)

    def mapped(self, change):
        """Every point by a function of an array of points."""
        return Shape(change(self.points.copy()), self.faces, self.uvs)

    def flipped(self):
        uvs = [uv[::-1] for uv in self.uvs] if self.uvs else None
        return Shape(self.points, [face[::-1] for face in self.faces], uvs)

    def __add__(self, other):
        shift = len(self.points)
        uvs = self.uvs + other.uvs if self.uvs and other.uvs else None
        faces = self.faces + [[i + shift for i in face] for face in other.faces]
        return Shape(np.vstack([self.points, other.points]), faces, uvs)


def box(low, high):
    """From one corner to the opposite one."""
    (a, b, c), (d, e, f) = low, high
    points = [(a, b, c), (d, b, c), (d, e, c), (a, e, c), (a, b, f), (d, b, f), (d, e, f), (a, e, f)]
    return Shape(points, [(4, 5, 6, 7), (1, 0, 3, 2), (5, 1, 2, 6), (0, 4, 7, 3), (7, 6, 2, 3), (0, 1, 5, 4)])


def block(centre, size):
    c, s = np.asarray(centre, float), np.asarray(size, float) / 2
    return box(tuple(c - s), tuple(c + s))


def sides(radius):
    """How many sides a circle needs to be nowhere 0.8 mm away from its round."""
    return max(8, ceil(pi / acos(max(1 - 0.0008 / radius, 0.0))))


def lathe(profile, around=None, from_u=0.0, to_u=1.0):
    """(radius, height) from below to above on the outside, about the y axis. An end of radius 0 is closed by a point."""
    around = around or sides(max(radius for radius, _ in profile))
    points, rings = [], []
    for radius, height in profile:
        if radius < 1e-6:
            rings.append([len(points)] * around)
            points.append((0, height, 0))
            continue
        rings.append(list(range(len(points), len(points) + around)))
        points += [(radius * sin(2 * pi * k / around), height, radius * cos(2 * pi * k / around)) for k in range(around)]
    steps = np.hypot(*np.diff(np.array(profile), axis=0).T)
    along = np.concatenate([[0], np.cumsum(steps)]) / max(steps.sum(), 1e-9)
    faces, uvs = [], []
    for i in range(len(rings) - 1):
        for k in range(around):
            n = (k + 1) % around
            corners = [(rings[i][k], k, i), (rings[i][n], k + 1, i), (rings[i + 1][n], k + 1, i + 1), (rings[i + 1][k], k, i + 1)]
            kept, seen = [], set()
            for corner in corners:
                if corner[0] not in seen:
                    kept.append(corner)
                    seen.add(corner[0])
            if len(kept) < 3:
                continue
            faces.append([c[0] for c in kept])
            uvs.append([(from_u + (to_u - from_u) * c[1] / around, along[c[2]]) for c in kept])
    return Shape(points, faces, uvs)


def frames(path, up=(0, 1, 0)):
    """Tangent, side and up along a path, carried from point to point so that they do not twist."""
    path = np.asarray(path, float)
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    up, out = np.asarray(up, float), []
    for t in tangents:
        up = up - t * (up @ t)
        if np.linalg.norm(up) < 1e-6:
            up = np.cross(t, (0.3, 0.5, 0.8))
        up = up / np.linalg.norm(up)
        out.append((t, np.cross(up, t), up))
    return out


def sweep(path, sections, up=(0, 1, 0), closed=True):
    """Sections (lists of (side, up), counter-clockwise seen along -tangent), one a point of the path, joined and capped."""
    path = np.asarray(path, float)
    n, points = len(sections[0]), []
    for p, section, (_, side, upward) in zip(path, sections, frames(path, up)):
        points += [p + side * a + upward * b for a, b in section]
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    faces, uvs = [], []
    for i in range(len(path) - 1):
        for k in range(n):
            m = (k + 1) % n
            faces.append([i * n + k, i * n + m, (i + 1) * n + m, (i + 1) * n + k])
            uvs.append([(length[i], k / n), (length[i], (k + 1) / n), (length[i + 1], (k + 1) / n), (length[i + 1], k / n)])
    if closed:
        last = (len(path) - 1) * n
        faces += [list(range(n))[::-1], [last + k for k in range(n)]]
        uvs += [[(0, 0)] * n, [(0, 0)] * n]
    return Shape(points, faces, uvs)


def ring(radius, around=10, flat=1.0):
    return [(radius * cos(2 * pi * k / around), flat * radius * sin(2 * pi * k / around)) for k in range(around)]


def tube(path, radius, around=10, up=(0, 1, 0)):
    """A round bar: one radius, or one a point."""
    radii = np.broadcast_to(np.asarray(radius, float), (len(path),))
    return sweep(path, [ring(r, around) for r in radii], up)


def curve(points, steps):
    """A Catmull-Rom spline through points, `steps` pieces between two."""
    p = np.asarray(points, float)
    p = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
    out = []
    for i in range(1, len(p) - 2):
        for t in np.arange(steps) / steps:
            a, b, c, d = p[i - 1], p[i], p[i + 1], p[i + 2]
            out.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    out.append(p[-2])
    return np.array(out)


def sheet(across, along, place):
    """A net of quads: place(u, v) with u, v arrays from 0 to 1. Its front is where u goes right and v up."""
    v, u = np.meshgrid(np.linspace(0, 1, along + 1), np.linspace(0, 1, across + 1), indexing="ij")
    points = np.stack(place(u.ravel(), v.ravel()), axis=1)
    row, faces, uvs = across + 1, [], []
    flat = np.stack([u.ravel(), v.ravel()], axis=1)
    for j in range(along):
        for i in range(across):
            a = j * row + i
            face = [a, a + 1, a + row + 1, a + row]
            faces.append(face)
            uvs.append([tuple(flat[k]) for k in face])
    return Shape(points, faces, uvs)


def outline(width, depth, radius, cuts=6):
    """A rectangle with round corners in x and z, counter-clockwise seen from above."""
    out = []
    for cx, cz, start in ((1, -1, 0), (-1, -1, 1), (-1, 1, 2), (1, 1, 3)):
        for k in range(cuts + 1):
            a = (start + k / cuts) * pi / 2
            out.append((cx * (width / 2 - radius) + radius * cos(a), cz * (depth / 2 - radius) - radius * sin(a)))
    return out


def slab(edge, low, high):
    """A flat body on an outline of (x, z)."""
    n = len(edge)
    points = [(x, low, z) for x, z in edge] + [(x, high, z) for x, z in edge]
    faces = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return Shape(points, faces + [list(range(n))[::-1], list(range(n, 2 * n))])


def moulding(width, height, profile):
    """A profile led round a rectangle in x and y, mitred, seen from +z. (out, forward): out from the rectangle's edge, first
    and last point at the back; it goes from the outside over the front to the inside."""
    n, points, faces = len(profile), [], []
    for cx, cy in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        points += [(cx * (width / 2 + out), cy * (height / 2 + out), front) for out, front in profile]
    for k in range(4):
        a, b = k * n, (k + 1) % 4 * n
        faces += [[a + i, b + i, b + i + 1, a + i + 1] for i in range(n - 1)]
        faces.append([a + n - 1, b + n - 1, b, a])
    return Shape(points, faces)
