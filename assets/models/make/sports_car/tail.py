"""The tail: a recess with the lamps, of two rings and a bar behind a red lens, and the name; below it the plate and the exhausts, in the dark of the bumper's opening."""

import numpy as np

from fields import FRONT, Outline
from letters import text
from mesh import Part, joined, smooth, unit
from panels import TAIL_DEPTH, TAIL_FRAME, TAIL_PANEL
from shapes import box, disk, lathe, oriented, plate, squared, sweep, tube
from shell import both, pair
from surface import look_along, on_face

# Where the rings are, and their radius.
RINGS = ((.560, .710), (.692, .707))
RADIUS = .046
# How many diodes stand in a ring.
DIODES = 12
# Which way the recess goes, and which way the lamps in it.
INTO, LAMP_INTO = (0, 0, 1), (-.22, 0, 1)
# The number plate: its middle's height and z, and its size.
PLATE = (.418, -2.150, .50, .112)
# The pipes of one side: x of each, their height, the z of their ends, and half of their width and height.
PIPES, PIPE_HEIGHT, PIPE_END, PIPE_SIZE = (.400, .528), .392, -2.135, (.056, .046)


def on_tail(skin, x, y, depth):
    """A point as deep below the surface, and the way out of it."""
    point, _ = on_face(skin, x, y, 0, -1)
    into = unit(np.array(LAMP_INTO if abs(x) > .4 else INTO) * (np.sign(x), 1, 1))
    return point + into * depth, -into


def rings(whole):
    """Of each ring: a dish, a ring of light in it set with diodes, and a small dome."""
    dishes, lights, domes, diodes = [], [], [], []
    for x, y in RINGS:
        centre, normal = on_tail(whole, x, y, TAIL_DEPTH + .028)
        behind = look_along(normal)
        r = RADIUS
        dish = [(-.034, 0), (-.034, r * .28), (-.030, r * .36), (-.020, r * .72), (-.004, r * .93), (.008, r), (.011, r * 1.06), (.008, r * 1.12), (-.03, r * 1.12)]
        dishes.append(lathe("tail_dishes", "tail_reflector", dish[::-1], 28, 40).moved(behind, centre))
        turn = np.arange(28) * 2 * np.pi / 28
        ring = np.stack([0 * turn + .002, r * .80 * np.cos(turn), r * .80 * np.sin(turn)], 1)
        lights.append(oriented(tube("tail_rings", "tail_light", ring, .0068, 8, closed=True)).moved(behind, centre))
        for a in np.arange(DIODES) * 2 * np.pi / DIODES:
            cup = [(-.016 + .006 * np.cos(b), .0052 * np.sin(b)) for b in np.linspace(np.pi / 2, 0, 3)]
            at = centre + behind @ (0, r * .55 * np.cos(a), r * .55 * np.sin(a))
            diodes.append(oriented(lathe("tail_diodes", "lamp_glow", cup, 8, 60)).moved(behind, at))
        dome = [(-.034 + .022 * np.cos(a), r * .30 * np.sin(a)) for a in np.linspace(np.pi / 2, 0, 4)]
        domes.append(oriented(lathe("tail_domes", "chrome", dome, 16, 60)).moved(behind, centre))
    return [joined(row[0].name, row) for row in (dishes, lights, domes, diodes)]


def bar(whole):
    """A line of light below the lamp's upper edge, and along its outer one."""
    corners = ((.445, .770), (.54, .769), (.62, .766), (.70, .754), (.762, .742), (.776, .733), (.780, .722), (.772, .690))
    path = np.array([on_tail(whole, x, y, TAIL_DEPTH + .014)[0] for x, y in corners])
    return [oriented(sweep("tail_bar", "tail_light", path, disk(.0048, 8), 60))]


def lamps(skin, whole):
    lens = skin.part("tail_lens", "tail_lens", {"tail_lamp"}, offset=-.016, fold=.026, lip=.004, into=LAMP_INTO)
    rim = skin.part("tail_lamp_walls", "gloss_black", {"tail_lamp"}, offset=-TAIL_DEPTH, fold=.075, lip=.004, walls=True, into=LAMP_INTO)
    back = skin.part("tail_lamp_back", "lamp_housing", {"tail_lamp"}, offset=-TAIL_DEPTH - .075, into=LAMP_INTO)
    out = []
    for part in [lens, rim, back] + rings(whole) + bar(whole):
        out += pair(part)
    return out


