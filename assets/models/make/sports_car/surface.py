"""Points on the body's surface, for what is mounted on it or lies below it, and rotations towards where it looks."""

import numpy as np

from mesh import DIGITS, unit

# How many points of a surface say how it runs between them.
AROUND = 20
# How near to the middle line they are looked for on both sides of it.
BESIDE = .15


def nearest(skin, at, axes, axis, sign, least):
    """Of the surface that looks along `sign` times an axis: its height along that axis at a point of the two other `axes`, and its normal, by
    a paraboloid through the points around. The half x < 0 is the mirror image."""
    x, other = abs(at[0]), at[1]
    p, looks = skin.points, skin.normals[:, axis] * sign > least
    if x < BESIDE and 0 in axes:
        p, looks = np.concatenate([p, p * (-1, 1, 1)]), np.concatenate([looks, looks])
    du, dv = p[:, axes[0]] - x, p[:, axes[1]] - other
    d = np.hypot(du, dv) + np.where(looks, 0, 9)
    near = np.argsort(np.round(d, DIGITS), kind="stable")[:AROUND]
    reach = d[near[-1]] * 1.05
    w = (1 - (d[near] / reach) ** 2) ** 2
    u, v = du[near] / reach, dv[near] / reach
    terms = np.stack([np.ones(AROUND), u, v, u * u, u * v, v * v], 1)
    fit = np.linalg.lstsq(terms * w[:, None], p[near, axis] * w, rcond=1e-6)[0]
    normal = np.zeros(3)
    normal[axis], normal[axes[0]], normal[axes[1]] = sign, -sign * fit[1] / reach, -sign * fit[2] / reach
    return fit[0], unit(normal) * (1 if at[0] >= 0 else -1, 1, 1)


def on_top(skin, x, z, lift):
    """A point of the upper surface, lifted along its normal."""
    y, n = nearest(skin, (x, z), (0, 2), 1, 1, .25)
    return np.array((x, y, z)) + n * lift


def on_face(skin, x, y, lift, sign):
    """A point of the front (`sign` 1) or the tail (-1), lifted along its normal; and that normal."""
    z, n = nearest(skin, (x, y), (0, 1), 2, sign, .5)
    return np.array((x, y, z)) + n * lift, n


def look_along(direction):
    """A rotation that takes +x to a direction."""
    x = unit(np.asarray(direction, float))
    z = unit(np.cross(x, (0, 1, 0)))
    return np.stack([x, np.cross(z, x), z], 1)
