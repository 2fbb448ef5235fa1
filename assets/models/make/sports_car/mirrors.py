"""The mirrors: a painted cap over a black housing, and a pane in a bezel, on a slender arm."""

import numpy as np

from mesh import smooth
from shapes import disk, oriented, soft_loft, squared, sweep
from shell import pair

# The middle of the pane, and of the rings behind it: how far ahead, half of the width and of the height, how far in and down.
MIDDLE = (1.000, .872, .645)
RINGS = ((0, .106, .047, 0, 0), (.010, .111, .052, 0, 0), (.035, .112, .053, .001, .001), (.085, .106, .046, .006, .003), (.130, .097, .034, .013, .006),
         (.162, .088, .021, .020, .009), (.180, .081, .011, .025, .011), (.187, .074, .004, .029, .012))
# How much further back the pane's outer edge lies, a metre of width, so that it looks at the driver.
TURN = .20
# How many points a ring has; the first half of them lies above.
STEPS = 20
# From the door's upper corner outwards and up into the housing: the middle of each ring, and half as long and as thick.
ARM = (((.800, .782, .700), .027, .0075), ((.826, .792, .699), .025, .0065), ((.862, .803, .697), .024, .006), ((.905, .816, .695), .025, .0065), ((.945, .832, .694), .030, .008),
       ((.965, .846, .694), .034, .010))
# The foot that it stands on, lower and wider by a gap's step: its rings from below the skin up.
FOOT = (((.786, .758, .700), .036, .012), ((.794, .777, .700), .036, .012), ((.797, .7795, .700), .033, .0095), ((.7975, .780, .700), .028, .006))


def ring(ahead, half, high, inwards, down, steps=STEPS):
    u, v = squared(half, high, .55, steps, lean=.22)
    x, y, z = MIDDLE
    return np.stack([x + u - inwards, y + v - down, z + ahead + TURN * -u * (1 - 3 * ahead)], 1)


def shell():
    """The cap is painted from the second ring to the last one, on its upper half; a face of the rings became four."""
    body = soft_loft("mirror", "paint", [ring(*r) for r in RINGS], 1)
    painted = lambda k: STEPS <= k // 4 < (len(RINGS) - 1) * STEPS and k // 4 % STEPS < STEPS // 2
    return [body.only(painted), body.only(lambda k: not painted(k), "gloss_black").moved(name="mirror_housing")]


def pane():
    """The mirror itself, with a bezel."""
    edge = ring(-.001, .092, .041, 0, 0, 28)
    deep = edge + (0, 0, -.0005)
    glass = smooth("mirror_pane", "mirror", deep, [list(range(len(edge)))[::-1]], 30)
    bezel = oriented(sweep("mirror_bezel", "gloss_black", edge, disk(.0060, 8), 60, closed=True))
    return [glass, bezel]


def stalk(name, material, rings):
    out = []
    for (x, y, z), along, thick in rings:
        u, v = squared(along, thick, .8, 12)
        out.append(np.stack([x - .4 * v, y + v, z + u], 1))
    return soft_loft(name, material, out, 1)


def arm():
    """A slender stalk on a foot of rubber."""
    return [stalk("mirror_arm", "gloss_black", ARM), stalk("mirror_foot", "rubber", FOOT)]


def all_parts():
    return [side for part in [*shell(), *pane(), *arm()] for side in pair(part)]
