"""The tail: a recess with the lamps, of two rings and a bar behind a red lens, and the name; below it the plate in a bay of the bumper, the outlets at the corners, and the exhausts."""

import numpy as np

from fields import FRONT, Outline, fillet
from letters import text
from mesh import Part, joined, smooth, unit
from panels import BAY, BAY_DEPTH, BAY_FRAME, TAIL_DEPTH, TAIL_FRAME, TAIL_PANEL, VENT, VENT_DEPTH, VENT_FRAME
from shapes import box, disk, lathe, oriented, squared, sweep, tube
from shell import both, pair
from surface import look_along, on_face

# Where the rings are, and their radius.
RINGS = ((.560, .710), (.692, .707))
RADIUS = .046
# How many diodes stand in a ring.
DIODES = 12
# Which way the recess goes, and which way the lamps in it.
INTO, LAMP_INTO = (0, 0, 1), (-.22, 0, 1)
# The number plate: its middle's height, and its size.
PLATE = (.490, .50, .108)
# The pipes of one side: x of each and the z of its end; their height, and half of their width and height.
PIPES, PIPE_HEIGHT, PIPE_SIZE = ((.459, -2.150), (.587, -2.128)), .354, (.056, .046)


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
    inwards = lambda p: -.002 - TAIL_DEPTH * np.clip(-panel(p) / TAIL_FRAME, 0, 1)
    frame = both(skin.part("tail_frame", "gloss_black", {"tail_frame"}, offset=inwards, fold=.01, into=INTO))
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


def slope(outline, wide, deep):
    """How a frame leads from the surface into an opening."""
    hole = Outline(outline, FRONT, .03)
    return lambda p: -.0005 - deep * np.clip(-hole(p) / wide, 0, 1)


def bay(skin):
    """The bay's sides and its floor."""
    return [both(skin.part("bay_frame", "paint", {"bay_frame"}, offset=slope(BAY, BAY_FRAME, BAY_DEPTH), fold=.004, into=INTO)),
            both(skin.part("bay_floor", "gloss_black", {"bay"}, offset=-BAY_DEPTH, into=INTO))]


def number(whole):
    """The plate as the bay's floor leans, on a holder with a rolled edge, and two lamps above it."""
    middle, wide, high = PLATE
    rows = [on_face(whole, 0, middle + y, 0, -1)[0] for y in np.linspace(-.06, .06, 7)]
    up = unit(rows[-1] - rows[0])
    normal = np.array((0, up[2], -up[1]))
    foot = rows[3]
    foot = foot + normal * (max(p @ normal for p in rows) - foot @ normal - BAY_DEPTH + .016)
    place = lambda across, rise, out: foot + across * np.array((1.0, 0, 0)) + rise * up + out * normal
    x, top = wide / 2, high / 2
    points = np.array([place(a, b, 0) for a, b in ((-x, -top), (x, -top), (x, top), (-x, top))])
    board = Part("plate", "plate", points, [[0, 3, 2, 1]], [normal], [[0] * 4], [(1, 0), (0, 0), (0, 1), (1, 1)], [[0, 3, 2, 1]])
    edge = np.array([place(a, b, .001) for a, b in fillet([(-x, -top), (x, -top), (x, top), (-x, top)], .010)])
    holder = oriented(sweep("plate_holder", "trim_black", edge, disk(.0062, 8), 60, closed=True))
    lamps = [box("plate_lamps", "lamp_housing", place(a, top + .016, .006), (.070, .014, .026), .005) for a in (-.11, .11)]
    return [board, holder, joined("plate_lamps", lamps)]


def fog_light(whole):
    """A slim red lens in the middle, between the plate and the diffuser."""
    path = np.array([on_face(whole, x, .3915, .001, -1)[0] for x in np.linspace(-.085, .085, 9)])
    return oriented(sweep("fog_light", "tail_reflector", path, disk(.0085, 10, .62), 60))


def pipe(x, rear):
    """One end of an exhaust: an oval sleeve with a rolled edge, polished outside, dark inside."""
    rows = ((.22, .96), (.024, 1.0), (.007, 1.012), (0, .985), (0, .93), (.006, .87), (.016, .84), (.20, .82))
    loops = []
    for back, wide in rows:
        u, v = squared(PIPE_SIZE[0] * wide, PIPE_SIZE[1] * wide, .8, 36)
        lean = .12 * v * (back < .1)
        loops.append(np.stack([x + u, PIPE_HEIGHT + v, rear + back + lean], 1))
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
    rows = [pipe(*at) for at in PIPES]
    sleeves = joined("exhaust", [row[0] for row in rows])
    inside = joined("exhaust_inside", [part for row in rows for part in row[1:]])
    return pair(sleeves) + pair(inside)


def vents(skin, whole):
    """The outlets at the corners: sides that lead inwards, and three vanes as the bumper runs there."""
    frame = skin.part("vent_frame", "paint", {"vent_frame"}, offset=slope(VENT, VENT_FRAME, VENT_DEPTH), fold=.006, into=INTO)
    section = [(-.014, -.0010), (-.012, -.0035), (.010, -.0030), (.014, .0005), (.010, .0030), (-.012, .0030)]
    hole, vanes = Outline(VENT, FRONT, .03), []
    for y in (.452, .486, .520):
        line = np.array([(x, y + .08 * (x - .79), 0) for x in np.linspace(.68, .90, 111)])
        line = line[hole(line) < -.9 * VENT_FRAME]
        path = np.array([on_face(whole, x, up, -.036, -1)[0] for x, up in line[np.linspace(0, len(line) - 1, 9).astype(int), :2]])
        vanes.append(oriented(sweep("vent_blades", "gloss_black", path, section, 40)))
    return pair(frame) + pair(joined("vent_blades", vanes))


def all_parts(skin, whole):
    return recess(skin) + bay(skin) + [name(whole), stop_light(whole), fog_light(whole)] + number(whole) + exhausts() + lamps(skin, whole) + vents(skin, whole)
