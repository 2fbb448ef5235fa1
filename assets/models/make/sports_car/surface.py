"""Points on the body's surface, for what is mounted on it or lies below it, and rotations towards where it looks."""

import numpy as np

from mesh import unit


def nearest(skin, at, axes, axis, sign, least):
    """Of the surface that looks along `sign` times an axis: its height along that axis at a point of the two other `axes`, and its normal.
    The half x < 0 is the mirror image."""
    x, other = abs(at[0]), at[1]
    p = skin.points
    d = np.hypot(p[:, axes[0]] - x, p[:, axes[1]] - other) + np.where(skin.normals[:, axis] * sign > least, 0, 9)
    near = np.argsort(d)[:6]
    w = 1 / (d[near] ** 2 + 1e-6)
    w = w / w.sum()
    q, n = w @ p[near], unit(w @ skin.normals[near])
    return q[axis] - (n[axes[0]] * (x - q[axes[0]]) + n[axes[1]] * (other - q[axes[1]])) / n[axis], n * (1 if at[0] >= 0 else -1, 1, 1)


def on_top(skin, x, z, lift):
    """A point of the upper surface, lifted along its normal."""
    y, n = nearest(skin, (x, z), (0, 2), 1, 1, .25)
    return np.array((x, y, z)) + n * lift


def on_face(skin, x, y, lift, sign):
    """A point of the front (`sign` 1) or the tail (-1), lifted along its normal; and that normal."""
    z, n = nearest(skin, (x, y), (0, 1), 2, sign, .5)
    return np.array((x, y, z)) + n * lift, n


def on_side(skin, z, y, lift):
    """A point of the flank, lifted along its normal."""
    x, n = nearest(skin, (y, z), (1, 2), 0, 1, .3)
    return np.array((x, y, z)) + n * lift


def look_along(direction):
    """A rotation that takes +x to a direction."""
    x = unit(np.asarray(direction, float))
    z = unit(np.cross(x, (0, 1, 0)))
    return np.stack([x, np.cross(z, x), z], 1)
