"""Writes ../../sports-car.obj, .mtl, sports-car-road.obj, .mtl and their textures: `python3 make/sports_car/main.py`.

It needs numpy and Pillow. The same files come out every time.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

import cage
import chassis
import diffuser
import exhausts
import interior
import land
import lights
import lips
import louvres
import materials
import mesh
import mirrors
import mtl
import panels
import plants
import pocket
import road
import shell
import sill
import skirt
import tail
import textures
import treeline
import wheels
import wipers

# Textured materials whose parts have no coordinates of their own get them by the axis a face looks along.
BOXED = {"leather": 5, "carbon": 30}
MODELS = Path(__file__).resolve().parent.parent.parent


def main():
    skin = cage.body(4)
    whole = cage.body(3)
    rough = cage.body(3)
    panels.cut(skin)
    panels.cut_roughly(rough)
    parts = shell.all_parts(skin, rough) + lights.all_parts(whole) + tail.all_parts(skin, whole)
    parts += louvres.all_parts(skin, whole) + diffuser.all_parts(skin) + pocket.all_parts(skin, whole) + exhausts.all_parts(skin, whole)
    parts += skirt.all_parts(whole) + sill.all_parts(whole) + mirrors.all_parts() + wipers.all_parts(whole)
    parts += lips.all_parts(skin) + chassis.all_parts() + wheels.wheels() + interior.all_parts()
    for part in parts:
        if part.uvs is None and part.material in BOXED:
            road.soft_uv(part, BOXED[part.material])
    mesh.write(MODELS / "sports-car.obj", ["A sports car. Metres, y up, nose towards +z. Made by make/sports_car/main.py."], "sports-car.mtl", parts)
    mtl.write(MODELS / "sports-car.mtl", ["A sports car."], "sports-car", materials.CAR)
    # Of the road, what has most faces comes first, where indices are short.
    mesh.write(MODELS / "sports-car-road.obj", ["A road with kerb, wall and trees, for the sports car. Metres, y up. Made by make/sports_car/main.py."],
               "sports-car-road.mtl", plants.all_parts() + treeline.all_parts() + road.all_parts() + land.all_parts(), "%.3f")
    mtl.write(MODELS / "sports-car-road.mtl", ["The sports car's road."], "sports-car", materials.ROAD)
    textures.write(MODELS / "sports-car")


if __name__ == "__main__":
    main()
