"""The parts that the body's regions become: painted panels with gaps, glass with its edges, intakes, lamps' lenses."""

import numpy as np

from mesh import joined
from fields import FRONT, Outline
from panels import FRAME, FUNNEL, MOUTHS, VENT_DEPTH

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
        part = skin.part(name, "paint", {name}, fold=.020 if name != "body" else .024, lip=.0034)
        out += pair(part) if name in ("door", "flap") else [both(part)]
    out.append(both(skin.part("gaps", "gap_black", {"gap"}, offset=-.017)))
    out.append(both(skin.part("valance", "trim_black", {"valance"}, offset=-.010, fold=.02, lip=.003)))
    out += pair(skin.part("handle", "paint", {"handle"}, offset=.001, fold=.012, lip=.003))
    out.append(both(skin.part("cowl", "trim_black", {"cowl"}, offset=-.006, fold=.02, lip=.003)))
    return out


def windows(skin):
    out = []
    for name, glass in (("windscreen", "glass_windscreen"), ("side_window", "glass_side"), ("quarter", "glass_side"), ("rear_window", "glass_rear")):
        seal = skin.part(name + "_seal", "rubber", {name + "_seal"}, offset=-.005)
        frit = skin.part(name + "_frit", "frit", {name + "_frit"}, offset=-.0045)
        pane = skin.part(name, glass, {name}, offset=-.0045)
        for part in (seal, frit, pane):
            out += pair(part) if name in ("side_window", "quarter") else [both(part)]
    return out + pair(skin.part("pillar", "gloss_black", {"pillar"}, offset=-.001, fold=.008, lip=.0015))


def linings(rough):
    """What is seen of the cabin from inside: roof lining and door cards."""
    cabin = lambda t: t[0] == "top" and 5 < t[1] < 12 and t[2] < 3
    doors = lambda t: (t[0] == "side" and 5 < t[1] < 11 and t[2] < 8) or (t[0] == "top" and 5 < t[1] < 11 and t[2] in (3, 4))
    engine = lambda t: t[0] == "top" and 11 < t[1] < 15 and t[2] < 2
    lining = rough.part("lining", "lining", {"body"}, offset=-.031, pick=cabin)
    posts = rough.part("post_lining", "trim_black", {"pillar", *(w + e for w in ("windscreen", "side_window", "quarter") for e in ("_frit", "_seal"))}, offset=-.031, pick=cabin)
    cards = rough.part("door_cards", "leather", {"body"}, offset=-.05, pick=doors)
    bay = rough.part("lid_inside", "gap_black", {"body"}, offset=-.045, pick=engine)
    tail = rough.part("tail_mesh", "grille_fine", {"between_lamps"}, offset=-.062, pick=lambda t: t[0] == "rear" and t[2] < 2)
    mouth = lambda t: t[0] == "front"
    mesh = planar(both(rough.part("intake_mesh", "grille", {"body"}, offset=-.085, pick=mouth)), (0, 1), 14)
    dark = both(rough.part("intake_back", "gap_black", {"body"}, offset=-.15, pick=mouth))
    return [mesh, dark, both(planar(tail, (0, 1), 20)), both(lining.flipped()), both(posts.flipped()), both(cards.flipped()), both(bay)]


def mouths(skin):
    """The intakes of the nose: frames that lead inwards, bars, and walls behind; the mesh is one for all."""
    out = []
    for name, (outline, _) in MOUTHS.items():
        hole = Outline(outline, FRONT, .03)
        funnel = lambda p: -.002 - FUNNEL * (1 - np.clip(hole(p) / FRAME, 0, 1))
        row = [skin.part(name + "_frame", "paint", {name + "_frame"}, offset=funnel, fold=.02, lip=.005),
               skin.part(name + "_bars", "gloss_black", {name + "_bar"}, offset=-FUNNEL - .008, fold=.03, lip=.003),
               skin.part(name + "_walls", "trim_black", {name, name + "_bar"}, offset=-FUNNEL, fold=.14, lip=.004, walls=True)]
        for part in row:
            out += [both(part)] if name == "centre_intake" else pair(part)
    return out + pair(skin.part("outer_wings", "paint", {"outer_wing"}, fold=.06, lip=.004))


def openings(skin):
    """Meshes, walls and darkness behind the other holes."""
    out = mouths(skin)
    out += pair(skin.part("intake_frame", "paint", {"intake_frame"}, offset=-.001, fold=.03, lip=.006))
    out += pair(skin.part("bonnet_vent_frame", "gloss_black", {"bonnet_vent_frame"}, offset=-.002, fold=.01))
    out += pair(skin.part("intake_blade", "paint", {"intake_blade"}, offset=-.006, fold=.07, lip=.004, into=(-1, 0, 0)))
    for name, depth, axes, back, ahead in (("vent", .045, (0, 1), .09, (0, 0, 1.0)), ("intake", .15, (2, 1), .20, (-1.0, 0, 0)), ("bonnet_vent", .045, (0, 2), .075, (0, -1.0, 0))):
        push = lambda d: (lambda p, n: p + np.array(ahead) * d)
        start = -VENT_DEPTH if name == "vent" else 0.0
        out += pair(skin.part(name + "_walls", "trim_black", {name, name + "_blade"}, offset=start, fold=back, lip=.004, walls=True, into=ahead))
        out += pair(planar(skin.part(name + "_mesh", "grille", {name, name + "_blade"}, shift=push(depth)), axes, 14))
        out += pair(skin.part(name + "_back", "gap_black", {name, name + "_blade"}, shift=push(back)))
    return out


def lamps(skin):
    lens = skin.part("lamp_lens", "lamp_lens", {"lamp"}, fold=.004, lip=.0015)
    drop = lambda p, n: p + np.array((-.01, -.075, -.035))
    floor = skin.part("lamp_housing", "lamp_housing", {"lamp"}, shift=drop)
    walls = skin.part("lamp_walls", "lamp_housing", {"lamp"}, fold=.085, lip=.003, walls=True)
    return pair(lens) + pair(floor) + pair(walls)


def all_parts(skin, rough):
    return panels(skin) + windows(skin) + linings(rough) + openings(skin) + lamps(skin)
