"""Floor, walls with their openings, panelling, skirting and a door. The room is open nowhere but at the windows."""

import numpy as np

from build import finish, turn
from shapes import Shape, block, lathe, moulding

LEFT, RIGHT, BACK, FRONT, HEIGHT = -2.5, 2.5, -1.9, 4.0, 2.6
RAIL = 0.93
# Along z, low and high y: the first is in the picture, the second beside the camera.
WINDOWS = [(-1.3, 0.1, 0.74, 2.26), (1.1, 2.5, 0.74, 2.26)]
DOOR = (-0.86, 0.8, 2.04)

PANEL = [(0.0, 0.0), (0.0, 0.008), (-0.008, 0.016), (-0.018, 0.014), (-0.024, 0.007), (-0.034, 0.007), (-0.036, 0.0)]
CASING = [(0.085, 0.0), (0.085, 0.018), (0.075, 0.024), (0.06, 0.02), (0.02, 0.017), (0.01, 0.011), (0.0, 0.011), (0.0, 0.0)]


def wall(from_a, to_a, low, high, holes):
    """Quads of a wall in (a, height) round its holes; sides meet point to point."""
    cuts = sorted({from_a, to_a, *(c for hole in holes for c in hole[:2])})
    levels = sorted({low, high, *(c for hole in holes for c in hole[2:] if low < c < high)})
    points = [(a, y) for y in levels for a in cuts]
    faces = []
    for j in range(len(levels) - 1):
        for i in range(len(cuts) - 1):
            a, y = (cuts[i] + cuts[i + 1]) / 2, (levels[j] + levels[j + 1]) / 2
            if not any(h[0] < a < h[1] and h[2] < y < h[3] for h in holes):
                k, n = j * len(cuts) + i, len(cuts)
                faces.append((k, k + 1, k + n + 1, k + n))
    return points, faces


def walls(scene):
    def add(name, from_a, to_a, place, holes=()):
        for part, low, high in (("plaster", RAIL, HEIGHT), ("panelling", 0.0, RAIL)):
            points, faces = wall(from_a, to_a, low, high, holes)
            shape = Shape([place(a, y) for a, y in points], faces)
            uv = lambda p, n: np.stack([p[:, 0] + p[:, 2], p[:, 1]], axis=1) / 0.9
            scene.put("wall_" + name, finish(part, shape, smooth=None, uv=uv))

    add("back", LEFT, RIGHT, lambda a, y: (a, y, BACK))
    add("front", LEFT, RIGHT, lambda a, y: (-a, y, FRONT))
    add("left", -FRONT, -BACK, lambda a, y: (LEFT, y, -a), [(-b, -a, low, high) for a, b, low, high in WINDOWS])
    add("right", BACK, FRONT, lambda a, y: (RIGHT, y, a))
    floor = Shape([(LEFT, 0, FRONT), (RIGHT, 0, FRONT), (RIGHT, 0, BACK), (LEFT, 0, BACK)], [(0, 1, 2, 3)])
    scene.put("floor", finish("floor", floor, smooth=None, uv=lambda p, n: np.stack([p[:, 0], -p[:, 2]], axis=1) / 2.4))
    ceiling = floor.moved(y=HEIGHT).flipped()
    scene.put("ceiling", finish("ceiling", ceiling, smooth=None))


def bar(profile, length):
    """A profile of (forward, up), from its lower back round the front to its upper back, drawn out along x."""
    n = len(profile)
    points = [(x, up, forward) for x in (-length / 2, length / 2) for forward, up in profile]
    faces = [(i, n + i, n + i + 1, i + 1) for i in range(n - 1)] + [(n - 1, 2 * n - 1, n, 0)]
    return Shape(points, faces + [tuple(range(n)), tuple(range(n, 2 * n))[::-1]])


