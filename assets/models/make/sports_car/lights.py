"""What is inside of the head lamps: three projectors with bezels, and a strip of light along the outer edge; and the badge between them."""

import numpy as np

from letters import text
from mesh import joined
from shapes import disk, lathe, oriented, sweep
from shell import pair
from surface import look_along, on_face, on_top


def projectors(skin):
    bezels, domes, cups = [], [], []
    ahead = look_along((.12, .22, 1))
    for x, z, r in ((.700, 1.945, .027), (.757, 1.865, .027), (.806, 1.785, .024)):
        centre = on_top(skin, x, z, -.034)
        profile = [(-.05, r * 1.2), (.010, r * 1.26), (.016, r * 1.30), (.019, r * 1.26), (.018, r * 1.20)]
        cup = [(.018, r * 1.20), (.010, r * 1.10), (-.006, r * .86), (-.020, r * .80)]
        bezels.append(oriented(lathe("bezel", "chrome", profile, 22, 40)).moved(ahead, centre))
        cups.append(lathe("cup", "gloss_black", cup, 22, 40).moved(ahead, centre))
        dome = [(-.012 + .45 * r * np.cos(a), r * .82 * np.sin(a)) for a in np.linspace(np.pi / 2, 0, 5)]
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
    amber = [on_top(skin, x, z, -.03) for x, z in ((.665, 1.955), (.715, 1.88), (.765, 1.80), (.812, 1.735))]
    turn = sweep("indicator", "indicator", amber, disk(.005, 8), 60)
    return [oriented(strip), oriented(holder), oriented(turn)]


def badge(skin):
    """A round badge on the nose: a ring of chrome, black inside, with a letter."""
    centre, normal = on_face(skin, 0, .405, .004, 1)
    turn = look_along(normal)
    ring = lathe("badge_ring", "chrome", [(-.006, .040), (.003, .040), (.006, .038), (.006, .034), (.0035, .033)], 36, 30)
    field = lathe("badge_field", "gloss_black", [(.0034, .0332), (.0038, .016), (.004, 0)], 36, 60)
    up = turn[:, 1]
    place = lambda across, high, out: centre + across * np.cross(up, normal) + high * up + normal * (.0036 + out)
    return [oriented(ring).moved(turn, centre), oriented(field).moved(turn, centre), text("badge_letter", "badge", "L", .036, .002, place)]


def all_parts(skin):
    out = badge(skin)
    for part in projectors(skin) + signature(skin):
        out += pair(part)
    return out
