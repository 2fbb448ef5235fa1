"""The parts that the body's regions become: painted panels with gaps, glass with its edges, intakes, lamps' lenses."""

import numpy as np

from mesh import joined
from panels import LOUVRES
from shapes import box

PAINTED = ("body", "bumper", "bonnet", "door", "tail_bumper", "lid", "flap")


def both(part, name=None):
    """The part and its mirror image as one object."""
    return joined(name or part.name, [part, part.mirrored()])


def pair(part):
    return [part.moved(name=part.name + "_left"), part.mirrored(part.name + "_right")]


def planar(part, axes, scale):
    """Texture coordinates from two of the coordinates."""
    part.uvs = part.points[:, list(axes)] * scale
    part.uv_corners = part.faces
    return part


def panels(skin):
    out = []
    for name in PAINTED:
        part = skin.part(name, "paint", {name}, fold=.014 if name != "body" else .022, lip=.0022)
        out += pair(part) if name in ("door", "flap") else [both(part)]
    out.append(both(skin.part("gaps", "gap_black", {"gap"}, offset=-.0115)))
    out += pair(skin.part("handle", "gloss_black", {"handle"}, offset=.003, fold=.012, lip=.003))
    out.append(both(skin.part("skirts", "carbon", {"skirt"}, fold=.01)))
    planar(out[-1], (2, 1), 30)
    slats = []
    for k in range(LOUVRES):
        start = -1.045 - k * .096
        lift = lambda p: .012 * ((start - p[:, 2]) / .069) - .016 * (1 - (start - p[:, 2]) / .069)
        slats.append(skin.part("slat", "paint", {"slat%d" % k}, offset=lift, fold=.007, lip=.002))
    out.append(both(joined("louvres", slats)))
    field = {"louvre_field"} | {"slat%d" % k for k in range(LOUVRES)}
    out.append(both(skin.part("louvre_walls", "gloss_black", field, fold=.04, lip=.003, walls=True)))
    return out


def windows(skin):
    out = []
    for name, glass in (("windscreen", "glass_windscreen"), ("side_window", "glass_side"), ("quarter", "glass_side"), ("rear_window", "glass_rear")):
        seal = skin.part(name + "_seal", "rubber", {name + "_seal"}, offset=-.004)
        frit = skin.part(name + "_frit", "frit", {name + "_frit"}, offset=-.002)
        pane = skin.part(name, glass, {name}, offset=-.002)
        for part in (seal, frit, pane):
            out += pair(part) if name in ("side_window", "quarter") else [both(part)]
    return out


def linings(rough):
    """What is seen of the cabin from inside: roof lining and door cards."""
    cabin = lambda t: t[0] == "top" and 5 < t[1] < 12 and t[2] < 3
    doors = lambda t: (t[0] == "side" and 5 < t[1] < 12 and t[2] < 8) or (t[0] == "top" and 5 < t[1] < 12 and t[2] in (3, 4))
    engine = lambda t: t[0] == "top" and 11 < t[1] < 15 and t[2] < 2
    lining = rough.part("lining", "lining", {"body", "windscreen_frit", "side_window_frit", "quarter_frit", "windscreen_seal", "side_window_seal",
                                             "quarter_seal"}, offset=-.018, pick=cabin)
    cards = rough.part("door_cards", "leather_dark", {"body"}, offset=-.05, pick=doors)
    bay = rough.part("lid_inside", "gap_black", {"body"}, offset=-.045, pick=engine)
    tail = rough.part("tail_mesh", "grille_fine", {"body"}, offset=-.024, pick=lambda t: t[0] == "rear" and t[2] < 2)
    mouth = lambda t: t[0] == "front"
    mesh = planar(both(rough.part("intake_mesh", "grille", {"body"}, offset=-.06, pick=mouth)), (0, 1), 14)
    dark = both(rough.part("intake_back", "gap_black", {"body"}, offset=-.115, pick=mouth))
    return [mesh, dark, both(planar(tail, (0, 1), 20)), both(lining.flipped()), both(cards.flipped()), both(bay)]


def openings(skin):
    """Meshes, walls and darkness behind the holes."""
    out = []
    for name in ("centre_intake", "outer_intake", "intake"):
        frame = skin.part(name + "_frame", "gloss_black", {name + "_frame"}, offset=-.002, fold=.01)
        bars = skin.part(name + "_bars", "gloss_black", {name + "_bar"}, offset=-.014, fold=.03, lip=.003)
        for part in (frame, bars):
            out += [both(part)] if name == "centre_intake" else pair(part)
    for name, depth, axes, back in (("centre_intake", .05, (0, 1), .14), ("outer_intake", .06, (0, 1), .10), ("vent", .025, (0, 1), .06), ("intake", .075, (2, 1), .13),
                                    ("bonnet_vent", .03, (0, 2), .05)):
        ahead = np.array({"vent": (0, 0, 1.0), "intake": (-1.0, 0, 0), "bonnet_vent": (0, -1.0, 0)}.get(name, (0, 0, -1.0)))
        push = lambda d: (lambda p, n: p + ahead * d)
        whole = {name, name + "_bar"}
        wall = skin.part(name + "_walls", "trim_black", whole, fold=back, lip=.004, walls=True)
        out += [both(wall)] if name == "centre_intake" else pair(wall)
        if name in ("vent", "intake", "bonnet_vent"):
            out += pair(planar(skin.part(name + "_mesh", "grille", whole, shift=push(depth)), axes, 14))
            out += pair(skin.part(name + "_back", "gap_black", whole, shift=push(back)))
    lamp = {"tail_lamp", "tail_line"}
    panel = {"tail_panel"} | lamp
    out.append(box("tail_back", "gap_black", (0, .71, -1.985), (1.34, .20, .02), .005, 1))
    out.append(both(skin.part("tail_walls", "gloss_black", panel, fold=.05, lip=.003, walls=True)))
    out += pair(skin.part("tail_lens", "tail_lens", lamp, offset=-.004, fold=.02, lip=.003))
    out += pair(skin.part("tail_glow", "tail_light", {"tail_line"}, offset=-.009))
    out += pair(skin.part("tail_reflector", "tail_reflector", {"tail_lamp"}, offset=-.014))
    plate = skin.part("plate", "plate", {"plate"}, offset=.002, fold=.008)
    plate = both(plate)
    plate.uvs = np.stack([.5 - plate.points[:, 0] / .53, (plate.points[:, 1] - .455) / .12], 1)
    plate.uv_corners = plate.faces
    out.append(plate)
    return out


def lamps(skin):
    lens = skin.part("lamp_lens", "lamp_lens", {"lamp"}, fold=.004, lip=.0015)
    drop = lambda p, n: p + np.array((-.01, -.075, -.035))
    floor = skin.part("lamp_housing", "lamp_housing", {"lamp"}, shift=drop)
    walls = skin.part("lamp_walls", "lamp_housing", {"lamp"}, fold=.085, lip=.003, walls=True)
    return pair(lens) + pair(floor) + pair(walls)


def all_parts(skin, rough):
    return panels(skin) + windows(skin) + linings(rough) + openings(skin) + lamps(skin)
