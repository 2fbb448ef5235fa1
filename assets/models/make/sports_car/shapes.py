"""Plain shapes: turned profiles, tubes, rounded boxes, plates, sweeps."""

import numpy as np

from mesh import smooth, unit
from subdivide import subdivide


def lathe(name, material, profile, steps, angle=35.0, uv=None, bend=None, closed=False):
    """Turns (x, radius) about the x axis. The outside is on the left of the profile, seen with x to the right and the
    radius up. `steps`: how many, or the angles. `bend(x, r, turn)` may change radii; `uv`: (repeats round, repeats along)."""
    profile = np.asarray(profile, float)
    turn = np.arange(steps) * 2 * np.pi / steps if np.ndim(steps) == 0 else np.asarray(steps, float)
    n, m = len(profile), len(turn)
    x = np.repeat(profile[:, 0][:, None], m, 1)
    r = np.repeat(profile[:, 1][:, None], m, 1)
    if bend is not None:
        x, r = bend(x, r, np.repeat(turn[None], n, 0))
    points = np.stack([x, r * np.cos(turn), r * np.sin(turn)], -1).reshape(-1, 3)
    rows = n if closed else n - 1
    faces, uv_corners = [], []
    for i in range(rows):
        a, b = i * m, (i + 1) % n * m
        for j in range(m):
            k = (j + 1) % m
            face = [a + j, a + k, b + k, b + j]
            if profile[i, 1] < 1e-9:
                face = [a, b + k, b + j]
            elif profile[(i + 1) % n, 1] < 1e-9:
                face = [a + j, a + k, b]
            faces.append(face)
            uv_corners.append([i * (m + 1) + j, i * (m + 1) + j + 1, (i + 1) * (m + 1) + j + 1, (i + 1) * (m + 1) + j][:len(face)])
    if uv is None:
        return smooth(name, material, points, faces, angle)
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(profile, axis=0).T))])
    along /= along[-1]
    uvs = [(uv[0] * j / m, uv[1] * along[i % n]) for i in range(n + 1) for j in range(m + 1)]
    return smooth(name, material, points, faces, angle, uvs, uv_corners)


def frames(path):
    """Two directions across a path at each of its points, without twist."""
    t = unit(np.gradient(path, axis=0))
    side = np.cross(t[0], (0, 1, 0) if abs(t[0][1]) < .9 else (1, 0, 0))
    out = []
    for k in range(len(path)):
        side = unit(side - t[k] * (side @ t[k]))
        out.append((side, np.cross(side, t[k])))
    return out


def sweep(name, material, path, section, angle=35.0, closed=False, cap=True):
    """A section (points across, counter-clockwise) or one a point of the path, carried along it."""
    path = np.asarray(path, float)
    if closed:
        t = np.concatenate([path[-1:], path, path[:1]])
        across = frames(t)[1:-1]
    else:
        across = frames(path)
    section = np.asarray(section, float)
    if section.ndim == 2:
        section = np.repeat(section[None], len(path), 0)
    n, m = len(path), section.shape[1]
    points = np.array([path[k] + s[0] * across[k][0] + s[1] * across[k][1] for k in range(n) for s in section[k]])
    faces = []
    for i in range(n if closed else n - 1):
        a, b = i * m, (i + 1) % n * m
        faces += [[a + j, b + j, b + (j + 1) % m, a + (j + 1) % m] for j in range(m)]
    if cap and not closed:
        faces += [list(range(m)), [(n - 1) * m + j for j in range(m)][::-1]]
    part = smooth(name, material, points, faces, angle)
    return part if volume(part) > 0 or not cap else smooth(name, material, points, [f[::-1] for f in faces], angle)


def volume(part):
    total = 0.0
    for f in part.faces:
        p = part.points[f]
        for k in range(1, len(f) - 1):
            total += p[0] @ np.cross(p[k], p[k + 1])
    return total / 6


