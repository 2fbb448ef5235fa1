"""Two framed pictures on the back wall."""

from build import finish, grain, turn
from room import BACK
from shapes import Shape, moulding

WIDE = [(0.05, 0.0), (0.05, 0.018), (0.046, 0.024), (0.038, 0.026), (0.03, 0.021), (0.018, 0.026), (0.008, 0.017), (0.0, 0.013), (0.0, 0.0)]
THIN = [(0.018, 0.0), (0.018, 0.02), (0.015, 0.022), (0.003, 0.022), (0.0, 0.019), (0.0, 0.0)]


def flat(width, height, z):
    w, h = width / 2, height / 2
    return Shape([(-w, -h, z), (w, -h, z), (w, h, z), (-w, h, z)], [(0, 1, 2, 3)], [[(0, 0), (1, 0), (1, 1), (0, 1)]])


def picture(art, width, height, mat, frame, profile):
    """The art, a card round it with a slanting cut, and a frame."""
    w, h = width + 2 * mat, height + 2 * mat
    parts = [finish(art, flat(width + 0.002, height + 0.002, 0.006), smooth=None)]
    card = moulding(width, height, [(mat + 0.003, 0.004), (mat + 0.003, 0.0085), (0.003, 0.0085), (0.0, 0.0062), (0.0, 0.004)])
    parts.append(finish("mat", card, smooth=None))
    parts.append(finish(frame, moulding(w, h, profile), smooth=30, uv=grain(art, 0, 0.8)))
    return parts


def build(scene):
    scene.put("picture_landscape", picture("landscape", 0.84, 0.56, 0.075, "gilt", WIDE), turn(at=(-0.82, 1.6, BACK + 0.002)))
    scene.put("picture_botanical", picture("botanical", 0.22, 0.308, 0.05, "walnut", THIN), turn(at=(0.56, 1.36, BACK + 0.002)))
