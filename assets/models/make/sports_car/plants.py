"""Trees and tufts of grass: leaves are cards, whose shape is cut out by alpha."""

import numpy as np

from land import rise
from mesh import Part, joined, unit
from road import WALL
from shapes import disk, sweep

# Where trees stand, and how tall they are.
TREES = ((-9, 13, 6.2), (-13, 22, 7.5), (-11, -14, 6.5), (-17, -24, 8.5), (-21, 6, 8), (-26, 34, 9), (-10, 42, 7), (-30, -8, 9.5),
         (-14, -46, 8), (-38, 20, 10), (-9.5, 70, 7.5), (-24, -70, 9))
# A picture of cards is four cells, each of another tone.
CELLS = ((0, 0), (.5, 0), (0, .5), (.5, .5))


class Cards:
    """Rectangles that show one cell of a picture."""

    def __init__(self, rng):
        self.rng, self.centres, self.ups, self.rights, self.cells = rng, [], [], [], []

    def add(self, centre, up, right, cell=None):
        self.centres.append(centre)
        self.ups.append(up)
        self.rights.append(right)
        self.cells.append(int(self.rng.integers(4)) if cell is None else cell)

    def leaf(self, centre, outwards, size, cell):
        """A card that looks about outwards."""
        d = unit(np.asarray(outwards) + self.rng.normal(0, .55, 3))
        u = unit(np.cross(d, self.rng.normal(0, 1, 3)))
        self.add(centre, u * size, np.cross(u, d) * size, cell)

    def part(self, name, material):
        points, faces, uv_corners = [], [], []
        uvs = [(a + .5 * x, b + .5 * y) for a, b in CELLS for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for c, u, r, cell in zip(self.centres, self.ups, self.rights, self.cells):
            k = len(points)
            points += [c - r - u, c + r - u, c + r + u, c - r + u]
            faces.append([k, k + 1, k + 2, k + 3])
            uv_corners.append([4 * cell + i for i in range(4)])
        normals = unit(np.cross(self.rights, self.ups))
        return Part(name, material, points, faces, normals, [[k] * 4 for k in range(len(faces))], uvs, uv_corners)

    def bent(self, name, material, fold=.45):
        """As above, but each card is folded along its middle, so that none is ever seen as a line."""
        points, faces, normals, corners, uv_corners = [], [], [], [], []
        uvs = [(a + .5 * x, b + .5 * y) for a, b in CELLS for y in (0, 1) for x in (0, .5, 1)]
        for c, u, r, cell in zip(self.centres, self.ups, self.rights, self.cells):
            k, n = len(points), len(normals)
            out = np.cross(r, u) / np.linalg.norm(u) * fold
            points += [c - r - u - out, c - u + out, c + r - u - out, c - r + u - out, c + u + out, c + r + u - out]
            normals += [np.cross(r + 2 * out, u), np.cross(r - 2 * out, u)]
            for half in (0, 1):
                faces.append([k + half, k + half + 1, k + half + 4, k + half + 3])
                corners.append([n + half] * 4)
                uv_corners.append([6 * cell + half + i for i in (0, 1, 4, 3)])
        return Part(name, material, points, faces, unit(np.array(normals)), corners, uvs, uv_corners)


def branch(start, heading, length, radius, steps=4, lift=.25):
    """A limb that bends upwards: its path and its bark."""
    t = np.linspace(0, 1, steps)[:, None]
    path = np.asarray(start) + heading * length * t + np.array((0, lift * length, 0)) * t * t
    return path, sweep("trunks", "bark", path, [disk(radius * (1 - .75 * s), 6) for s in t[:, 0]], 60)


def tree(x, z, tall, rng, leaves, trunks, dense):
    """A trunk, limbs all round from a third of its height, twigs on the limbs, and leaves about the twigs' outer halves."""
    foot = np.array((x, rise(x, z) - .2, z))
    lean = rng.normal(0, .05, 2) * tall
    steps = np.linspace(0, 1, 7)
    trunk = np.array([foot + (lean[0] * t * t, tall * .80 * t, lean[1] * t * t) for t in steps])
    trunks.append(sweep("trunks", "bark", trunk, [disk(.024 * tall * (1.1 - .95 * t) * (1.5 if t == 0 else 1), 9) for t in steps], 60))
    tone = int(rng.integers(4))
    twigs = [trunk[4:]]
    limbs = 13
    for k in range(limbs):
        t = .30 + .62 * k / (limbs - 1)
        a = k * 2.4 + rng.normal(0, .3)
        start = np.array([np.interp(t, steps, trunk[:, i]) for i in range(3)])
        heading = unit(np.array((np.cos(a), .25 + .9 * t * t, np.sin(a))))
        length = tall * (.40 * np.sqrt(max(0, 1 - ((t - .52) / .62) ** 2)) + rng.normal(0, .025))
        path, bark = branch(start, heading, length, .010 * tall * (1.2 - t))
        trunks.append(bark)
        twigs.append(path[2:])
        for s in (-1, 1):
            side = unit(heading + s * .8 * np.cross(heading, (0, 1, 0)) + rng.normal(0, .2, 3))
            path_of_twig, bark = branch(path[1] + (path[2] - path[1]) * rng.random(), side, length * rng.uniform(.40, .62), .005 * tall, 3)
            trunks.append(bark)
            twigs.append(path_of_twig[1:])
    middle = trunk[5]
    for twig in twigs:
        for _ in range(dense):
            s = rng.random() * (len(twig) - 1)
            at = twig[int(s)] * (1 - s % 1) + twig[int(s) + 1] * (s % 1) + np.clip(rng.normal(0, .034, 3), -.07, .07) * tall * (1, .75, 1)
            leaves.leaf(at, unit(at - middle) + (0, .5, 0), rng.uniform(.026, .046) * tall, tone if rng.random() < .6 else None)


def trees():
    trunks, leaves = [], Cards(np.random.default_rng(299))
    for n, (x, z, tall) in enumerate(TREES):
        tree(x, z, tall, np.random.default_rng(300 + n), leaves, trunks, 23 if np.hypot(x, z) < 30 else 14)
    return [joined("trunks", trunks), leaves.bent("leaves", "leaves")]


def tufts():
    """Blades along the foot and the back of the wall, and over the meadow near it."""
    rng = np.random.default_rng(77)
    cards = Cards(rng)

    def add(x, y, z, size, wide):
        a = rng.uniform(-.7, .7) + (np.pi / 2 if rng.random() < .7 else 0)
        r = np.array((np.cos(a), 0, np.sin(a))) * wide
        u = np.array((rng.normal(0, .15), 1, rng.normal(0, .15))) * size / 2
        cards.add(np.array((x, y + size / 2 - .01, z)), u, r)

    for _ in range(150):
        add(WALL + rng.uniform(.015, .07), .105, rng.uniform(-16, 16), rng.uniform(.05, .16), rng.uniform(.05, .12))
    for _ in range(900):
        z = rng.uniform(-34, 30)
        x = WALL - .38 - abs(rng.normal(0, .5))
        add(x, rise(x, z), z, rng.uniform(.25, .6), rng.uniform(.2, .45))
    for _ in range(1300):
        z, x = rng.uniform(-40, 34), WALL - 1 - 16 * rng.random() ** 1.5
        add(x, rise(x, z), z, rng.uniform(.10, .26), rng.uniform(.2, .42))
    # Low ones, as a meadow has them everywhere; they thin out where the picture of grass does alone.
    for _ in range(8000):
        away = 1 + 38 * rng.random() ** 1.4
        z, x = rng.uniform(-30 - 1.2 * away, 26 + 1.2 * away), WALL - away
        add(x, rise(x, z), z, rng.uniform(.07, .17), rng.uniform(.22, .50))
    return [cards.part("tufts", "blades")]


def all_parts():
    return trees() + tufts()
