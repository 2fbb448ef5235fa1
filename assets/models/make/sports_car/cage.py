"""The cage of the body: cross-sections from the nose to the tail, closed by a front and a rear face.

Metres; x is to the left, y up, z ahead; z = 0 is half-way between the axles. A section runs from the middle of the roof
(column 0) over the rail (2), the waist (3), the crown of the wings (4), the shoulder (5) and the side down to the sill (9).
"""

import numpy as np

from fair import fair
from mesh import DIGITS
from sculpt import flare, sculpt
from skin import Skin
from subdivide import subdivide

# z, then (x, y) of the columns 0 to 9, then what is added to z of each column.
SECTIONS = (
    (2.42, ((0, .392), (.30, .392), (.52, .398), (.68, .414), (.79, .430), (.866, .414), (.902, .362), (.915, .29), (.912, .20), (.895, .115)),
     (0, -.030, -.105, -.210, -.340, -.475, -.520, -.52, -.51, -.50)),
    (2.20, ((0, .496), (.30, .496), (.52, .506), (.66, .540), (.785, .588), (.900, .556), (.944, .455), (.958, .335), (.950, .20), (.928, .115)),
     (0, -.02, -.07, -.15, -.240, -.338, -.36, -.36, -.36, -.35)),
    (1.88, ((0, .602), (.30, .600), (.50, .606), (.635, .630), (.765, .698), (.900, .670), (.968, .55), (.985, .36), (.97, .20), (.945, .115)),
     (.02, .02, 0, -.04, -.09, -.12, -.12, -.12, -.12, -.12)),
    (1.61, ((0, .678), (.28, .675), (.48, .673), (.61, .691), (.75, .769), (.895, .742), (.985, .605), (.995, .38), (.98, .215), (.95, .115)),
     (.07, .07, .07, .04, -.01, -.03, -.03, -.03, -.03, -.03)),
    (1.325, ((0, .727), (.28, .723), (.47, .718), (.605, .725), (.755, .804), (.895, .778), (.985, .632), (.995, .40), (.985, .20), (.958, .115)),
     (.13, .13, .13, .09, .03, 0, 0, 0, 0, 0)),
    (1.08, ((0, .760), (.28, .756), (.48, .747), (.62, .754), (.77, .804), (.884, .776), (.969, .612), (.970, .42), (.966, .19), (.962, .115)),
     (.18, .18, .17, .12, .04, 0, 0, 0, 0, 0)),
    (.945, ((0, .773), (.30, .766), (.53, .750), (.67, .764), (.80, .798), (.884, .764), (.962, .622), (.954, .42), (.955, .175), (.962, .115)),
     (.20, .18, .11, .09, .03, 0, 0, 0, 0, 0)),
    (.84, ((0, .811), (.31, .796), (.555, .763), (.70, .771), (.81, .794), (.882, .757), (.959, .629), (.950, .46), (.949, .195), (.962, .115)),
     (.20, .18, .09, .08, .03, 0, 0, 0, 0, 0)),
    (.47, ((0, .972), (.31, .955), (.58, .885), (.752, .784), (.822, .785), (.885, .750), (.957, .652), (.947, .485), (.933, .255), (.962, .115)),
     (.20, .19, .12, .12, .06, 0, 0, 0, 0, 0)),
    (.10, ((0, 1.108), (.30, 1.094), (.54, 1.026), (.768, .792), (.832, .788), (.890, .756), (.960, .673), (.949, .500), (.919, .310), (.962, .115)),
     (.20, .20, .15, .16, .07, 0, 0, 0, 0, 0)),
    (-.20, ((0, 1.156), (.30, 1.143), (.515, 1.088), (.765, .804), (.838, .802), (.899, .769), (.968, .690), (.954, .524), (.911, .350), (.962, .115)),
     (.20, .20, .20, .17, .07, 0, 0, 0, 0, 0)),
    (-.55, ((0, 1.140), (.29, 1.126), (.485, 1.070), (.745, .824), (.840, .830), (.918, .796), (.985, .711), (.967, .550), (.912, .400), (.962, .115)),
     (.20, .20, .20, .16, .06, 0, 0, 0, 0, 0)),
    (-.90, ((0, 1.055), (.27, 1.040), (.445, .992), (.680, .844), (.825, .876), (.944, .838), (1.003, .737), (1.000, .590), (.948, .43), (.965, .115)),
     (.15, .15, .15, .10, .03, 0, 0, 0, 0, 0)),
    (-1.325, ((0, .948), (.26, .940), (.42, .912), (.60, .868), (.80, .912), (.946, .868), (1.010, .745), (1.014, .53), (.99, .32), (.958, .135)),
     (.05, .05, .05, .03, 0, 0, 0, 0, 0, 0)),
    (-1.68, ((0, .878), (.28, .876), (.44, .868), (.60, .862), (.78, .890), (.905, .855), (.978, .730), (.982, .54), (.965, .34), (.94, .170)), ()),
    (-1.95, ((0, .856), (.30, .856), (.47, .855), (.62, .854), (.755, .856), (.850, .826), (.905, .715), (.912, .55), (.902, .37), (.882, .205)),
     (0, .005, .02, .045, .075, .11, .125, .13, .13, .13)),
    (-2.15, ((0, .893), (.30, .891), (.47, .885), (.61, .873), (.715, .852), (.785, .812), (.815, .70), (.820, .55), (.812, .40), (.795, .240)),
     (-.03, -.012, .022, .075, .145, .200, .224, .231, .234, .237)),
)
# Rows of the front and rear faces below their top edges: y and z of columns 0 to 4, and how much narrower.
FRONT = ((.352, 2.395), (.282, 2.345), (.190, 2.345), (.115, 2.385))
REAR = ((.800, -2.110), (.655, -2.085), (.520, -2.150), (.250, -2.118))
# Sharpness along columns from one section to another, and along sections.
CREASES = ((3, 2, 3, 1.0), (3, 3, 4, 2.4), (3, 4, 5, 3.0), (3, 5, 6, 2.6), (3, 6, 7, 1.8), (2, 7, 13, .7), (3, 7, 12, 1.6), (6, 5, 6, .7), (6, 6, 7, 1.8), (6, 7, 8, 3.0), (6, 8, 11, 4.0), (6, 11, 12, 2.5), (6, 12, 13, 1.5), (8, 6, 7, 1.2), (8, 7, 8, 2.4), (8, 8, 11, 3.6), (8, 11, 12, 1.5))
# Of the rear face: sharpness along its rows.
REAR_CREASES = ((2, .8), (3, .8))


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
    for patch, i, sharp in (("front", 0, 3.0), ("rear", last, 2.2)):
        for j in range(5):
            creases[grid[patch, j, 0], grid[patch, j + 1, 0]] = sharp * (1 - .19 * j)
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
    # Flared before it is faired, so that flares are as even as the rest; fairing moves the arches' edges out of their planes, and sculpt() puts them back.
    half = fair(flare(half), quads, levels)
    skin = Skin(np.round(sculpt(half), DIGITS), quads,
                [tags[history[0][k]] for k in keep], [history[levels - 1][k] for k in keep], [history[levels - 2][k] for k in keep])
    skin.shade()
    return skin
