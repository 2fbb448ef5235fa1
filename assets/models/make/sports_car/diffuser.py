"""Below the rear bumper: its edge, turned in; a dark valance behind that, which closes the tail; the tunnel's floor from its foot ahead, and fins below it."""

import numpy as np

from borders import bend, line, strip
from mesh import joined, smooth, unit
from shapes import oriented
from shell import both

# The rounding of the bumper's edge and how far it is turned in; how far the valance lies behind it.
RADIUS, RETURN, SET_IN = .006, .040, .028
# How the valance's foot is rounded.
FOOT = .012
# The floor: where it ends ahead and its height there, by x, so that it stays clear of the wheels.
AHEAD = ((0, .54, .62, .72), (-1.46, -1.46, -1.74, -1.76), (.124, .124, .150, .160))
# From the valance's foot ahead: parts of the way, and of the fall.
RUN, FALL = (0, .15, .30, .45, .60, .75, .88, 1), (0, .22, .43, .61, .76, .88, .96, 1)
# The fins: their middles, half of their thickness, the height of their foot at the rear, and z and height of where they leave the floor.
FINS, FIN_HALF, FIN_FOOT, FIN_START = (-.345, -.115, .115, .345), .007, .158, (-1.86, .192)


def flat(directions):
    """Without what goes up or down."""
    return unit(directions * (1, 0, 1))


def valance(skin):
    """The panel itself, as the body runs but set in, with openings for the exhausts."""
    part = skin.part("valance", "carbon", {"diffuser"}, offset=-SET_IN)
    return both(part)


def foot(skin):
    """The valance's lower edge."""
    edge = line(skin, {"diffuser"}, None, .03)
    edge.points = edge.points - edge.out * SET_IN
    edge.inner = -edge.inner
    return edge


def floor(edge):
    """From the valance's foot, round, to the floor below the engine."""
    rows = [edge.points - np.array((0, FOOT * np.sin(a), 0)) - flat(edge.out) * FOOT * (1 - np.cos(a)) for a in np.linspace(0, np.pi / 2, 4)]
    start = rows[-1]
    z, y = (np.interp(np.abs(start[:, 0]), AHEAD[0], row) for row in AHEAD[1:])
    for t, fall in zip(RUN[1:], FALL[1:]):
        rows.append(np.stack([start[:, 0], start[:, 1] + (y - start[:, 1]) * fall, start[:, 2] + (z - start[:, 2]) * t], 1))
    part = strip("diffuser", "trim_black", rows, edge.closed)
    down = part if part.normals[part.corners[len(RUN)][0]][1] < 0 else part.flipped()
    return both(down)


def slab(name, material, outline, x, half, round_by=.002):
    """An upright plate with rounded rims; its outline is z and y."""
    p = np.asarray(outline, float)
    n = len(p)
    way = unit(np.roll(p, -1, 0) - p)
    across = np.stack([-way[:, 1], way[:, 0]], 1)
    corner = unit(across + np.roll(across, 1, 0))
    turn = np.sign(((p - p.mean(0)) * corner).sum(1))[:, None]
    small = p - corner * turn * round_by * 1.2
    loops = [np.concatenate([np.full((n, 1), x + a), q[:, ::-1]], 1) for a, q in ((-half, small), (-half + round_by, p), (half - round_by, p), (half, small))]
    faces = [[k * n + i, k * n + (i + 1) % n, (k + 1) * n + (i + 1) % n, (k + 1) * n + i] for k in range(3) for i in range(n)]
    faces += [list(range(n))[::-1], list(range(3 * n, 4 * n))]
    return oriented(smooth(name, material, np.concatenate(loops), faces, 50))


def fin(edge, x):
    """A straight blade below the floor, whose rear edge stands in line with the valance's foot."""
    order = np.argsort(edge.points[:, 0])
    rear, high = (np.interp(abs(x), edge.points[order, 0], edge.points[order, k]) for k in (2, 1))
    top = high - FOOT + .004
    z, y = FIN_START
    outline = [(rear + .004, top), (rear + .004, FIN_FOOT), (z, y), (z, y + .02)]
    return slab("fins", "rim", outline, x, FIN_HALF)


def all_parts(skin):
    edge = line(skin, {"diffuser", "exhaust"}, {"tail_bumper"})
    into = -flat(edge.out)
    lip = both(strip("bumper_return", "paint", bend(edge, into, RADIUS, RETURN), edge.closed, edge.out))
    low = foot(skin)
    return [lip, valance(skin), floor(low), joined("fins", [fin(low, x) for x in FINS])]