def disk(radius, steps=12, squash=1.0):
    turn = np.arange(steps) * 2 * np.pi / steps
    return np.stack([radius * np.cos(turn), radius * squash * np.sin(turn)], 1)


def squared(half, height, power, steps=16, lean=0.0):
    """A rounded rectangle, a little higher on its outer side by `lean`."""
    turn = np.arange(steps) * 2 * np.pi / steps
    c, s = np.cos(turn), np.sin(turn)
    return np.sign(c) * np.abs(c) ** power * half, np.sign(s) * np.abs(s) ** power * height * (1 + lean * c)


def tube(name, material, path, radius, steps=12, closed=False):
    return sweep(name, material, path, disk(radius, steps), 50.0, closed)


def box(name, material, centre, size, radius=.005, steps=1, turn=None):
    """A box with rounded edges."""
    half = np.asarray(size, float) / 2
    radius = min(radius, half.min() * .95)
    a = np.linspace(0, np.pi / 4, steps + 1)
    points, faces, index = [], [], {}

    def at(p):
        key = tuple(np.round(p, 7))
        if key not in index:
            index[key] = len(points)
            points.append(p)
        return index[key]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            line = np.concatenate([-1 - np.tan(a[::-1]) * 1, 1 + np.tan(a)])
            grid = []
            for s in line:
                row = []
                for t in line:
                    core, rest = np.zeros(3), np.zeros(3)
                    core[axis], rest[axis] = sign * (half[axis] - radius), sign
                    for k, w in ((u, s), (v, t)):
                        core[k] = np.sign(w) * (half[k] - radius)
                        rest[k] = np.sign(w) * (abs(w) - 1)
                    row.append(at(core + radius * unit(rest)))
                grid.append(row)
            for i in range(len(line) - 1):
                for j in range(len(line) - 1):
                    f = [grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]]
                    faces.append(f if sign > 0 else f[::-1])
    points = np.array(points)
    if turn is not None:
        points = points @ np.asarray(turn).T
    return smooth(name, material, points + np.asarray(centre), faces, 50.0)


def turned(axis, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    m = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    m[a, a], m[a, b], m[b, a], m[b, b] = c, -s, s, c
    return m


def plate(name, material, outline, low, high, axes=(0, 2), up=1):
    """A polygon in a plane made thick along the third axis."""
    p = np.asarray(outline, float)
    n = len(p)
    points = np.zeros((2 * n, 3))
    for k, value in ((0, low), (1, high)):
        points[k * n:(k + 1) * n, axes[0]], points[k * n:(k + 1) * n, axes[1]], points[k * n:(k + 1) * n, up] = p[:, 0], p[:, 1], value
    faces = [list(range(n)), list(range(2 * n - 1, n - 1, -1))] + [[k, n + k, n + (k + 1) % n, (k + 1) % n] for k in range(n)]
    part = smooth(name, material, points, faces, 30)
    return part if volume(part) > 0 else smooth(name, material, points, [f[::-1] for f in faces], 30)


def soft(name, material, points, faces, levels=2, creases=None):
    """A subdivided cage."""
    points, faces, _ = subdivide(points, faces, creases, levels)
    part = smooth(name, material, points, faces, 180)
    return part


def soft_loft(name, material, rings, levels=2):
    """A subdivided closed body through rings of points, closed at both ends by one face."""
    rings = np.asarray(rings, float)
    n, m = rings.shape[:2]
    faces = [[i * m + j, (i + 1) * m + j, (i + 1) * m + (j + 1) % m, i * m + (j + 1) % m] for i in range(n - 1) for j in range(m)]
    faces += [list(range(m)), [(n - 1) * m + j for j in range(m)][::-1]]
    points = rings.reshape(-1, 3)
    part = soft(name, material, points, faces, levels)
    return part if volume(part) > 0 else soft(name, material, points, [f[::-1] for f in faces], levels)


def oriented(part):
    """Turned outwards by its volume."""
    return part if volume(part) >= 0 else part.flipped()
