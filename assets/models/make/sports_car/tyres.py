"""Tyres: sidewalls that bulge over the rim, with a rib that guards it and the maker's name; a tread of five ribs, cut across by slots."""

import numpy as np

from letters import text
from mesh import joined
from shapes import lathe

# How many slots go round, and where a slot begins, is deepest and ends, as parts of the way to the next.
PITCH = 36
SLOT = (0, .03, .11, .14)
# Grooves round the tread: where, as part of half the width; half as wide, and as deep.
GROOVES, WIDE, DEEP = (.62, .21, -.21, -.62), .0048, .0065
# How many steps the sidewalls are turned in.
STEPS = 64


def sidewall(half, radius, rim):
    """x and radius from the bead to the shoulder."""
    h, r = half, radius
    return [(h - .018, rim - .008), (h - .006, rim - .003), (h + .001, rim + .001), (h + .0062, rim + .005), (h + .0078, rim + .009), (h + .0066, rim + .013), (h + .0045, rim + .0155),
            (h + .0085, rim + .024), (h + .0122, rim + .036), (h + .0134, rim + .047), (h + .0126, r - .0285), (h + .0132, r - .0270), (h + .0128, r - .0235), (h + .0100, r - .0220),
            (h + .0062, r - .0165)]


def tread(half, radius):
    """x and radius from the outer shoulder to the inner one."""
    h, r = half, radius
    shoulder = [(h + .0062, r - .0165), (h + .0005, r - .0098), (h - .008, r - .0052), (h - .018, r - .0026)]
    out = list(shoulder)
    for g in GROOVES:
        x = h * g
        low = .0006 if abs(g) > .5 else 0
        out += [(x + WIDE, r - low), (x + WIDE - .0015, r - DEEP), (x - WIDE + .0015, r - DEEP), (x - WIDE, r - low)]
    return out + [(-x, y) for x, y in shoulder[::-1]]


def turns():
    return np.concatenate([(k + np.array(SLOT)) * 2 * np.pi / PITCH for k in range(PITCH)])


def cut(half, radius):
    """Slots across both shoulders, and short ones into the ribs beside the middle one; they lean as the wheel turns."""
    place = np.tile(np.arange(len(SLOT)), PITCH)
    inside = (place == 1) | (place == 2)

    def bend(x, r, turn):
        # Towards the sidewall they run out.
        shoulder = (np.abs(x) > half * .66) * np.interp(r, (radius - .0105, radius - .0050), (0, 1))
        rib = (np.abs(np.abs(x) - half * .42) < half * .16) & (r > radius - .003)
        return x, r - np.where(inside, .0035 * shoulder + .0028 * rib, 0)

    return bend


def tyre(half, radius, rim):
    side = sidewall(half, radius, rim)
    inner = [(-x, y) for x, y in side[::-1] if y < rim or y > rim + .015]
    parts = [lathe("tyre", "tyre", tread(half, radius), turns(), 32, bend=cut(half, radius)), lathe("tyre", "tyre", side, STEPS, 32), lathe("tyre", "tyre", inner, STEPS // 2, 32)]
    return joined("tyre", [part if outwards(part) else part.flipped() for part in parts])


def outwards(part):
    """Whether a turned surface looks away from its axle, on the whole."""
    n = np.array([part.normals[c].mean(0) for c in part.corners])
    p = np.array([part.points[f].mean(0) for f in part.faces])
    return (n[:, 1:] * p[:, 1:]).sum() > 0


def lettering(half, radius, rim, side):
    """The maker's name, twice round the outer sidewall; `side` -1 writes it backwards, for a wheel that is mirrored."""
    wall = np.array(sidewall(half, radius, rim)[6:12])
    middle, height = rim + .0345, .019
    words = []
    for start in (.5 * np.pi, 1.5 * np.pi):
        def place(across, up, out):
            turn = start + side * across / middle
            return np.interp(middle + up, wall[:, 1], wall[:, 0]) - .0012 + out, (middle + up) * np.sin(turn), (middle + up) * np.cos(turn)
        words.append(text("tyre_letters", "tyre_letters", "LUCERNA", height, .0024, place, .2, .5))
    return joined("tyre_letters", words)


def settled(part):
    """A tyre that the car's weight presses flat on the road, and out at its sides."""
    part = part.copy()
    x, y = part.points[:, 0], part.points[:, 1]
    middle = (x.min() + x.max()) / 2
    low = np.clip((.105 - y) / .105, 0, 1) ** 2
    part.points[:, 0] += np.sign(x - middle) * .016 * low * (np.abs(x - middle) > .09)
    part.points[:, 1] = np.maximum(y, .0004 + .012 * np.maximum(y + .008, 0))
    return part
