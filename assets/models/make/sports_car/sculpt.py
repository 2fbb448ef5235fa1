"""What the cage is too coarse for, as movements of a dense surface: flared arches, and the sills that roll under."""

import numpy as np

FRONT_AXLE, REAR_AXLE = 1.325, -1.325
# Of each arch: where its axle is, its height, its radius, how far it flares, how wide the flare runs out, and how much more it is above the wheel and
# behind it, where the body leans in.
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


def sculpt(p):
    x, y, z = p.T
    side = step((x - .62) / .30)
    out = rocker(y, z) * (x > .7)
    for centre, height, radius, flare, wide, above, behind in FLARES:
        r = np.maximum(np.hypot(z - centre, y - height), 1e-9)
        more = 1 + above * np.clip((y - height) / r, 0, 1) ** 2 + behind * np.clip((centre - z) / r, 0, 1) ** 2
        out += side * flare * more * bump((r - radius) / wide) * (.7 + .3 * step((y - .12) / .15))
    p = p.copy()
    p[:, 0] += out
    return p
