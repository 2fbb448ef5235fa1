"""The land around the road: a meadow behind the wall, a verge on the other side, hills, and mountains far away."""

import numpy as np

from mesh import Part, smooth
from road import sheet


def rise(x, z):
    """Height of the ground behind the wall."""
    away = max(0.0, -x - 4.2)
    return .30 + .055 * away + .5 * np.sin(z * .045 + 1) * min(1, away / 12) + .35 * np.sin(x * .11 + z * .07) * min(1, away / 12)


def ground():
    xs = -np.array((3.6, 5, 7, 10, 14, 20, 28, 38, 52, 70, 95, 130))[::-1]
    zs = np.concatenate([np.linspace(-220, -60, 9), np.linspace(-52, 52, 27), np.linspace(60, 220, 9)])
    behind = sheet("meadow", "grass", xs, zs, rise, .14)
    ahead = sheet("verge", "grass", (9, 14, 30, 120, 300), np.linspace(-220, 220, 12), lambda x, z: -.02 + .0 * x, .14)
    return [behind, ahead]


def ridge(name, material, distance, height, seed, detail):
    """A line of hills as a bent strip with a rounded top. It is lower where the sun of the evening stands, beyond the road."""
    rng = np.random.default_rng(seed)
    turn = np.radians(np.linspace(-5, 365, 260))
    waves = sum(rng.uniform(.3, 1) / k ** detail * np.sin(k * turn * 2 + rng.random() * 6) for k in range(1, 30))
    behind = np.clip(np.sin(turn) + .35, 0, 1)
    top = height * (.62 + .30 * waves) * (.42 + .58 * behind * behind * (3 - 2 * behind))
    top = np.maximum(top, height * .12)
    points, uvs = [], []
    for out, up in ((-.12, 0), (-.06, .45), (-.02, .8), (.02, .96), (.07, 1)):
        for k, a in enumerate(turn):
            d = distance * (1 + out * (1 + .25 * np.sin(k * .7 + seed)))
            points.append((-d * np.sin(a), top[k] * up - 2, d * np.cos(a)))
            uvs.append((k * .09, up))
    m = len(turn)
    faces = [[i * m + j, (i + 1) * m + j, (i + 1) * m + j + 1, i * m + j + 1] for i in range(4) for j in range(m - 1)]
    part = smooth(name, material, points, faces, 80, uvs, faces)
    # Seen from the middle.
    if (part.normals[part.corners[0]].mean(0) @ np.array(part.points[part.faces[0]].mean(0))) > 0:
        part = Part(name, material, part.points, [f[::-1] for f in part.faces], -part.normals, [f[::-1] for f in part.corners], part.uvs, [f[::-1] for f in part.uv_corners])
    return part


def all_parts():
    return ground() + [ridge("hills", "hills", 230, 15, 1, 1.2), ridge("mountains", "mountains", 520, 62, 2, 1.0)]
