"""The diffuser: below the bumper a floor that rises towards the tail and ends in a rolled lip, and upright fins between that and the bumper."""

import numpy as np

from mesh import joined, smooth
from shapes import box
from shell import both

# The floor's run: z and y, from below the engine to the lip and back above it.
RUN = ((-1.50, .124), (-1.64, .130), (-1.78, .148), (-1.90, .178), (-2.00, .214), (-2.08, .250), (-2.102, .266), (-2.114, .278), (-2.113, .289), (-2.098, .295), (-2.02, .298))
# How far ahead the tail lies at x, as it runs round to the corner; and half of the floor's width.
CORNER = ((0, .25, .40, .55, .66, .745), (0, .016, .042, .082, .128, .19))
HALF = .745
FINS = (-.290, -.215, -.140, .140, .215, .290)
# Of a fin: its size, where it ends in the middle of the car, and the height of its middle.
FIN, FIN_REAR, FIN_MIDDLE = (.008, .130, .100), -2.100, .350


def ahead(x):
    return np.interp(np.abs(x), *CORNER)


def floor():
    xs = np.linspace(-HALF, HALF, 31)
    run = np.array(RUN)
    late = np.clip((-1.75 - run[:, 0]) / .3, 0, 1)
    points = [(x, y, z + b * ahead(x)) for x in xs for (z, y), b in zip(run, late)]
    m = len(run)
    faces = [[i * m + k, i * m + k + 1, (i + 1) * m + k + 1, (i + 1) * m + k] for i in range(len(xs) - 1) for k in range(m - 1)]
    part = smooth("diffuser", "trim_black", points, faces, 60)
    low = part.normals[part.corners[0][0]]
    return part if low[1] < 0 else part.flipped()


def fin(x):
    """An upright blade between the lip and the bumper."""
    rear = FIN_REAR + ahead(x)
    return box("fins", "rim", (x, FIN_MIDDLE, rear + FIN[2] / 2), FIN, .003)


def back(skin):
    """The dark panel between the lip and the bumper, from which the pipes come."""
    return both(skin.part("tail_cavity", "trim_black", {"diffuser"}, shift=lambda p, n: p * (.97, 1, 1) + (0, -.03, .075)))


def all_parts(skin):
    walls = both(skin.part("diffuser_walls", "gap_black", {"diffuser"}, fold=.070, lip=.002, walls=True))
    return [floor(), joined("fins", [fin(x) for x in FINS]), walls, back(skin)]
