"""Writes ../glass.obj. Run it from anywhere: `python3 glass.py`. The same file comes out every time.

The room of cornell_box.py with a block of mirrors at the left back, a ball of glass right in front, and a small ball of
rough gold between them.
"""

from pathlib import Path

from cornell_box import ball, box, room
from obj import Obj


def main():
    obj = Obj(["Lucerna's room of glass and mirrors, made by make/glass.py", "MIT OR Apache-2.0"], "glass.mtl")
    room(obj)
    box(obj, "mirror_block", (-0.38, -1.0, -0.4), 0.3, 1.25, 25.0)
    ball(obj, "glass_ball", (0.42, -0.56, 0.2), 0.42, 12)
    ball(obj, "gold_ball", (-0.28, -0.8, 0.5), 0.2, 7)
    obj.write(Path(__file__).resolve().parent.parent / "glass.obj")


if __name__ == "__main__":
    main()
