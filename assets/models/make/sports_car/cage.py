"""The cage of the body: cross-sections from the nose to the tail, closed by a front and a rear face.

Metres; x is to the left, y up, z ahead; z = 0 is half-way between the axles. A section runs from the middle of the roof
(column 0) over the rail (2), the waist (3), the crown of the wings (4), the shoulder (5) and the side down to the sill (9).
"""

import numpy as np

from fair import fair
from sculpt import sculpt
from skin import Skin
from subdivide import subdivide

# z, then (x, y) of the columns 0 to 9, then what is added to z of each column.
SECTIONS = (
    (2.40, ((0, .425), (.30, .424), (.52, .426), (.68, .438), (.81, .462), (.885, .455), (.925, .40), (.935, .32), (.93, .20), (.91, .115)),
     (0, -.035, -.12, -.225, -.34, -.445, -.455, -.45, -.44, -.42)),
    (2.20, ((0, .530), (.30, .529), (.52, .537), (.66, .568), (.79, .608), (.905, .575), (.95, .47), (.965, .34), (.955, .20), (.93, .115)),
     (0, -.02, -.07, -.15, -.235, -.325, -.33, -.33, -.33, -.32)),
    (1.88, ((0, .626), (.30, .626), (.50, .633), (.635, .658), (.765, .708), (.900, .68), (.968, .56), (.985, .36), (.97, .20), (.945, .115)),
     (.02, .02, 0, -.04, -.09, -.12, -.12, -.12, -.12, -.12)),
    (1.61, ((0, .688), (.28, .687), (.48, .688), (.61, .712), (.75, .775), (.895, .745), (.985, .61), (.995, .38), (.98, .215), (.95, .140)),
     (.07, .07, .07, .04, -.01, -.03, -.03, -.03, -.03, -.03)),
    (1.325, ((0, .722), (.28, .721), (.47, .720), (.605, .738), (.755, .810), (.895, .778), (.988, .635), (1.0, .40), (.985, .20), (.95, .115)),
     (.13, .13, .13, .09, .03, 0, 0, 0, 0, 0)),
    (1.08, ((0, .748), (.28, .748), (.48, .744), (.62, .756), (.77, .808), (.888, .780), (.970, .632), (.975, .40), (.962, .22), (.94, .115)),
     (.18, .18, .17, .12, .04, 0, 0, 0, 0, 0)),
    (.945, ((0, .765), (.30, .760), (.53, .747), (.67, .762), (.80, .799), (.892, .766), (.958, .606), (.936, .45), (.950, .235), (.935, .115)),
     (.20, .18, .11, .09, .03, 0, 0, 0, 0, 0)),
    (.84, ((0, .808), (.31, .794), (.555, .762), (.70, .771), (.81, .794), (.896, .758), (.957, .609), (.890, .515), (.948, .25), (.935, .115)),
     (.20, .18, .09, .08, .03, 0, 0, 0, 0, 0)),
    (.47, ((0, .972), (.31, .955), (.58, .885), (.752, .784), (.822, .785), (.902, .744), (.957, .620), (.860, .545), (.946, .278), (.934, .115)),
     (.20, .19, .12, .12, .06, 0, 0, 0, 0, 0)),
    (.10, ((0, 1.108), (.30, 1.094), (.54, 1.026), (.768, .792), (.832, .788), (.909, .744), (.958, .634), (.838, .568), (.946, .310), (.935, .115)),
     (.20, .20, .15, .16, .07, 0, 0, 0, 0, 0)),
    (-.20, ((0, 1.156), (.30, 1.143), (.515, 1.088), (.765, .804), (.838, .802), (.918, .752), (.962, .649), (.824, .590), (.948, .340), (.938, .115)),
     (.20, .20, .20, .17, .07, 0, 0, 0, 0, 0)),
    (-.55, ((0, 1.140), (.29, 1.126), (.485, 1.070), (.745, .824), (.840, .830), (.936, .778), (.977, .669), (.852, .606), (.958, .358), (.942, .115)),
     (.20, .20, .20, .16, .06, 0, 0, 0, 0, 0)),
    (-.90, ((0, 1.055), (.27, 1.040), (.445, .992), (.680, .844), (.825, .880), (.956, .828), (1.001, .694), (.985, .46), (.975, .25), (.95, .115)),
     (.15, .15, .15, .10, .03, 0, 0, 0, 0, 0)),
    (-1.325, ((0, .948), (.26, .940), (.42, .912), (.60, .868), (.80, .917), (.956, .866), (1.010, .705), (1.014, .45), (.985, .22), (.955, .15)),
     (.05, .05, .05, .03, 0, 0, 0, 0, 0, 0)),
    (-1.68, ((0, .878), (.28, .876), (.44, .868), (.60, .862), (.78, .897), (.915, .862), (.982, .705), (.982, .48), (.958, .26), (.93, .165)), ()),
    (-1.95, ((0, .854), (.30, .854), (.47, .853), (.62, .852), (.765, .866), (.868, .842), (.928, .70), (.925, .51), (.912, .31), (.89, .190)),
     (0, 0, .01, .02, .04, .07, .07, .07, .07, .07)),
    (-2.15, ((0, .893), (.30, .892), (.47, .888), (.62, .879), (.74, .866), (.825, .832), (.855, .70), (.850, .53), (.838, .36), (.815, .240)),
     (-.03, -.024, -.005, .022, .07, .15, .185, .19, .20, .21)),
)
# Rows of the front and rear faces below their top edges: y and z of columns 0 to 4, and how much narrower.
FRONT = ((.362, 2.402), (.280, 2.352), (.185, 2.358), (.115, 2.410))
REAR = ((.785, -2.080), (.622, -2.055), (.520, -2.160), (.345, -2.130))
# Sharpness along columns from one section to another, and along sections.
CREASES = ((2, 7, 13, .7), (3, 7, 12, 1.6), (5, 4, 16, 4.0), (4, 0, 6, .4), (6, 4, 6, 1.6), (6, 6, 12, 4.5), (6, 12, 13, 1.6), (8, 4, 6, 1.3), (8, 6, 12, 3.6))
# Of the rear face: sharpness along its rows.
REAR_CREASES = ((2, 1.2), (3, 2.0))


