"""What the cage is too coarse for, as movements of a dense surface: flared arches, sills that roll under, and the scoops that lead into the side intakes."""

import numpy as np

FRONT_AXLE, REAR_AXLE = 1.325, -1.325
# Of each arch: where its axle is and how high, its radius, the x at which all of its edge lies, how much less of that there is low behind the wheel, and how
# wide the flare runs out.
FLARES = ((FRONT_AXLE, .329, .374, .990, .004, .26), (REAR_AXLE, .346, .391, .998, .005, .25))
# What of the edge's course follows from the surface around: waves up to so many a turn, seen so near.
WAVES, NEAR = 4, .05
# The scoop: where it begins and is deepest, and how deep; z, and the heights of the shoulder line and of the crease above the sill, between which it lies.
SCOOP_FROM, SCOOP_TO, SCOOP_DEEP = .10, -.66, .066
SCOOP_LINES = ((-.90, -.55, -.20, .10), (.737, .711, .690, .673), (.430, .400, .350, .310))
# How far from these lines its walls begin, above and below, and how wide they are.
SCOOP_TOP, SCOOP_FOOT, SCOOP_WALL = .034, .018, .042
# The opening of the side intake: z of its front and of its rear edge by height. Behind it the surface stands out as a blade; how far, and how far this runs out.
OPENING = ((.42, .70), (-.560, -.618), (-.705, -.815))
BLADE, BLADE_RUN = .017, .24


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


def scoop(y, z):
    """How far the door's rear and what follows it are drawn in, and out again behind the opening."""
    crest, foot = (np.interp(z, SCOOP_LINES[0], line) for line in SCOOP_LINES[1:])
    inside = step((crest - SCOOP_TOP - y) / SCOOP_WALL) * step((y - foot - SCOOP_FOOT) / SCOOP_WALL)
    front, rear = (np.interp(y, OPENING[0], edge) for edge in OPENING[1:])
    deep = step((SCOOP_FROM - z) / (SCOOP_FROM - SCOOP_TO)) * step((z - rear - .040) / (front - rear - .060))
    blade = step((crest - .012 - y) / .10) * step((y - foot + .03) / .10) * bump((z - rear - .02) / np.where(z > rear + .02, .3, BLADE_RUN))
    return blade * BLADE * step((rear + .12 - z) / .08) - inside * deep * SCOOP_DEEP


def flare(p):
    """The surface with the edges of its arches in planes."""
    x, y, z = p.T
    side = step((x - .62) / .30)
    out = np.zeros(len(p))
    for centre, height, radius, edge, less, wide in FLARES:
        r, turn = np.hypot(z - centre, y - height), np.arctan2(y - height, z - centre)
        turn = np.where(turn < -np.pi / 2, turn + 2 * np.pi, turn)
        waves = lambda t: np.stack([f(k * (t - np.pi / 2) / 1.5) for k in range(WAVES) for f in (np.cos, np.sin) if k or f is np.cos], 1)
        near = (np.abs(r - radius) < NEAR) & (x > .85)
        terms = np.concatenate([waves(turn[near]), (r[near] - radius)[:, None] * waves(turn[near])], 1)
        weight = (1 - ((r[near] - radius) / NEAR) ** 2)[:, None]
        fit = np.linalg.lstsq(terms * weight, x[near] * weight[:, 0], rcond=1e-9)[0]
        there = waves(turn) @ fit[:terms.shape[1] // 2]
        goal = edge - less * step((turn - 2.6) / .9)
        out += side * (goal - there) * bump((r - radius) / wide)
    p = p.copy()
    p[:, 0] += out
    return p


def sculpt(p):
    p = flare(p)
    x, y, z = p.T
    out = (rocker(y, z) + scoop(y, z)) * (x > .7)
    turn = np.radians(80) * step((TURNS[0] - z) / TURNS[1])
    tuck = shoulder(y, z) * (x > .55)
    p[:, 0] += out + tuck * np.cos(turn)
    p[:, 2] -= tuck * np.sin(turn)
    return p
