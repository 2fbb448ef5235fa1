"""The tail: one slim band of lights behind a red lens, the name below it, the number plate on the bumper, reflectors beside it, and the exhausts."""

import numpy as np

from fields import fillet
from letters import text
from mesh import Part, joined, smooth, unit
from panels import LAMP_DEPTH, LIP
from shapes import box, oriented, plate, squared, sweep
from shell import both, pair
from surface import on_face

# Which way the band's walls go.
INTO = (0, 0, 1)
# The lights: how deep they lie behind the lens, their height, how far they reach to the side, half of one's height, and how thick it is.
BEHIND, LEVEL, REACH, TALL, THICK = .026, .747, .758, .013, .005
# How many there are, and what part of the way to the next one is lit.
LIGHTS, LIT = 44, .72
# The number plate: its middle's height, and its size.
PLATE = (.490, .50, .108)
# The height of the name.
NAME = .654
# The pipes of one side: x of each and the z of its end; their height, and half of their width and height.
PIPES, PIPE_HEIGHT, PIPE_SIZE = ((.400, -2.116), (.506, -2.090)), .350, (.047, .041)
# Of the dark bezel around both: its middle, half of its width and height, and from where to where it goes at each end in x.
BEZEL, BEZEL_RUN = (.453, .112, .052), (-1.98, -2.070)
# A reflector: its height, from where to where it goes, half as high, and how far it stands out.
REFLECTOR, REFLECTOR_RUN, REFLECTOR_SIZE = .462, (.585, .700), (.0085, .004)
# The reversing lamp above the diffuser: its middle, half of its width and height.
REVERSE = (.346, -2.062, .075, .016)


def lights(whole):
    """A row of small flat lights, as the tail runs."""
    xs = np.linspace(-REACH, REACH, 2 * LIGHTS + 1)
    path = np.array([on_face(whole, x, LEVEL - .008 * (x / REACH) ** 2, 0, -1)[0] + (0, 0, BEHIND) for x in xs])
    path[1:-1] = (path[:-2] + 2 * path[1:-1] + path[2:]) / 4
    section = [(-THICK, -TALL), (THICK, -TALL), (THICK, TALL), (-THICK, TALL)]
    row = []
    for a, b, c in zip(path[:-2:2], path[1:-1:2], path[2::2]):
        row.append(oriented(sweep("tail_strip", "tail_light", b + np.stack([(a - c), 0 * a, (c - a)]) * LIT / 2, section, 30)))
    return joined("tail_strip", row)


def lamp(skin, whole):
    lens = skin.part("tail_lens", "tail_lens", {"tail_lamp"}, offset=-.001, fold=.010, lip=LIP)
    walls = skin.part("tail_lamp_walls", "gloss_black", {"tail_lamp"}, offset=-.012, fold=LAMP_DEPTH, lip=LIP, walls=True, into=INTO)
    back = skin.part("tail_lamp_back", "gloss_black", {"tail_lamp"}, shift=lambda p, n: p + np.array(INTO) * LAMP_DEPTH)
    return [both(lens), both(walls), both(back), lights(whole)]


def name(whole):
    """Letters of chrome below the band, which stand on the tail as it runs across, and lean as it does in the middle."""
    across = np.linspace(-.32, .32, 33)
    line = np.array([on_face(whole, x, NAME, 0, -1)[0] for x in across])
    up = unit(on_face(whole, 0, NAME + .03, 0, -1)[0] - on_face(whole, 0, NAME - .03, 0, -1)[0])
    normal = np.array((0, up[2], -up[1]))
    place = lambda right, high, out: np.array((-right, NAME, np.interp(-right, across, line[:, 2]))) + high * up + out * normal
    return text("name", "badge", "LUCERNA", .050, .006, place, .16, .44)


def number(whole):
    """The plate on a thin dark holder, which stands on the bumper as that leans."""
    middle, wide, high = PLATE
    rows = [on_face(whole, 0, middle + y, 0, -1)[0] for y in np.linspace(-.06, .06, 7)]
    up = unit(rows[-1] - rows[0])
    normal = np.array((0, up[2], -up[1]))
    foot = rows[3] + normal * (max(p @ normal for p in rows) - rows[3] @ normal + .006)
    place = lambda across, rise, out: foot + across * np.array((1.0, 0, 0)) + rise * up + out * normal
    x, top = wide / 2, high / 2
    points = np.array([place(a, b, 0) for a, b in ((-x, -top), (x, -top), (x, top), (-x, top))])
    board = Part("plate", "plate", points, [[0, 3, 2, 1]], [normal], [[0] * 4], [(1, 0), (0, 0), (0, 1), (1, 1)], [[0, 3, 2, 1]])
    holder = plate("plate_holder", "trim_black", fillet([(-x - .006, -top - .006), (x + .006, -top - .006), (x + .006, top + .006), (-x - .006, top + .006)], .012), -.030, -.001, (0, 1), 2)
    turn = np.stack([(-1.0, 0, 0), up, normal], 1)
    return [board, oriented(holder.moved(turn, foot))]


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
    return pair(sleeves) + pair(inside) + pair(bezel())


def bezel():
    """A short dark sleeve around both pipes, with a rolled edge; its outer side lies further ahead, as the tail does."""
    middle, half, high = BEZEL
    start, end = BEZEL_RUN
    rows = ((start, 1), (end + .008, 1), (end + .002, .985), (end, .955), (end + .003, .925), (end + .012, .90), (start, .88))
    loops = []
    for z, wide in rows:
        inset = half * (1 - wide)
        u, v = squared(half - inset, high - inset, .6, 40)
        loops.append(np.stack([middle + u, PIPE_HEIGHT + v, z + .20 * u], 1))
    n = len(loops[0])
    faces = [[i * n + k, (i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n] for i in range(len(rows) - 1) for k in range(n)]
    part = smooth("exhaust_bezel", "gloss_black", np.concatenate(loops), faces, 50)
    return part if (part.points[faces[0]].mean(0) - part.points[:n].mean(0)) @ part.normals[part.corners[0][0]] > 0 else part.flipped()


def reflectors(whole):
    """A slim red bar on the bumper at each corner of the tail."""
    path = np.array([on_face(whole, x, REFLECTOR, 0, -1)[0] for x in np.linspace(*REFLECTOR_RUN, 13)])
    u, v = REFLECTOR_SIZE
    section = [(-v, -u), (v * .4, -u), (v, -u * .6), (v, u * .6), (v * .4, u), (-v, u)]
    width = np.interp(np.arange(13), (0, 1, 11, 12), (.45, 1, 1, .45))
    sections = np.array(section)[None] * np.stack([np.ones(13), width], 1)[:, None]
    return pair(oriented(sweep("reflector", "tail_reflector", path, sections, 30)))


def reverse():
    """One clear lens in a dark frame."""
    y, z, half, high = REVERSE
    frame = box("reverse_frame", "gloss_black", (0, y, z + .012), (2 * half + .016, 2 * high + .014, .030), .006, 2)
    return [frame, box("reverse_lamp", "lamp_glow", (0, y, z), (2 * half, 2 * high, .014), .004, 2)]


def all_parts(skin, whole):
    return lamp(skin, whole) + [name(whole)] + number(whole) + reflectors(whole) + reverse() + exhausts()