SKIRTING = [(-0.01, -0.01), (0.018, -0.01), (0.018, 0.105), (0.014, 0.118), (0.008, 0.126), (0.006, 0.138), (-0.01, 0.138)]
CHAIR_RAIL = [(-0.01, -0.03), (0.008, -0.03), (0.013, -0.012), (0.026, 0.0), (0.03, 0.012), (0.022, 0.022), (-0.01, 0.024)]
CORNICE = [(-0.01, -0.11), (0.01, -0.11), (0.02, -0.085), (0.06, -0.04), (0.085, -0.02), (0.09, 0.01), (-0.01, 0.01)]


def trim(scene):
    """Bars along the walls, by their side and where along it they run."""
    sides = {
        "back": (lambda c: (c, BACK), 0, [(LEFT, RIGHT)]),
        "front": (lambda c: (c, FRONT), 180, [(LEFT, RIGHT)]),
        "left": (lambda c: (LEFT, c), 90, [(BACK, FRONT)]),
        "right": (lambda c: (RIGHT, c), -90, [(BACK, DOOR[0] - DOOR[1] / 2 - 0.085), (DOOR[0] + DOOR[1] / 2 + 0.085, FRONT)]),
    }
    windows = [BACK, *(c for a, b, _, _ in WINDOWS for c in (a - 0.085, b + 0.085)), FRONT]
    for name, (place, angle, spans) in sides.items():
        rails = list(zip(windows[::2], windows[1::2])) if name == "left" else spans
        for profile, y, runs in ((SKIRTING, 0, spans), (CHAIR_RAIL, RAIL, rails), (CORNICE, HEIGHT, [(spans[0][0], spans[-1][1])])):
            for a, b in runs:
                x, z = place((a + b) / 2)
                scene.put("trim", finish("woodwork", bar(profile, b - a), smooth=40), turn(y=angle, at=(x, y, z)))

    def panels(place, angle, runs, low=0.23, high=RAIL - 0.11):
        for a, b in runs:
            x, z = place((a + b) / 2)
            shape = moulding(b - a, high - low, PANEL)
            scene.put("panels", finish("woodwork", shape, smooth=35), turn(y=angle, at=(x, (low + high) / 2, z)))

    panels(*sides["back"][:2], [(-2.4 + 0.98 * k, -2.4 + 0.98 * k + 0.88) for k in range(5)])
    panels(*sides["right"][:2], [(-1.85, -1.42)] + [(-0.28 + 0.86 * k, 0.48 + 0.86 * k) for k in range(5)])
    for a, b, low, _ in WINDOWS:
        panels(*sides["left"][:2], [(a, (a + b) / 2 - 0.05), ((a + b) / 2 + 0.05, b)], 0.23, low - 0.14)


def door(scene):
    """Six raised panels in the right wall."""
    middle, width, height = DOOR
    at = turn(y=-90, at=(RIGHT, 0, middle))
    parts = [finish("door_paint", block((0, height / 2, -0.004), (width - 0.004, height - 0.006, 0.03)), bevel=0.003)]
    rows = [(0.2, 0.72), (0.86, 1.5), (1.62, 1.9)]
    for low, high in rows:
        for x in (-0.18, 0.18):
            y, size = (low + high) / 2, (0.26, high - low)
            parts.append(finish("door_paint", moulding(*size, PANEL).moved(x, y, 0.011), smooth=35))
            raised = block((x, y, 0.011), (size[0] - 0.09, size[1] - 0.09, 0.012))
            parts.append(finish("door_paint", raised, bevel=0.005, segments=1, smooth=20))
    case = moulding(width, height + 0.4, CASING).moved(0, height / 2 - 0.2, 0)
    parts.append(finish("woodwork", case, smooth=35))
    knob = lathe([(0.026, 0), (0.026, 0.004), (0.009, 0.008), (0.008, 0.028), (0.018, 0.034), (0.026, 0.046), (0.024, 0.058), (0.012, 0.066), (0, 0.067)])
    knob = knob.mapped(lambda p: np.stack([p[:, 0], -p[:, 2], p[:, 1]], axis=1)).moved(0.34, 1.0, 0.01)
    parts.append(finish("brass", knob, smooth=50))
    scene.put("door", parts, at)


def build(scene):
    walls(scene)
    trim(scene)
    door(scene)
