"""The parts that the body's regions become: painted panels with gaps, glass with its edges, intakes, lamps' lenses."""

import numpy as np

from mesh import joined, unit
from panels import DEPTH, LIP, MOUTHS

# Which way the intakes of the nose lead, and those of the sides; how deep the walls of their ducts go, where the mesh is, and the end.
BACK, INWARDS = (0, -.10, -1.0), (-.90, 0, -.44)
NOSE_WALL, NOSE_MESH, NOSE_END, SIDE_WALL = .108, .088, .165, .20
# How far behind the skin the walls of the nose begin, below the rolled lips.
LIPPED = .012
PAINTED = ("body", "bumper", "bonnet", "door", "tail_bumper", "engine_lid", "handle")


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


def sheet(skin, name):
    """A painted panel up to its rounded lips, and the dark walls below these, which make its shut lines alike from wherever one looks."""
    part = skin.part(name, "paint", {name}, fold=DEPTH - LIP, lip=LIP)
    first = len(part.faces) - part.folds
    wall = lambda k: k >= first and (k - first) % 2 == 1
    return [part.only(lambda k: not wall(k)), part.moved(name=name + "_edges").only(wall, "gap_black")]


def panels(skin):
    out = []
    for name in PAINTED:
        for part in sheet(skin, name):
            out += pair(part) if name in ("door", "handle") else [both(part)]
    out.append(both(skin.part("gaps", "gap_black", {"gap"}, offset=-DEPTH)))
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
    mouth = lambda t: t[0] == "front"
    # Straight back, below the bonnet, and a little in from the sides, so that it fills the openings and stays below the skin.
    back = lambda far: (lambda p, n: p * (.968, 1, 1) + far * np.array(BACK))
    mesh = planar(both(rough.part("intake_mesh", "grille", {"body"}, shift=back(NOSE_MESH), pick=mouth)), (0, 1), 14)
    dark = both(rough.part("intake_back", "gap_black", {"body"}, shift=back(NOSE_END), pick=mouth))
    return [mesh, dark, both(lining.flipped()), both(posts.flipped()), both(cards.flipped()), both(bay)]


def openings(skin):
    """The ducts behind the openings of the nose and of the sides: walls, and darkness at the end; the mesh of the nose is one for all."""
    out = []
    for name in MOUTHS:
        walls = skin.part(name + "_walls", "trim_black", {name}, offset=-LIPPED, fold=NOSE_WALL - LIPPED, lip=.004, walls=True, into=BACK)
        out += [both(walls)] if name == "centre_intake" else pair(walls)
    into = np.array(INWARDS)
    walls = skin.part("intake_walls", "trim_black", {"intake"}, fold=SIDE_WALL, lip=.004, walls=True, into=into)
    end = skin.part("intake_back", "gap_black", {"intake"}, shift=lambda p, n: p + SIDE_WALL * unit(into))
    return out + pair(walls) + pair(end)


def lamps(skin):
    lens = skin.part("lamp_lens", "lamp_lens", {"lamp"}, fold=.004, lip=.0015)
    drop = lambda p, n: p + np.array((-.01, -.075, -.035))
    floor = skin.part("lamp_housing", "lamp_housing", {"lamp"}, shift=drop)
    walls = skin.part("lamp_walls", "lamp_housing", {"lamp"}, fold=.085, lip=.003, walls=True)
    return pair(lens) + pair(floor) + pair(walls)


def all_parts(skin, rough):
    return panels(skin) + windows(skin) + linings(rough) + openings(skin) + lamps(skin)
