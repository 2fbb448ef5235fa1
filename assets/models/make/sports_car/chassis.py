"""Below and around the body: wheel wells, floor, wipers."""

import numpy as np

from mesh import joined, smooth
from panels import ARCHES
from shapes import lathe, oriented, plate, sweep
from shell import pair
from surface import on_top


def wells():
    out = []
    for k, (z, y, r) in enumerate(ARCHES):
        a = np.radians(np.linspace(-33, 213, 32))
        ring = [(y + (r + .003) * np.sin(t), z + (r + .003) * np.cos(t)) for t in a]
        points, faces = [], []
        for x in (.945, .58):
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


def wipers(skin):
    """Two arms with blades at rest along the foot of the windscreen."""
    parts = []
    for pivot, tip in (((.30, 1.112), (-.10, 1.055)), ((-.16, 1.132), (-.475, .955))):
        arm = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t, .012 + .012 * np.sin(np.pi * t)) for t in np.linspace(0, .62, 6)]
        blade = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t - .004, .010) for t in np.linspace(.12, 1.12, 14)]
        rubber = [b - np.array((0, .004, 0)) for b in blade]
        parts.append(sweep("wiper", "trim_black", arm, [(-.009, -.004), (.009, -.004), (.007, .004), (-.007, .004)], 30))
        parts.append(sweep("wiper", "trim_black", blade, [(-.005, -.006), (.005, -.006), (.003, .006), (-.003, .006)], 30))
        knob = lathe("wiper", "trim_black", [(-.02, .015), (.010, .015), (.015, .011), (.015, 0)], 20, 40)
        m = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
        parts.append(oriented(knob).moved(m, on_top(skin, pivot[0], pivot[1], 0)))
    return [joined("wipers", parts)]


def all_parts(skin):
    return wells() + floor() + wipers(skin)
