"""What the cage is too coarse for, as movements of a dense surface: flared arches, the undercut of the ends, the rockers between the wheels, the
channel that leads into the side intake, ridges on the bonnet and the ramps behind its outlets."""

import numpy as np

FRONT_AXLE, REAR_AXLE = 1.325, -1.325
# Of each arch: where its axle is, its height, its radius, how far it flares, and how wide the flare runs out.
FLARES = ((FRONT_AXLE, .345, .370, .030, .21), (REAR_AXLE, .362, .389, .027, .22))
# The edge where the side intake begins: z by y. How long the channel before it is, and how deep.
LEADING = ((.330, .668), (-.745, -.490))
CHANNEL, DEEP = .46, .030
# The rear edge of a bonnet outlet: z by x. How long the ramp behind it is, and how deep.
OUTLET = ((.14, .25, .35, .45), (1.456, 1.512, 1.558, 1.586))
RAMP, SUNK = .27, .019


def bump(x):
    """1 at 0, falling to 0 at 1 with even curvature."""
    x = np.clip(np.abs(x), 0, 1)
    return (1 - x * x) ** 3


def step(x):
    """0 to 1, with even curvature at both ends."""
    x = np.clip(x, 0, 1)
    return x ** 3 * (10 + x * (6 * x - 15))


def crease(z):
    """The height of the line below which the ends are drawn in."""
    return .235 + .10 * np.clip(np.abs(z) - 1.75, 0, .4)


def undercut(y, z):
    """How far the ends before and behind the wheels are drawn in towards the road, below a crease that rises outwards."""
    ahead, behind = step((z - 1.72) / .10), step((-1.76 - z) / .10)
    return (ahead + behind) * .040 * np.clip((crease(z) - y) / .14, 0, 1) ** .8


def rocker(y, z):
    """How far the flank stands out above the sill, where it rolls under, and is drawn in below; near the wheels, nothing of it is left."""
    along = step((.98 - np.abs(z)) / .30)
    return along * (.010 * bump((y - .235) / .10) - .055 * step((.195 - y) / .085))


def channel(y, z):
    """How deep the flank sinks towards the side intake: most at the edge where that begins, less the further ahead; behind, nothing is left of the flank."""
    ahead = z - np.interp(y, *LEADING)
    along = step((CHANNEL - ahead) / CHANNEL) * step((ahead + .16) / .10)
    floor, roof = .40 + .10 * np.clip(ahead / CHANNEL, 0, 1), .692 - .030 * np.clip(ahead / CHANNEL, 0, 1)
    return DEEP * along * step((y - floor + .05) / .16) * step((roof - y) / .045)


def ramp(x, z):
    """How deep the bonnet sinks behind an outlet: most at its rear edge, and less from there on."""
    behind = np.interp(x, *OUTLET) - z
    across = step((x - .125) / .05) * step((.485 - x) / .05)
    return SUNK * across * step((RAMP - behind) / RAMP) * step((behind + .055) / .03)


def sculpt(p):
    x, y, z = p.T
    side = step((x - .62) / .30)
    out = -undercut(y, z) * step((x - .2) / .3) + (rocker(y, z) - channel(y, z)) * (x > .7)
    for centre, height, radius, flare, wide in FLARES:
        r = np.hypot(z - centre, y - height)
        out += side * flare * bump((r - radius) / wide) * (.7 + .3 * step((y - .12) / .15))
    p = p.copy()
    p[:, 0] += out
    on_top = (z > .98) & (y > .4) & (x < .6)
    ridge = bump((x - (.29 + .07 * (z - 1))) / .17) * step((2.26 - z) / .45) * step((z - 1.04) / .30)
    p[:, 1] += np.where(on_top, .016 * ridge - ramp(x, z), 0)
    return p
