"""The cage of the body: cross-sections from the nose to the tail, closed by a front and a rear face.

Metres; x is to the left, y up, z ahead; z = 0 is half-way between the axles. A section runs from the middle of the roof
(column 0) over the rail (2), the waist (3), the crown of the wings (4), the shoulder (5) and the side down to the sill (9).
"""

import numpy as np

from skin import Skin
from subdivide import subdivide

FRONT_AXLE, REAR_AXLE = 1.325, -1.325
# z, then (x, y) of the columns 0 to 9, then what is added to z of each column.
SECTIONS = (
    (2.285, ((0, .478), (.30, .477), (.52, .477), (.68, .487), (.81, .51), (.885, .505), (.925, .43), (.935, .33), (.93, .20), (.91, .115)),
     (0, -.012, -.05, -.115, -.20, -.32, -.335, -.33, -.32, -.30)),
    (2.13, ((0, .548), (.30, .548), (.52, .553), (.66, .577), (.79, .615), (.905, .585), (.95, .48), (.965, .34), (.955, .20), (.93, .115)),
     (0, -.01, -.04, -.09, -.155, -.245, -.25, -.25, -.25, -.24)),
    (1.88, ((0, .625), (.30, .627), (.50, .633), (.635, .655), (.765, .705), (.90, .68), (.968, .56), (.985, .36), (.97, .20), (.945, .115)),
     (0, 0, -.02, -.05, -.09, -.12, -.12, -.12, -.12, -.12)),
    (1.61, ((0, .680), (.28, .680), (.48, .682), (.61, .705), (.75, .770), (.895, .745), (.980, .61), (.995, .38), (.98, .20), (.95, .115)),
     (0, 0, 0, -.02, -.03, -.03, -.03, -.03, -.03, -.03)),
    (1.325, ((0, .713), (.28, .713), (.47, .715), (.605, .735), (.755, .805), (.895, .775), (.985, .63), (1.0, .40), (.985, .20), (.95, .115)), ()),
    (1.08, ((0, .742), (.28, .742), (.48, .740), (.62, .752), (.77, .808), (.89, .778), (.962, .635), (.970, .40), (.962, .22), (.94, .115)), ()),
    (.945, ((0, .762), (.30, .758), (.53, .745), (.67, .760), (.80, .800), (.888, .770), (.950, .607), (.935, .40), (.95, .22), (.935, .115)),
     (0, -.02, -.09, -.09, -.05, 0, 0, 0, 0, 0)),
    (.84, ((0, .808), (.31, .794), (.555, .762), (.70, .770), (.81, .795), (.888, .765), (.946, .609), (.908, .40), (.945, .22), (.935, .115)),
     (0, -.02, -.10, -.10, -.05, 0, 0, 0, 0, 0)),
    (.47, ((0, .972), (.31, .955), (.58, .885), (.752, .782), (.825, .785), (.892, .752), (.944, .617), (.876, .40), (.942, .22), (.935, .115)),
     (0, -.01, -.07, -.05, -.02, 0, 0, 0, 0, 0)),
    (.10, ((0, 1.112), (.30, 1.098), (.54, 1.030), (.768, .790), (.835, .788), (.900, .750), (.945, .626), (.868, .40), (.942, .22), (.935, .115)),
     (0, 0, -.05, 0, 0, 0, 0, 0, 0, 0)),
    (-.20, ((0, 1.163), (.30, 1.150), (.515, 1.095), (.765, .802), (.840, .800), (.908, .757), (.950, .640), (.872, .40), (.945, .22), (.935, .115)), ()),
    (-.55, ((0, 1.150), (.29, 1.136), (.485, 1.080), (.745, .822), (.840, .825), (.926, .780), (.968, .660), (.915, .41), (.955, .22), (.94, .115)), ()),
    (-.90, ((0, 1.072), (.27, 1.056), (.445, 1.005), (.680, .842), (.825, .873), (.945, .825), (.998, .684), (.988, .43), (.972, .22), (.95, .115)), ()),
    (-1.325, ((0, .965), (.26, .955), (.42, .925), (.60, .870), (.80, .910), (.950, .860), (1.005, .695), (1.010, .44), (.985, .22), (.955, .13)), ()),
    (-1.68, ((0, .890), (.28, .887), (.44, .877), (.60, .868), (.78, .892), (.922, .855), (.988, .695), (.995, .45), (.975, .23), (.945, .15)), ()),
    (-1.95, ((0, .855), (.30, .855), (.47, .853), (.62, .850), (.77, .858), (.885, .832), (.948, .69), (.955, .47), (.945, .27), (.92, .18)),
     (0, 0, .01, .02, .04, .07, .07, .07, .07, .07)),
    (-2.15, ((0, .868), (.30, .868), (.47, .864), (.62, .858), (.75, .848), (.845, .815), (.885, .69), (.895, .49), (.885, .33), (.86, .25)),
     (0, .006, .025, .05, .095, .165, .19, .20, .21, .22)),
)
# Rows of the front and rear faces below their top edges: y and z of columns 0 to 4, and how much narrower.
FRONT = ((.425, 2.305), (.325, 2.295), (.20, 2.315), (.115, 2.325))
REAR = ((.735, -2.098), (.545, -2.120), (.36, -2.165), (.275, -2.12))
# Sharpness along columns from one section to another, and along sections.
CREASES = ((2, 7, 13, .7), (3, 7, 12, 1.6), (5, 1, 4, 1.1), (5, 4, 16, 1.7), (4, 0, 6, .4), (6, 6, 11, 3.2), (6, 11, 12, 1.6), (8, 4, 13, 1.3))


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
            creases[grid[patch, j, 0], grid[patch, j + 1, 0]] = sharp * (1 - .12 * j)
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


