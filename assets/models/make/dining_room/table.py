"""The table, its runner, and the rug below."""

import numpy as np

from build import finish, grain, turn
from shapes import Shape, block, lathe, outline, sheet, slab

TOP, WIDTH, DEPTH = 0.76, 1.84, 0.96
RUG = 0.009

LEG = [
    (0.0, 0.0), (0.021, 0.0), (0.025, 0.012), (0.027, 0.03), (0.02, 0.046), (0.019, 0.056), (0.028, 0.07), (0.0285, 0.08), (0.021, 0.096),
    (0.024, 0.16), (0.031, 0.27), (0.037, 0.38), (0.039, 0.44), (0.034, 0.49), (0.025, 0.52), (0.024, 0.528), (0.035, 0.54), (0.036, 0.552),
    (0.026, 0.564), (0.026, 0.576), (0.036, 0.588), (0.037, 0.598), (0.0, 0.6),
]


def table():
    top = slab(outline(WIDTH, DEPTH, 0.075, 7), TOP - 0.032, TOP)
    parts = [finish("walnut", top, bevel=0.009, segments=3, uv=grain("top", 0, 0.8), smooth=40)]
    under = slab(outline(WIDTH - 0.05, DEPTH - 0.05, 0.06, 4), TOP - 0.046, TOP - 0.03)
    parts.append(finish("walnut", under, bevel=0.006, uv=grain("under", 0, 0.8)))
    x, z = WIDTH / 2 - 0.13, DEPTH / 2 - 0.11
    for name, centre, size, axis in (
        ("long1", (0, TOP - 0.09, z), (2 * x, 0.095, 0.024), 0), ("long2", (0, TOP - 0.09, -z), (2 * x, 0.095, 0.024), 0),
        ("end1", (x, TOP - 0.09, 0), (0.024, 0.095, 2 * z), 2), ("end2", (-x, TOP - 0.09, 0), (0.024, 0.095, 2 * z), 2),
    ):
        parts.append(finish("walnut", block(centre, size), bevel=0.003, uv=grain(name, axis, 0.8)))
    for k, (sx, sz) in enumerate(((-1, -1), (1, -1), (1, 1), (-1, 1))):
        cube = block((sx * x, 0.66, sz * z), (0.078, 0.135, 0.078))
        parts.append(finish("walnut", cube, bevel=0.005, uv=grain("block%d" % k, 1, 0.8)))
        leg = lathe([(r * 1.02, RUG + y) for r, y in LEG]).moved(sx * x, 0, sz * z)
        leg.uvs = [[(v * 0.55 + 0.2 * k, u * 0.2 + 0.3 * k) for u, v in face] for face in leg.uvs]
        parts.append(finish("walnut", leg, smooth=45))
    return parts


def runner():
    """A cloth along the table that hangs over at both ends; two faces, closed by its thickness."""
    half, hang, breadth = WIDTH / 2 + 0.004, 0.17, 0.36
    bend, length = 0.012, 2 * (half + hang)

    def place(u, v):
        s = (u - 0.5) * length
        out = np.abs(s) - (half - bend)
        angle = np.clip(out / bend, 0, np.pi / 2)
        x = np.where(out > 0, half - bend + bend * np.sin(angle), np.abs(s))
        y = np.where(out > 0, -bend * (1 - np.cos(angle)), 0.0) - np.maximum(out - bend * np.pi / 2, 0)
        down = np.maximum(out, 0) / hang
        x = x + 0.01 * down * (1 + np.sin(9 * v + 2 * np.sign(s)))
        ripple = 0.0006 * (1 + np.sin(23 * s + 9 * v)) * (out < 0)
        return np.sign(s) * x, TOP + 0.0034 + ripple + y, (0.5 - v) * breadth

    shape = sheet(48, 4, place)
    shape.uvs = [[(2 * u, v) for u, v in face] for face in shape.uvs]
    return finish("runner", shape, thickness=0.002, smooth=50)


def rug(scene):
    w, d = 3.1, 2.12
    shape = slab(outline(w, d, 0.012, 3), -0.002, RUG)
    uv = lambda p, n: np.stack([p[:, 0] / w + 0.5, 0.5 - p[:, 2] / d], axis=1)
    scene.put("rug", finish("rug", shape, bevel=0.004, uv=uv), turn(y=0, at=(0, 0, 0.06)))
    random = np.random.default_rng(17)
    points, faces = [], []
    for side in (-1, 1):
        for k in range(110):
            z = (k + 0.5) / 110 * d - d / 2
            lean, length = random.normal(0, 0.006), random.uniform(0.045, 0.06)
            n = len(points)
            x = side * (w / 2 - 0.004)
            points += [(x, 0.006, z - 0.0035), (x, 0.006, z + 0.0035)]
            points += [(x + side * length * 0.5, 0.0035, z + lean * 0.4 + s * 0.0045) for s in (-1, 1)]
            points += [(x + side * length, 0.0018, z + lean + s * 0.006) for s in (-1, 1)]
            quads = [(n, n + 1, n + 3, n + 2), (n + 2, n + 3, n + 5, n + 4)]
            faces += quads if side > 0 else [q[::-1] for q in quads]
    scene.put("rug_fringe", finish("linen", Shape(points, faces), smooth=80), turn(at=(0, 0, 0.06)))


def build(scene):
    scene.put("table", table())
    scene.put("runner", runner())
    rug(scene)
