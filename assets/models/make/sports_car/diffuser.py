"""The diffuser: below the bumper a floor that rises towards the tail and ends in a rolled lip, and strakes under it."""

import numpy as np

from mesh import joined, smooth
from shapes import soft_loft
from shell import both

# The floor's run: z and y, from below the engine to the lip and back above it.
RUN = ((-1.50, .124), (-1.64, .130), (-1.78, .148), (-1.90, .178), (-2.00, .214), (-2.08, .250), (-2.122, .272), (-2.138, .286), (-2.137, .297), (-2.120, .303), (-2.04, .306))
# How far ahead the tail lies at x, as it runs round to the corner; and half of the floor's width.
CORNER = ((0, .25, .40, .55, .66, .745), (0, .002, .014, .036, .078, .132))
HALF = .745
STRAKES = (.115, .345, .565)


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


def strake(x):
    """A blade below the floor, whose foot runs level and sweeps up to the lip."""
    shift = ahead(x)
    rings = []
    for z, low in ((-1.60, .122), (-1.72, .117), (-1.85, .118), (-1.96, .122), (-2.04, .134), (-2.095, .162), (-2.122, .205), (-2.134, .262)):
        late = np.clip((-1.75 - z) / .3, 0, 1)
        top = np.interp(-z, [-a for a, _ in RUN[:8]], [b for _, b in RUN[:8]]) + .006
        w = .0075
        rings.append([(x - w, top, z + late * shift), (x + w, top, z + late * shift), (x + w, low + .012, z + late * shift), (x + w * .7, low, z + late * shift),
                      (x - w * .7, low, z + late * shift), (x - w, low + .012, z + late * shift)])
    return soft_loft("strakes", "trim_black", rings, 1)


def end(x):
    """The plate that closes the floor at a side, down to the road's height and up to the bumper."""
    rings = []
    for z, low, high in ((-1.52, .120, .150), (-1.70, .122, .180), (-1.84, .138, .205), (-1.91, .160, .222), (-1.95, .185, .236), (-1.965, .205, .240)):
        rings.append([(x - .008, high, z), (x + .008, high, z), (x + .008, low, z), (x - .008, low, z)])
    return soft_loft("strakes", "trim_black", rings, 1)


def back(skin):
    """The dark panel between the lip and the bumper, from which the pipes come."""
    return both(skin.part("tail_cavity", "trim_black", {"diffuser"}, shift=lambda p, n: p * (.97, 1, 1) + (0, -.03, .075)))


def all_parts(skin):
    strakes = [strake(s * x) for x in STRAKES for s in (-1, 1)] + [end(s * HALF) for s in (-1, 1)]
    walls = both(skin.part("diffuser_walls", "gloss_black", {"diffuser"}, fold=.070, lip=.003, walls=True))
    return [floor(), joined("strakes", strakes), walls, back(skin)]
