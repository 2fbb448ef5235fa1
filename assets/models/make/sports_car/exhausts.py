"""The exhausts: at each side two oval pipes in one framed opening of the valance, all within the bumper's outline."""

import numpy as np

from borders import line, strip
from diffuser import SET_IN
from mesh import joined, smooth
from shapes import squared
from shell import pair
from surface import on_face

# The frame's section from its outer foot over the rim into the opening: how far into the opening, and how far out of the valance.
FRAME = ((-.013, -.002), (-.013, .003), (-.0115, .006), (-.009, .0075), (-.003, .0075), (-.001, .006), (0, .003), (0, -.050))
# How deep the dark back lies, and the pipes' ends, below the frame's rim.
BACK, ENDS = .052, .010
# The pipes of one side: x of each; their height, and half of their width and height.
PIPES, HEIGHT, SIZE = (.434, .544), .3165, (.044, .027)


def frame(skin):
    edge = line(skin, {"exhaust"}, {"diffuser"}, .010)
    base = edge.points - edge.out * SET_IN
    rows = [base + edge.inner * a + (edge.out * b if b > -.01 else np.array((0, 0, -b))) for a, b in FRAME]
    part = strip("exhaust_frame", "exhaust", rows, edge.closed, angle=60)
    rim = part.corners[3]
    return part if part.normals[rim[0]] @ edge.out[0] > 0 else part.flipped()


def pipe(whole, x):
    """One end of an exhaust: an oval sleeve with a rolled edge, polished outside, dark inside."""
    rear = on_face(whole, x, HEIGHT, -SET_IN, -1)[0][2] + ENDS
    rows = ((.05, .97), (.010, 1.0), (.004, 1.0), (0, .975), (0, .93), (.004, .89), (.012, .87), (.048, .86))
    loops = []
    for back, wide in rows:
        u, v = squared(SIZE[0] * wide, SIZE[1] - SIZE[0] * (1 - wide), .75, 32)
        loops.append(np.stack([x + u, HEIGHT + v, rear + back + .35 * u * (back < .1)], 1))
    n = len(loops[0])
    faces = [[i * n + k, (i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n] for i in range(len(rows) - 1) for k in range(n)]
    points = np.concatenate(loops)
    sleeve = smooth("exhaust", "exhaust", points, faces, 40)
    if (points[faces[0]].mean(0) - points[:n].mean(0)) @ sleeve.normals[sleeve.corners[0][0]] < 0:
        sleeve = sleeve.flipped()
    outside = lambda k: k < 6 * n
    return sleeve.only(outside), sleeve.moved(name="exhaust_inside").only(lambda k: not outside(k), "gap_black")


def all_parts(skin, whole):
    rows = [pipe(whole, x) for x in PIPES]
    back = skin.part("exhaust_back", "gap_black", {"exhaust"}, shift=lambda p, n: p - n * SET_IN + (0, 0, BACK))
    parts = [frame(skin), joined("exhaust", [row[0] for row in rows]), joined("exhaust_inside", [row[1] for row in rows]), back]
    return [p for part in parts for p in pair(part)]
