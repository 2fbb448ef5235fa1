"""The number plate in its pocket: a rounded edge, even walls, a dark back, the plate on a bracket, and a lamp above it."""

import numpy as np

from borders import bend, line, strip
from fields import fillet
from mesh import Part, unit
from panels import POCKET
from shapes import box, oriented, plate
from shell import both
from surface import on_face

# The rounding of its edge, and how deep it is.
RADIUS, DEEP = .007, .038
# The number plate: its middle's height, its size, and how far it lies below the tail's surface.
PLATE, BELOW = (.481, .50, .104), .016
# How much wider its bracket is, and how that is rounded.
BRACKET, CORNER = .005, .010
# The lamp above it: its height and size.
LAMP, LAMP_SIZE = .554, (.130, .012, .022)
INTO = np.array((0, 0, 1.0))


class Back:
    """The plane-like surface through the pocket's upper and lower edges, which runs round as the tail does."""

    def __init__(self, whole):
        heights = np.array(POCKET)[:, 1]
        self.low, self.high = heights.min(), heights.max()
        self.x = np.linspace(0, .32, 9)
        self.z = [[on_face(whole, x, y, 0, -1)[0][2] for x in self.x] for y in (self.low, self.high)]

    def __call__(self, p):
        """The z of the tail there, were it straight from the lower to the upper edge."""
        t = (p[:, 1] - self.low) / (self.high - self.low)
        a, b = (np.interp(np.abs(p[:, 0]), self.x, z) for z in self.z)
        return a + (b - a) * t


def walls(skin, tail):
    edge = line(skin, {"pocket"}, {"tail_bumper"})
    rows = bend(edge, INTO, RADIUS, DEEP)
    rows[-1][:, 2] = tail(rows[-1]) + DEEP
    floor = lambda p, n: np.stack([p[:, 0], p[:, 1], tail(p) + DEEP], 1)
    back = skin.part("pocket_back", "trim_black", {"pocket"}, shift=floor)
    return [both(strip("pocket", "paint", rows, edge.closed, edge.out)), both(back)]


def number(tail):
    """The plate on its bracket, which leans as the pocket does."""
    middle, wide, high = PLATE
    at = lambda y: np.array((0, y, tail(np.array([(0, y, 0)]))[0] + BELOW))
    up = unit(at(middle + .05) - at(middle - .05))
    normal = np.array((0, up[2], -up[1]))
    turn, foot = np.stack([(-1.0, 0, 0), up, normal], 1), at(middle)
    x, top = wide / 2, high / 2
    corners = [(-x, -top), (x, -top), (x, top), (-x, top)]
    points = np.array([foot + a * np.array((1.0, 0, 0)) + b * up for a, b in corners])
    board = Part("plate", "plate", points, [[0, 3, 2, 1]], [normal], [[0] * 4], [(1, 0), (0, 0), (0, 1), (1, 1)], [[0, 3, 2, 1]])
    outline = fillet([(a + np.sign(a) * BRACKET, b + np.sign(b) * BRACKET) for a, b in corners], CORNER)
    bracket = plate("plate_bracket", "gloss_black", outline, -.012, -.001, (0, 1), 2)
    feet = box("plate_feet", "trim_black", (0, 0, -.020), (.36, .04, .020), .003)
    return [board, oriented(bracket.moved(turn, foot)), feet.moved(turn, foot)]


def lamp(tail):
    z = tail(np.array([(0, LAMP, 0)]))[0] + DEEP - LAMP_SIZE[2] / 2 - .004
    housing = np.array(LAMP_SIZE) + (.012, .004, .006)
    return [box("plate_lamp_housing", "gloss_black", (0, LAMP + .004, z + .004), housing, .003, 2), box("plate_lamp", "lamp_glow", (0, LAMP - .001, z - .001), LAMP_SIZE, .003, 2)]


def all_parts(skin, whole):
    tail = Back(whole)
    return walls(skin, tail) + number(tail) + lamp(tail)
