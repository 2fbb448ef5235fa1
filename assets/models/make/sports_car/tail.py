"""The tail between the bumper and the lid: lamps of two rings and a bar behind a red lens, the name, the plate."""

import numpy as np

from letters import text
from mesh import joined, unit
from panels import PLATE
from shapes import box, disk, lathe, oriented, sweep, tube
from shell import both, pair
from surface import look_along, on_face

# Where the rings are, and their radius.
RINGS = ((.560, .710), (.695, .708))
RADIUS = .046


def on_tail(skin, x, y, depth):
    return on_face(skin, x, y, -depth, -1)


def rings(whole):
    """Of each ring: a dish, a ring of light in it, and a small dome."""
    dishes, lights, domes = [], [], []
    for x, y in RINGS:
        centre, normal = on_tail(whole, x, y, .024)
        behind = look_along(unit(normal * (.6, .2, 1)))
        r = RADIUS
        dish = [(-.034, 0), (-.034, r * .28), (-.030, r * .36), (-.020, r * .72), (-.004, r * .93), (.008, r), (.011, r * 1.06), (.008, r * 1.12), (-.03, r * 1.12)]
        dishes.append(lathe("tail_dishes", "tail_reflector", dish[::-1], 28, 40).moved(behind, centre))
        turn = np.arange(28) * 2 * np.pi / 28
        ring = np.stack([0 * turn + .002, r * .80 * np.cos(turn), r * .80 * np.sin(turn)], 1)
        lights.append(oriented(tube("tail_rings", "tail_light", ring, .0048, 6, closed=True)).moved(behind, centre))
        dome = [(-.034 + .022 * np.cos(a), r * .30 * np.sin(a)) for a in np.linspace(np.pi / 2, 0, 4)]
        domes.append(oriented(lathe("tail_domes", "chrome", dome, 16, 60)).moved(behind, centre))
    return [joined(row[0].name, row) for row in (dishes, lights, domes)]


def bar(whole):
    """A line of light below the lamp's upper edge, and along its outer one."""
    corners = ((.455, .768), (.54, .7675), (.62, .7655), (.70, .7555), (.772, .7440), (.786, .7335), (.789, .724), (.781, .690))
    path = np.array([on_tail(whole, x, y, .013)[0] for x, y in corners])
    return [oriented(sweep("tail_bar", "tail_light", path, disk(.0045, 8), 60))]


def lamps(skin, whole):
    lens = skin.part("tail_lens", "tail_lens", {"tail_lamp"}, offset=-.003, fold=.004, lip=.002)
    rim = skin.part("tail_lamp_walls", "gloss_black", {"tail_lamp"}, offset=-.004, fold=.085, lip=.004, walls=True)
    back = skin.part("tail_lamp_back", "lamp_housing", {"tail_lamp"}, offset=-.085)
    out = []
    for part in [lens, rim, back] + rings(whole) + bar(whole):
        out += pair(part)
    return out


def name(whole):
    """Letters of chrome before the mesh between the lamps."""
    place = lambda across, up, out: on_tail(whole, -across, .714 + up, .012 - out)[0]
    return text("name", "badge", "LUCERNA", .046, .010, place, .20, .62)


def plate(skin):
    part = both(skin.part("plate", "plate", {"plate"}, offset=.002, fold=.008))
    low, high = np.array(PLATE)[[0, 2], 1]
    part.uvs = np.stack([.5 - part.points[:, 0] / .53, (part.points[:, 1] - low) / (high - low)], 1)
    part.uv_corners = part.faces
    return part


def all_parts(skin, whole):
    panel = {"tail_panel", "tail_lamp"}
    return [box("tail_back", "gap_black", (0, .71, -1.985), (1.34, .20, .02), .005, 1), both(skin.part("tail_walls", "gloss_black", panel, fold=.05, lip=.003, walls=True)),
            name(whole), plate(skin)] + lamps(skin, whole)
