"""The louvres of the engine cover: a frame around one opening, and slats in it that follow the deck, each a wing that falls towards its front."""

import numpy as np

from mesh import joined, smooth
from panels import LOUVRES, LOUVRE_DEPTH, LOUVRE_FRAME
from fields import TOP, Outline
from shapes import oriented
from shell import both
from surface import on_top

# How many slats, how long one is, and how much lower its front edge lies than its rear edge.
SLATS, CHORD, FALL = 7, .098, .030
# Of a slat: where along the chord from the rear (0 to 1), and the height of its upper and of its lower side.
UPPER = ((0, -.001), (.02, .0025), (.07, .0045), (.30, .006), (.65, .004), (.93, .001), (1, -.002))
LOWER = ((.93, -.005), (.3, -.004), (.03, -.004))


def half_width(z):
    """Half of the opening's width."""
    edge = LOUVRES[LOUVRES[:, 0] > 0]
    order = np.argsort(edge[:, 1])
    return np.interp(z, edge[order, 1], edge[order, 0])


def slat(skin, rear):
    """One slat, whose rear edge lies at z, flush with the deck; its ends go on below the frame."""
    points = []
    rows = np.linspace(-1, 1, 13)
    for across in rows:
        for t, high in UPPER + LOWER:
            z = rear + t * CHORD
            x = across * (half_width(z) - .004)
            points.append(on_top(skin, x, z + .030 * (1 - across * across), high - .004 - FALL * t ** 1.4))
    n, m = len(rows), len(UPPER + LOWER)
    faces = [[i * m + k, (i + 1) * m + k, (i + 1) * m + (k + 1) % m, i * m + (k + 1) % m] for i in range(n - 1) for k in range(m)]
    # Its ends, below the frame, stay open.
    return oriented(smooth("louvres", "paint", points, faces, 65))


def frame(skin):
    """The slope that leads from the deck into the opening, and walls below it."""
    hole = Outline(LOUVRES, TOP, .035)
    slope = lambda p: -.001 - LOUVRE_DEPTH * np.clip(-hole(p) / LOUVRE_FRAME, 0, 1)
    return [both(skin.part("louvre_frame", "gloss_black", {"louvre_frame"}, offset=slope, fold=.006, into=(0, -1, 0))),
            both(skin.part("louvre_walls", "trim_black", {"louvre_bay"}, offset=-LOUVRE_DEPTH, fold=.07, lip=.003, walls=True, into=(0, -1, 0)))]


def all_parts(skin, whole):
    first, last = LOUVRES[:, 1].min() + LOUVRE_FRAME + .004, LOUVRES[:, 1].max() - LOUVRE_FRAME - .030 - .040
    rears = np.linspace(first, last - .030, SLATS)
    return frame(skin) + [joined("louvres", [slat(whole, z) for z in rears])]
