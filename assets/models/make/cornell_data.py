"""Writes ../cornell-data.obj. Run it from anywhere: `python3 cornell_data.py`. The same file comes out every time.

The Cornell box by the measured data that Cornell University's Program of Computer Graphics published
(https://www.graphics.cornell.edu/online/box/data.html), in millimetres: what other renderers are compared on. The light is 0.5 below the
ceiling, so that no renderer has to choose between coplanar surfaces. z grows away from the camera.
"""

from pathlib import Path

from obj import Obj

QUADS = [
    ("floor", "white", [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]),
    ("ceiling", "white", [(556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)]),
    ("back", "white", [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]),
    ("right", "green", [(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]),
    ("left", "red", [(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)]),
    ("light", "light", [(343, 548.3, 227), (343, 548.3, 332), (213, 548.3, 332), (213, 548.3, 227)]),
]

# Corners of the tops, counter-clockwise from above as OBJ's right hand sees it, and heights.
BLOCKS = [
    ("short_block", [(130, 65), (82, 225), (240, 272), (290, 114)], 165),
    ("tall_block", [(423, 247), (265, 296), (314, 456), (472, 406)], 330),
]


def block(obj, name, top, height):
    """Five sides; nothing sees the sixth."""
    obj.object(name, name)
    corners = [[(x, y, z) for x, z in top] for y in (0, height)]
    low, high = corners
    for polygon in [high] + [[low[i], high[i], high[(i + 3) % 4], low[(i + 3) % 4]] for i in range(4)]:
        obj.face(polygon[:3])
        obj.face([polygon[0], polygon[2], polygon[3]])


def main():
    obj = Obj(["The Cornell box by its measured data. Made by make/cornell_data.py."], "cornell-data.mtl", smooth=False)
    for name, material, corners in QUADS:
        obj.object(name, material)
        obj.face(corners[:3])
        obj.face([corners[0], corners[2], corners[3]])
    for name, top, height in BLOCKS:
        block(obj, name, top, height)
    obj.write(Path(__file__).resolve().parent.parent / "cornell-data.obj")


main()