def bump(x):
    """1 at 0, falling smoothly to 0 at 1."""
    x = np.clip(np.abs(x), 0, 1)
    return (1 - x * x) ** 2


def step(x):
    x = np.clip(x, 0, 1)
    return x * x * (3 - 2 * x)


def undercut(y, z):
    """How far the ends before and behind the wheels are drawn in towards the road, below a crease that rises outwards."""
    ahead, behind = step((z - 1.72) / .10), step((-1.76 - z) / .10)
    crease = .235 + .10 * np.clip(np.abs(z) - 1.75, 0, .4)
    return (ahead + behind) * .040 * np.clip((crease - y) / .14, 0, 1) ** .8


def sculpt(p):
    """What the cage is too coarse for: flared arches, the scallop below the flank's edge before the side intake, a crease on the bonnet."""
    x, y, z = p.T
    side = step((x - .70) / .2)
    out = np.zeros_like(x)
    for centre, height, radius, flare in ((FRONT_AXLE, .335, .360, .022), (REAR_AXLE, .348, .379, .020)):
        r = np.hypot(z - centre, y - height)
        out += side * flare * bump((r - radius) / .13) * (.7 + .3 * step((y - .12) / .15))
    scallop = step((.42 - z) / 1.0) * step((z + .93) / .10) * bump((y - .46 + .05 * z) / .20) ** 1.5
    out -= side * .040 * scallop
    out -= undercut(y, z)
    p = p.copy()
    p[:, 0] += out
    on_top = (z > .98) & (y > .4)
    ridge = bump((x - (.29 + .07 * (z - 1))) / .14) * step((2.26 - z) / .45) * step((z - .95) / .1)
    p[:, 1] += np.where(on_top, .016 * ridge * (x < .56), 0)
    return p


def body(levels=4):
    """The left half of the body's surface, x >= 0."""
    points, faces, tags, creases = cage()
    points, faces, history = subdivide(points, faces, creases, levels)
    keep = [k for k in range(len(faces)) if tags[history[0][k]]]
    used = sorted({v for k in keep for v in faces[k]})
    index = {v: i for i, v in enumerate(used)}
    half = points[used]
    half[np.abs(half[:, 0]) < 1e-7, 0] = 0
    skin = Skin(sculpt(half), [[index[v] for v in faces[k]] for k in keep],
                [tags[history[0][k]] for k in keep], [history[levels - 1][k] for k in keep], [history[levels - 2][k] for k in keep])
    skin.shade()
    return skin
