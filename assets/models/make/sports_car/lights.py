"""What is inside of the head lamps: two lenses with bezels, and a strip of light along the outer edge; and the badge between them."""

import numpy as np

from letters import text
from mesh import joined, smooth
from shapes import disk, lathe, oriented, sweep
from shell import pair
from surface import look_along, nearest, on_top


def projectors(skin):
    bezels, domes, cups = [], [], []
    ahead = look_along((.12, .22, 1))
    for x, z, r in ((.712, 1.935, .030), (.792, 1.822, .028)):
        centre = on_top(skin, x, z, -.034)
        profile = [(-.05, r * 1.2), (.010, r * 1.26), (.016, r * 1.30), (.019, r * 1.26), (.018, r * 1.20)]
        cup = [(.018, r * 1.20), (.012, r * 1.06), (.010, r * .96), (-.006, r * .88), (-.012, r * .74)]
        bezels.append(oriented(lathe("bezel", "chrome", profile, 22, 40)).moved(ahead, centre))
        cups.append(lathe("cup", "gloss_black", cup, 22, 40).moved(ahead, centre))
        dome = [(-.012 + .45 * r * np.cos(a), r * .74 * np.sin(a)) for a in np.linspace(np.pi / 2, 0, 5)]
        domes.append(oriented(lathe("dome", "lamp_glow", dome, 20, 60)).moved(ahead, centre))
    return [joined("bezels", bezels), joined("cups", cups), joined("domes", domes)]


def signature(skin):
    """The strip: a bent line along the lower edge, with a hook at the inner end."""
    points = [(.640, 2.058), (.705, 2.034), (.775, 1.968), (.822, 1.885), (.845, 1.790), (.850, 1.705)]
    line = []
    for (a, b), (c, d) in zip(points, points[1:]):
        line += [(a + (c - a) * t, b + (d - b) * t) for t in np.linspace(0, 1, 5)[:-1]]
    line.append(points[-1])
    path = np.array([on_top(skin, x, z, -.016) for x, z in line])
    smooth_path = path.copy()
    for _ in range(3):
        smooth_path[1:-1] = (smooth_path[:-2] + smooth_path[2:] + 2 * smooth_path[1:-1]) / 4
    strip = sweep("light_strip", "lamp_light", smooth_path, disk(.0055, 8), 60)
    holder = sweep("strip_holder", "chrome", smooth_path - np.array((0, .010, .004)), [(-.013, -.004), (.013, -.004), (.013, .004), (-.013, .004)], 30)
    return [oriented(strip), oriented(holder)]


# Where the badge lies, ahead of the bonnet.
BADGE = 2.325
# The outline of the badge's left half, from top to foot: across and up.
SHIELD = [(0, .036), (.014, .0345), (.0275, .031), (.0285, .018), (.027, .002), (.0225, -.016), (.013, -.030), (0, -.038)]


def badge(skin):
    """A shield on the nose: a rim of chrome, black enamel in it, with a letter."""
    # Of what looks up steeply, so that the chin below is none of it.
    y, normal = nearest(skin, (0, BADGE), (0, 2), 1, 1, .7)
    centre = np.array((0, y, BADGE)) + normal * .002
    turn = look_along(normal)
    up = turn[:, 1]
    place = lambda across, high, out: centre + across * np.cross(up, normal) + high * up + normal * (.0030 + out)
    outline = SHIELD + [(-x, y) for x, y in SHIELD[-2:0:-1]]
    edge = np.array([place(x, y, 0) for x, y in outline])
    rim = oriented(sweep("badge_rim", "chrome", edge, disk(.0026, 8), 60, closed=True))
    rows = np.concatenate([edge, [place(x * .6, y * .6, .0022) for x, y in outline]])
    n = len(outline)
    faces = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)] + [list(range(n, 2 * n))]
    field = smooth("badge_field", "gloss_black", rows, faces, 60)
    field = field if field.normals[field.corners[-1][0]] @ normal > 0 else field.flipped()
    return [rim, field, text("badge_letter", "badge", "L", .034, .0034, place)]


def all_parts(skin):
    out = badge(skin)
    for part in projectors(skin) + signature(skin):
        out += pair(part)
    return out
