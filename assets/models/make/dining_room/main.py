"""Writes ../../dining-room.obj, its MTL file and its pictures: `python main.py`, with bpy (5.0), numpy and Pillow installed.

The same files come out every time. `python main.py model` leaves the pictures out.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

import chairs
import curtains
import fruit
import lamps
import materials
import paint_art
import paint_cloth
import paint_covers
import paint_leaves
import paint_wood
import pictures
import plants
import room
import shelf
import sideboard
import table
import tableware
import window
import writer
from build import Scene

MODELS = Path(__file__).resolve().parents[2]
NAME = "dining-room"


def main():
    folder = MODELS / NAME
    folder.mkdir(exist_ok=True)
    if sys.argv[1:] != ["model"]:
        for painter in (paint_wood, paint_cloth, paint_art, paint_leaves, paint_covers):
            painter.paint(folder)
    scene = Scene()
    for part in (room, window, curtains, table, chairs, tableware, fruit, shelf, sideboard, pictures, lamps, plants):
        part.build(scene)
    writer.write(scene, MODELS / (NAME + ".obj"), NAME + ".mtl", materials.textured())
    materials.write(MODELS / (NAME + ".mtl"), NAME)


if __name__ == "__main__":
    main()
