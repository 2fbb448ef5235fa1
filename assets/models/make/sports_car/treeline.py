"""The edge of a wood beyond the meadow: strips that show a drawn line of crowns, one behind another."""

import numpy as np

from land import rise
from mesh import Part, unit

# Of each strip: how far away it stands, its height, how much of the picture is skipped, and how long the picture is on it.
STRIPS = ((57, 5.5, .13, 27), (63, 8.5, .57, 41), (70, 11.5, .31, 53))


def strip(away, height, skip, long):
    z = np.arange(-220.0, 221, 4)
    x = -away - 5 * np.sin(z * .03 + 2)
    foot = np.array([rise(a, b) for a, b in zip(x, z)]) - .5
    # Here and there it is lower, and one sees the hills.
    tall = height * (1 + .22 * np.sin(z * .11 + away)) * (1 - .6 * np.exp(-((z + 62) / 16) ** 2)) * (1 - .5 * np.exp(-((z - 48) / 12) ** 2))
    points = np.concatenate([np.stack([x, foot, z], 1), np.stack([x - .1 * tall, foot + tall, z], 1)])
    # Short of the upper edge, beyond which the picture begins again with the ground.
    uvs = [(b / long + skip, v) for v in (.01, .96) for b in z]
    n = len(z)
    faces = [[k + 1, k, n + k, n + k + 1] for k in range(n - 1)]
    lean = np.sin(z * .5 + away) * .5
    normals = unit(np.stack([np.ones(n), .5 + 0 * z, lean], 1))
    return Part("wood", "wood", points, faces, np.concatenate([normals, normals]), faces, uvs, faces)


def all_parts():
    return [strip(*s) for s in STRIPS]
