"""Below and around the body: wheel wells and floor."""

import numpy as np

from mesh import smooth
from panels import ARCHES
from shapes import plate
from shell import pair


def wells():
    out = []
    for k, (z, y, r) in enumerate(ARCHES):
        a = np.radians(np.linspace(-33, 213, 32))
        ring = [(y + (r + .003) * np.sin(t), z + (r + .003) * np.cos(t)) for t in a]
        points, faces = [], []
        for x in (.86, .58):
            points += [(x, yy, zz) for yy, zz in ring]
        n = len(ring)
        faces = [[j, n + j, n + j + 1, j + 1] for j in range(n - 1)]
        back = list(range(n, 2 * n))
        liner = smooth("well", "liner", points, faces + [back], 40)
        # Seen from inside: normals towards the axle.
        inward = liner.points[liner.faces[5]].mean(0) - (0, y, z)
        n0 = liner.normals[liner.corners[5][0]]
        if n0[1] * inward[1] + n0[2] * inward[2] > 0:
            liner = liner.flipped()
        out += pair(liner.moved(name="well_front" if k == 0 else "well_rear"))
    return out


def floor_width(z):
    w = np.interp(z, [-1.60, -.92, -.88, .90, .94, 1.72, 1.74, 1.95, 2.2, 2.30], [.56, .56, .86, .86, .56, .56, .86, .80, .45, .15])
    return w


def floor():
    z = np.array([-1.60, -.92, -.88, 0, .90, .94, 1.72, 1.74, 1.95, 2.2, 2.30])
    w = floor_width(z)
    outline = [(a, b) for a, b in zip(w, z)] + [(-a, b) for a, b in zip(w[::-1], z[::-1])]
    return [plate("floor", "underbody", outline, .112, .122)]


def all_parts():
    return wells() + floor()
