"""What the cage is too coarse for, as movements of a dense surface: flared arches, and the sills that roll under."""

import numpy as np

FRONT_AXLE, REAR_AXLE = 1.325, -1.325
# Of each arch: where its axle is, its height, its radius, how far it flares, how wide the flare runs out, and how much more it is above the wheel and
# behind it, where the body leans in and it runs out wider as well.
FLARES = ((FRONT_AXLE, .337, .366, .030, .21, .65, 0), (REAR_AXLE, .354, .383, .027, .22, 0, .55))


def bump(x):
    """1 at 0, falling to 0 at 1 with even curvature."""
    x = np.clip(np.abs(x), 0, 1)
    return (1 - x * x) ** 3


def step(x):
    """0 to 1, with even curvature at both ends."""
    x = np.clip(x, 0, 1)
    return x ** 3 * (10 + x * (6 * x - 15))


def rocker(y, z):
    """How far the sill is drawn in where it rolls under, between the wheels."""
    return -.035 * step((1.05 - np.abs(z)) / .25) * step((.175 - y) / .070)


# The shoulder behind the rear wheels: its height at a z and how it falls to the rear; how far the flank below it is drawn in; from where that grows
# and how long it does; from where it ends and how long that takes; and the same of how the way out of the body turns from the side to the rear.
SHOULDER, FALLS, TUCK = (-1.36, .806), .066, .012
GROWS, ENDS, TURNS = (-1.36, .42), (-1.90, .20), (-1.55, .60)
# How far below its edge the flank is deepest, and where it is as before.
DEEPEST, BEFORE = .034, .40


def shoulder(y, z):
    """How far the flank is drawn in below the shoulder: soon below its edge, and less and less further down."""
    below = SHOULDER[1] - FALLS * (SHOULDER[0] - z) - y
    far = TUCK * step((GROWS[0] - z) / GROWS[1]) * (1 - step((ENDS[0] - z) / ENDS[1]))
    return -far * step((below + .008) / (DEEPEST + .008)) * (1 - step((below - DEEPEST) / (BEFORE - DEEPEST)))


def sculpt(p):
    x, y, z = p.T
    side = step((x - .62) / .30)
    out = rocker(y, z) * (x > .7)
    for centre, height, radius, flare, wide, above, behind in FLARES:
        r = np.maximum(np.hypot(z - centre, y - height), 1e-9)
        more = 1 + above * np.clip((y - height) / r, 0, 1) ** 2 + behind * np.clip((centre - z) / r, 0, 1) ** 2
        runs = wide * (1 + 1.1 * behind * np.clip((centre - z) / r, 0, 1) ** 2)
        out += side * flare * more * bump((r - radius) / runs) * (.7 + .3 * step((y - .12) / .15))
    p = p.copy()
    p[:, 0] += out
    turn = np.radians(80) * step((TURNS[0] - z) / TURNS[1])
    tuck = shoulder(y, z) * (x > .55)
    p[:, 0] += tuck * np.cos(turn)
    p[:, 2] -= tuck * np.sin(turn)
    return p
