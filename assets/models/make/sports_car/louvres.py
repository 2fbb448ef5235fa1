"""The louvres in the engine lid: a frame around one opening, slats that are set into it, and the engine's cover below them."""

import numpy as np

from mesh import joined, smooth
from panels import LOUVRES, LOUVRE_FRAME
from shapes import oriented
from shell import both
from surface import on_top

# How many slats; of the pitch, how much is slat; how much lower its front edge lies than its rear edge; and how far it bows to the rear in the middle.
SLATS, SHARE, FALL, BOW = 7, .60, .020, .012
# Of a slat: where along its chord from the rear (0 to 1), and the height of its upper and of its lower side. The rear edge is round.
UPPER = ((0, -.007), (.004, -.003), (.03, -.0005), (.10, 0), (.55, 0), (.92, -.002), (1, -.007))
LOWER = ((.92, -.012), (.10, -.014), (.03, -.0135), (.004, -.011))
# How deep the opening is, and how far the slats end from its walls.
DEEP, ENDS = .042, .0055
DOWN = (0, -1.0, 0)


def half_width(z):
    """Half of the opening's width, frame included."""
    edge = LOUVRES[LOUVRES[:, 0] > 0]
    order = np.argsort(edge[:, 1])
    return np.interp(z, edge[order, 1], edge[order, 0])


def slat(skin, rear, chord):
    """One slat, whose rear edge lies at z, flush with the deck."""
    points = []
    rows = np.linspace(-1, 1, 13)
    for across in rows:
        for t, high in UPPER + LOWER:
            z = rear + t * chord - BOW * (1 - across * across)
            x = across * (half_width(z) - LOUVRE_FRAME - ENDS)
            points.append(on_top(skin, x, z, high - .003 - FALL * max(0, t - .1) ** 1.3))
    n, m = len(rows), len(UPPER + LOWER)
    faces = [[i * m + k, (i + 1) * m + k, (i + 1) * m + (k + 1) % m, i * m + (k + 1) % m] for i in range(n - 1) for k in range(m)]
    faces += [list(range(m))[::-1], list(range((n - 1) * m, n * m))]
    return oriented(smooth("louvres", "paint", points, faces, 50))


def frame(skin):
    """A dark rim that stands a little above the lid, and walls down to the cover."""
    rim = skin.part("louvre_frame", "gloss_black", {"louvre_frame"}, offset=.0015, fold=DEEP, lip=.003, into=DOWN)
    cover = skin.part("engine_cover", "trim_black", {"louvre_bay"}, shift=lambda p, n: p + DEEP * np.array(DOWN))
    return [both(rim), both(cover)]


def all_parts(skin, whole):
    first, last = LOUVRES[:, 1].min() + LOUVRE_FRAME, LOUVRES[:, 1].max() - LOUVRE_FRAME
    # Gaps ahead of the first and behind the last slat are as wide as those between.
    pitch = (last - first) / (SLATS + 1 - SHARE)
    rears = first + pitch * (1 - SHARE) + pitch * np.arange(SLATS) + BOW / 2
    return frame(skin) + [joined("louvres", [slat(whole, z, pitch * SHARE) for z in rears])]
