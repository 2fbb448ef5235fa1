"""Windows: reveals, casing, sill, and two casements with glazing bars; the panes are left out. A garden beyond."""

import numpy as np

from build import finish, turn
from noise import at_height
from room import CASING, LEFT, WINDOWS
from shapes import Shape, block, lathe, moulding

DEPTH = 0.24
FRAME = [(0.0, -0.02), (0.0, 0.025), (-0.045, 0.025), (-0.05, 0.02), (-0.05, -0.02)]
SASH = [(0.0, -0.02), (0.0, 0.018), (-0.036, 0.018), (-0.046, 0.008), (-0.046, -0.012), (-0.036, -0.02)]


def window(scene, span):
    """Built facing +z about (0, 0), then turned to face the room from the left wall."""
    a, b, low, high = span
    w, h = b - a, high - low
    at = turn(y=90, at=(LEFT, (low + high) / 2, (a + b) / 2))
    x, y = w / 2, h / 2
    edge = [(-x, -y), (x, -y), (x, y), (-x, y)]
    points = [(*c, 0.0) for c in edge] + [(*c, -DEPTH) for c in edge]
    reveal = Shape(points, [(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)])
    parts = [finish("woodwork", reveal, smooth=None)]
    parts.append(finish("woodwork", moulding(w, h, CASING), smooth=35))
    parts.append(finish("woodwork", block((0, -y - 0.012, -0.05), (w + 0.26, 0.03, 0.26)), bevel=0.006))
    parts.append(finish("woodwork", moulding(w + 0.002, h + 0.002, FRAME).moved(0, 0, -0.13), smooth=30))
    sash = (w - 0.1) / 2
    for side in (-1, 1):
        cx = side * sash / 2
        parts.append(finish("woodwork", moulding(sash + 0.004, h - 0.1, SASH).moved(cx, 0, -0.12), smooth=30))
        inner_w, inner_h = sash - 0.08, h - 0.18
        parts.append(finish("woodwork", block((cx, 0, -0.121), (0.02, inner_h, 0.022)), bevel=0.004))
        for k in (1, 2):
            parts.append(finish("woodwork", block((cx, inner_h * (k / 3 - 0.5), -0.121), (inner_w, 0.02, 0.02)), bevel=0.004))
        knob = lathe([(0.006, 0), (0.006, 0.02), (0.011, 0.024), (0.011, 0.03), (0, 0.033)])
        knob = knob.mapped(lambda p: np.stack([p[:, 0], -p[:, 2], p[:, 1]], axis=1))
        parts.append(finish("brass", knob.moved(side * 0.022, -0.05, -0.103), smooth=50))
    scene.put("windows", parts, at)


def panes(scene, span):
    """Frosted glass with the day behind it, as one sheet that shines, in the window beside the camera."""
    a, b, low, high = span
    x = LEFT - 0.16
    sheet = Shape([(x, low - 0.02, b + 0.02), (x, low - 0.02, a - 0.02), (x, high + 0.02, a - 0.02), (x, high + 0.02, b + 0.02)], [(0, 1, 2, 3)])
    scene.put("window_panes", finish("window_light", sheet, smooth=None))


def bush(centre, size, seed):
    """A ball, made uneven."""
    profile = [(np.sin(t), -np.cos(t)) for t in np.linspace(0.0, np.pi, 13)]
    ball = lathe(profile, 20)

    def rough(p):
        bump = 1 + 0.16 * at_height(seed, p, 0.45) + 0.09 * at_height(seed + 1, p, 0.16) + 0.06 * at_height(seed + 2, p, 0.07)
        return p * bump[:, None] * np.array(size) + np.array(centre)

    return ball.mapped(rough)


def garden(scene):
    lawn = Shape([(-6.4, -0.45, 3.6), (-2.9, -0.45, 3.6), (-2.9, -0.45, -4.6), (-6.4, -0.45, -4.6)], [(0, 1, 2, 3)])
    scene.put("garden", finish("lawn", lawn, smooth=None))
    places = [
        ((-4.0, 0.0, -1.5), (0.5, 0.85, 0.6)), ((-4.5, 0.4, -2.3), (0.6, 1.0, 0.7)), ((-4.2, 0.3, -3.1), (0.6, 1.15, 0.7)), ((-3.6, 0.3, -3.5), (0.6, 0.95, 0.6)),
        ((-4.9, 0.6, -3.6), (0.7, 1.1, 0.7)), ((-3.5, -0.2, -2.1), (0.35, 0.5, 0.4)),
    ]
    for k, (centre, size) in enumerate(places):
        shape = bush(centre, size, 300 + 5 * k)
        shape.uvs = [[(7 * u, 3 * v) for u, v in face] for face in shape.uvs]
        scene.put("garden", finish("hedge", shape, smooth=60))


def build(scene):
    for span in WINDOWS:
        window(scene, span)
    panes(scene, WINDOWS[1])
    garden(scene)