def cage():
    """Points, faces, tags and creases, both sides."""
    points, tags, faces = [], [], []
    grid = {}
    for i, (z, section, shift) in enumerate(SECTIONS):
        for j, (x, y) in enumerate(section):
            grid["top", i, j] = len(points)
            points.append((x, y, z + (shift[j] if shift else 0)))
    last = len(SECTIONS) - 1
    for patch, i, rows in (("front", 0, FRONT), ("rear", last, REAR)):
        shift = SECTIONS[i][2]
        for j in range(6):
            for k in range(5):
                if k == 0 or j == 5:
                    grid[patch, j, k] = grid["top", i, j + k] if k == 0 else grid["top", i, 5 + k]
                    continue
                grid[patch, j, k] = len(points)
                y, z = rows[k - 1]
                x = SECTIONS[i][1][j][0]
                edge = SECTIONS[i][1][5 + k]
                t = (j / 5) ** 3
                points.append((x, y * (1 - t) + edge[1] * t, z + shift[j]))
    for i in range(last):
        for j in range(9):
            faces.append([grid["top", a, b] for a, b in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))])
            tags.append(("top" if j < 5 else "side", i, j))
    for patch in ("front", "rear"):
        for j in range(5):
            for k in range(4):
                face = [grid[patch, a, b] for a, b in ((j, k), (j, k + 1), (j + 1, k + 1), (j + 1, k))]
                faces.append(face if patch == "front" else face[::-1])
                tags.append((patch, j, k))
    creases = {}
    for j, a, b, sharp in CREASES:
        for i in range(a, b):
            creases[grid["top", i, j], grid["top", i + 1, j]] = sharp
    for patch, i, sharp in (("front", 0, .9), ("rear", last, 2.2)):
        for j in range(5):
            creases[grid[patch, j, 0], grid[patch, j + 1, 0]] = sharp * (1 - (.12 if patch == "front" else .19) * j)
    for k, sharp in REAR_CREASES:
        for j in range(4):
            creases[grid["rear", j, k], grid["rear", j + 1, k]] = sharp
    return both_sides(points, faces, tags, creases)


def both_sides(points, faces, tags, creases):
    points = [tuple(p) for p in points]
    other = {}
    for k, (x, y, z) in enumerate(list(points)):
        if x == 0:
            other[k] = k
        else:
            other[k] = len(points)
            points.append((-x, y, z))
    count = len(faces)
    faces = faces + [[other[v] for v in f[::-1]] for f in faces[:count]]
    creases = {**creases, **{(other[a], other[b]): s for (a, b), s in creases.items()}}
    return np.array(points, float), faces, tags + [None] * count, creases


def body(levels=4):
    """The left half of the body's surface, x >= 0."""
    points, faces, tags, creases = cage()
    points, faces, history = subdivide(points, faces, creases, levels)
    keep = [k for k in range(len(faces)) if tags[history[0][k]]]
    used = sorted({v for k in keep for v in faces[k]})
    index = {v: i for i, v in enumerate(used)}
    half = points[used]
    half[np.abs(half[:, 0]) < 1e-7, 0] = 0
    quads = [[index[v] for v in faces[k]] for k in keep]
    half = fair(half, quads, levels)
    skin = Skin(sculpt(half), quads,
                [tags[history[0][k]] for k in keep], [history[levels - 1][k] for k in keep], [history[levels - 2][k] for k in keep])
    skin.shade()
    return skin
