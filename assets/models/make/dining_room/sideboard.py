"""A low cupboard below the picture, with a vase, a bowl and a pile of books."""

import numpy as np

from books import Books
from build import finish, grain, turn
from fruit import dish
from room import BACK
from shapes import block, lathe, moulding
from shelf import vase

LEFT, RIGHT, TOP, DEPTH = -1.62, 0.12, 0.84, 0.42
FACE = [(0.0, 0.0), (0.0, 0.004), (-0.006, 0.009), (-0.02, 0.009), (-0.028, 0.003), (-0.03, 0.0)]
TALL = [(0, 0), (0.045, 0), (0.05, 0.005), (0.064, 0.06), (0.068, 0.12), (0.058, 0.18), (0.034, 0.225), (0.026, 0.25), (0.033, 0.275)]


def build(scene):
    middle, width = (LEFT + RIGHT) / 2, RIGHT - LEFT
    z = BACK + 0.03 + DEPTH / 2
    front = z + DEPTH / 2
    put = lambda mesh, at=None: scene.put("sideboard", mesh, at)
    put(finish("walnut", block((middle, TOP - 0.012, z + 0.006), (width + 0.05, 0.026, DEPTH + 0.03)), bevel=0.008, segments=3, uv=grain("cover", 0, 0.8)))
    put(finish("walnut", block((middle, 0.48, z), (width, 0.67, DEPTH)), bevel=0.004, uv=grain("body", 0, 0.8)))
    for x in (LEFT + 0.06, RIGHT - 0.06):
        for dz in (-0.15, 0.15):
            leg = lathe([(0, 0), (0.014, 0), (0.022, 0.14), (0.022, 0.16), (0, 0.16)]).moved(x, 0, z + dz)
            leg.uvs = [[(v * 0.2, u * 0.2) for u, v in face] for face in leg.uvs]
            put(finish("walnut", leg, smooth=40))
    doors = 4
    step = (width - 0.04) / doors
    knob = lathe([(0.005, 0), (0.005, 0.012), (0.013, 0.018), (0.014, 0.024), (0.009, 0.03), (0, 0.031)])
    knob = knob.mapped(lambda p: np.stack([p[:, 0], -p[:, 2], p[:, 1]], axis=1))
    for k in range(doors):
        x = LEFT + 0.02 + step * (k + 0.5)
        for name, low, high, axis in (("drawer", 0.66, 0.8, 0), ("door", 0.165, 0.65, 1)):
            y, h = (low + high) / 2, high - low - 0.006
            put(finish("walnut", block((x, y, front + 0.004), (step - 0.008, h, 0.016)), bevel=0.003, uv=grain("%s%d" % (name, k), axis, 0.8)))
            frame = moulding(step - 0.05, h - 0.04, FACE).moved(x, y, front + 0.0115)
            put(finish("walnut", frame, smooth=30, uv=grain("f%s%d" % (name, k), axis, 0.8)))
            kx = x if name == "drawer" else x + (step / 2 - 0.045) * (1 if k % 2 == 0 else -1)
            ky = y if name == "drawer" else 0.45
            scene.put("sideboard_knobs", finish("brass", knob.moved(kx, ky, front + 0.01), smooth=50))
    top = TOP + 0.0012
    scene.put("sideboard_things", vase(TALL, "glaze_white"), turn(at=(-0.14, top, z - 0.02)))
    scene.put("sideboard_things", dish(0.12), turn(at=(-0.5, top, z + 0.02)))
    books = Books(scene)
    books.count = 100
    books.pile([12, 3, 6], -0.92, top, z - 0.08, 31, facing=8)