def recess(skin):
    """The slope from the body to what lies deeper, the walls below it, and darkness."""
    panel = Outline(TAIL_PANEL, FRONT, .02)
    slope = lambda p: -.002 - TAIL_DEPTH * np.clip(-panel(p) / TAIL_FRAME, 0, 1)
    frame = both(skin.part("tail_frame", "gloss_black", {"tail_frame"}, offset=slope, fold=.01, into=INTO))
    walls = both(skin.part("tail_walls", "gloss_black", {"tail_panel", "tail_lamp"}, offset=-TAIL_DEPTH, fold=.04, lip=.003, walls=True, into=INTO))
    return [frame, walls, box("tail_back", "gap_black", (0, .71, -1.955), (1.34, .18, .02), .005, 1)]


def name(whole):
    """Letters of chrome before the mesh between the lamps."""
    place = lambda across, up, out: on_tail(whole, -across, .722 + up, TAIL_DEPTH - out)[0]
    return text("name", "badge", "LUCERNA", .048, .012, place, .16, .44)


def stop_light(whole):
    """A third one, under the lip."""
    path = np.array([on_tail(whole, x, .858, .001)[0] for x in np.linspace(-.17, .17, 9)])
    return oriented(sweep("stop_light", "tail_reflector", path, disk(.009, 8, .6), 60))


def number():
    """The plate on a black holder, with a lamp above it."""
    y, z, wide, high = PLATE
    x, top = wide / 2, high / 2
    points = np.array([(-x, -top, 0), (x, -top, 0), (x, top, 0), (-x, top, 0)]) + (0, y, z)
    board = Part("plate", "plate", points, [[0, 3, 2, 1]], [(0, 0, -1)], [[0] * 4], [(1, 0), (0, 0), (0, 1), (1, 1)], [[0, 3, 2, 1]])
    return [board, box("plate_holder", "trim_black", (0, y, z + .011), (wide + .022, high + .022, .020), .006),
            box("plate_lamps", "trim_black", (0, y + top + .014, z + .004), (.30, .014, .040), .005)]


def cavity():
    """What closes the bumper's opening behind plate and pipes."""
    return plate("tail_cavity", "trim_black", [(.26, -2.02), (.52, -2.02), (.52, -2.01), (.26, -2.01)], -.68, .68, axes=(1, 2), up=0)


def pipe(x):
    """One end of an exhaust: an oval sleeve with a rolled edge, polished outside, dark inside."""
    rows = ((.22, .96), (.024, 1.0), (.007, 1.012), (0, .985), (0, .93), (.006, .87), (.016, .84), (.20, .82))
    loops = []
    for back, wide in rows:
        u, v = squared(PIPE_SIZE[0] * wide, PIPE_SIZE[1] * wide, .8, 36)
        lean = .12 * v * (back < .1)
        loops.append(np.stack([x + u, PIPE_HEIGHT + v, PIPE_END + back + lean], 1))
    n = len(loops[0])
    faces = [[i * n + k, (i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n] for i in range(len(rows) - 1) for k in range(n)]
    points = np.concatenate(loops)
    outside = lambda k: k < 6 * n
    sleeve = smooth("exhaust", "exhaust", points, faces, 40)
    middle = points[:n].mean(0)
    if (points[faces[0]].mean(0) - middle) @ sleeve.normals[sleeve.corners[0][0]] < 0:
        sleeve = sleeve.flipped()
    end = smooth("exhaust_inside", "gap_black", points[-n:], [list(range(n))], 40)
    end = end if end.normals[0][2] < 0 else end.flipped()
    return [sleeve.only(outside), sleeve.moved(name="exhaust_inside").only(lambda k: not outside(k), "gap_black"), end]


def exhausts():
    rows = [pipe(x) for x in PIPES]
    sleeves = joined("exhaust", [row[0] for row in rows])
    inside = joined("exhaust_inside", [part for row in rows for part in row[1:]])
    return pair(sleeves) + pair(inside)


def vent_blades(whole):
    """Three blades across the outlet at each corner, as the bumper runs there."""
    rows = []
    for y in (.452, .486, .520):
        path = np.array([on_face(whole, x, y + .08 * (x - .79), -.012, -1)[0] for x in np.linspace(.705, .875, 9)])
        rows.append(oriented(sweep("vent_blades", "gloss_black", path, squared_section(.004, .013), 40)))
    return joined("vent_blades", rows)


def squared_section(high, deep):
    return [(-high, -deep), (high, -deep), (high, deep), (-high, deep)]


def all_parts(skin, whole):
    walls = both(skin.part("diffuser_walls", "trim_black", {"diffuser"}, fold=.10, lip=.004, walls=True))
    return recess(skin) + [name(whole), stop_light(whole), cavity(), walls] + number() + exhausts() + lamps(skin, whole) + pair(vent_blades(whole))
