"""Curtains on a rod: folds that run down from pleats, one side drawn together by a band."""

import numpy as np

from build import finish
from room import LEFT, WINDOWS
from shapes import lathe, sheet, tube

ROD_X, ROD_Y = LEFT + 0.1, 2.42


def drape(fixed, free, waist, folds, across, along, seed, tie=0.98):
    """From z `fixed` at the wall's side to `free` where the window is. `waist`: the breadth that is left at the band, or None."""
    random = np.random.default_rng(seed)
    phase = random.uniform(0, 2 * np.pi, 4)
    top, bottom = ROD_Y - 0.035, 0.012

    def place(u, v):
        y = bottom + (top - bottom) * v
        drop = 1 - v
        breadth = np.ones_like(v)
        pull = np.zeros_like(v)
        if waist:
            near = np.exp(-(((y - tie) / np.where(y > tie, 0.62, 0.34)) ** 2))
            breadth = 1 - (1 - waist) * near
            pull = near
        sway = 0.012 * np.sin(3.1 * y + 5 * u + phase[0]) * drop
        z = fixed + (free - fixed) * u * breadth + sway
        wander = 0.5 * np.sin(2.2 * y + phase[1]) * drop + 0.35 * np.sin(4 * np.pi * u + phase[2]) * drop
        turn = 2 * np.pi * folds * u + wander
        depth = (0.02 + 0.02 * drop) * (1 - 0.35 * pull)
        fold = np.sin(turn) + 0.32 * np.sin(2 * turn + phase[3]) * drop + 0.18 * np.sin(0.5 * turn + 2 * y)
        z = z + 0.35 * depth * np.cos(turn) * drop
        return ROD_X + depth * fold - 0.02 * pull, y, z

    return sheet(across, along, place)


def build(scene):
    a, b, _, _ = WINDOWS[0]
    for name, fixed, free, waist, folds, seed in (("far", a - 0.46, a + 0.24, 0.42, 8, 5), ("near", b + 0.46, b - 0.4, None, 9, 8)):
        shape = drape(fixed, free, waist, folds, 68, 22, seed)
        if free > fixed:
            shape = shape.flipped()
        shape.uvs = [[(u * 4.4, v * 6.2) for u, v in face] for face in shape.uvs]
        scene.put("curtain_" + name, finish("curtain", shape, smooth=80))
    for fixed, free, seed in ((0.78, 1.25, 12), (2.84, 2.4, 15)):
        shape = drape(fixed, free, None, 6, 40, 8, seed)
        shape.uvs = [[(u * 3.4, v * 6.2) for u, v in face] for face in shape.uvs]
        scene.put("curtain_other", finish("curtain", shape.flipped() if free > fixed else shape, smooth=80))
    for middle, half in ((a - 0.46 + 0.15, 0.165),):
        loop = np.linspace(0, 2 * np.pi, 22)
        band = [(ROD_X + 0.058 * np.cos(t) - 0.016, 0.98 + 0.03 * np.sin(t + 2.2), middle + half * np.sin(t)) for t in loop]
        scene.put("curtain_band", finish("curtain_cord", tube(band, 0.011, 8), smooth=60))
    for low, high in ((a - 0.46, b + 0.58), (0.7, 2.92)):
        scene.put("rods", finish("brass", tube([(ROD_X, ROD_Y, low), (ROD_X, ROD_Y, high)], 0.012, 10), smooth=50))
        knob = lathe([(0.027 * np.sin(t) if 0 < t < 3.1 else 0, -0.027 * np.cos(t)) for t in np.linspace(0, np.pi, 8)])
        for z in (low, high):
            scene.put("rods", finish("brass", knob.moved(ROD_X, ROD_Y, z), smooth=80))
        for z in (low + 0.06, high - 0.06):
            scene.put("rods", finish("brass", tube([(LEFT - 0.01, ROD_Y, z), (ROD_X, ROD_Y, z)], 0.009, 10), smooth=50))
    for start, end, count in ((a - 0.46, a + 0.24, 9), (b - 0.42, b + 0.46, 10)):
        for k in range(count):
            z = start + (end - start) * (k + 0.5) / count
            loop = [(ROD_X + 0.021 * np.cos(t), ROD_Y - 0.006 + 0.021 * np.sin(t), z) for t in np.linspace(0, 2 * np.pi, 9)]
            scene.put("rods", finish("brass", tube(loop, 0.003, 4, (0, 0, 1)), smooth=80))
