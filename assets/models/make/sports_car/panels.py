"""Where the body is cut: arches, doors, bonnet, bumpers, lids, windows, lamps, intakes. One table of outlines."""

import numpy as np

from cage import FRONT_AXLE, REAR_AXLE
from fields import FRONT, SIDE, TOP, Outline, circle, curve, mirrored

ARCHES = ((FRONT_AXLE, .335, .360), (REAR_AXLE, .348, .379))
GAP = .0105

side = lambda t, l: t[0] == "side"
flank = lambda t, l: t[0] == "side" or (t[0] == "top" and t[2] >= 3)
upper = lambda t, l: t[0] == "top"
nose = lambda t, l: t[0] == "top" and t[1] < 5
face = lambda t, l: t[0] == "front" or (t[0] == "side" and t[1] < 2) or (t[0] == "top" and t[1] < 1)
around_front = lambda t, l: t[0] == "front" or (t[0] in ("side", "top") and t[1] < 3)
around_rear = lambda t, l: t[0] == "rear" or (t[0] == "side" and t[1] > 11)
tail = lambda t, l: t[0] == "rear"
tail_wide = lambda t, l: t[0] == "rear" or (t[0] == "side" and t[1] > 14)
house = lambda t, l: t[0] == "top" and 5 < t[1] < 13 and t[2] in (1, 2)
roof = lambda t, l: t[0] == "top" and 5 < t[1] < 13 and t[2] < 2
deck = lambda t, l: t[0] == "top" and t[1] > 9 and t[2] < 4

WINDSCREEN = mirrored([(0, .918), (.16, .908), (.30, .878), (.42, .835), (.52, .765), (.552, .70), (.556, .55), (.545, .38), (.522, .20),
                       (.500, .07), (.30, .105), (0, .118)])
SIDE_WINDOW = [*curve([(.675, .797), (.52, .850), (.30, .934), (.05, 1.018), (-.15, 1.060), (-.36, 1.068), (-.515, 1.048)], 4),
               *curve([(-.588, .838), (-.40, .820), (-.10, .806), (.30, .793), (.60, .789)], 4)]
QUARTER = [*curve([(-.556, 1.036), (-.68, .994), (-.79, .946), (-.862, .912)], 4), (-.822, .862), (-.632, .846)]
# Black around both side windows, so that they look like one.
DAYLIGHT = [*curve([(.70, .786), (.52, .860), (.30, .944), (.05, 1.028), (-.15, 1.071), (-.36, 1.079), (-.52, 1.060), (-.70, 1.000), (-.885, .914)], 4),
            *curve([(-.832, .850), (-.64, .834), (-.40, .809), (-.10, .796), (.30, .783), (.60, .778)], 4)]
REAR_WINDOW = mirrored([(0, -.60), (.34, -.615), (.375, -.66), (.335, -.93), (.30, -.955), (0, -.955)])
LID = mirrored([(0, -.565), (.39, -.585), (.445, -.70), (.40, -1.00), (.37, -1.40), (.40, -1.74), (.36, -1.80), (0, -1.80)])
BONNET = mirrored([(0, 2.09), (.35, 2.07), (.52, 1.985), (.575, 1.80), (.555, 1.45), (.575, 1.10), (.60, .985), (.45, .965), (.20, .985), (0, .99)])
BONNET_VENT = [(.205, 1.50), (.365, 1.60), (.425, 1.53), (.395, 1.37), (.235, 1.40)]
LAMP = [(.600, 2.045), (.655, 1.93), (.735, 1.80), (.800, 1.715), (.852, 1.672), (.868, 1.735), (.858, 1.86), (.815, 1.955), (.72, 2.035), (.64, 2.075)]
DOOR = [(.865, 1.4), (.865, .74), (.900, .62), (.895, .42), (.83, .25), (.76, .195), (-.40, .195), (-.50, .25), (-.545, .40), (-.585, .60), (-.62, .76), (-.62, 1.4)]
INTAKE = [(-.618, .700), (-.700, .722), (-.860, .690), (-.895, .640), (-.872, .500), (-.800, .345), (-.735, .330), (-.690, .420), (-.655, .545)]
BUMPER = [(1.2, .455), (1.72, .462), (1.90, .505), (2.05, .515), (2.20, .545), (2.7, .53), (2.7, -.5), (1.2, -.5)]
REAR_BUMPER = [(-1.2, .60), (-1.72, .60), (-1.90, .598), (-2.7, .585), (-2.7, -.5), (-1.2, -.5)]
CENTRE_INTAKE = mirrored([(0, .385), (.30, .382), (.375, .345), (.43, .185), (.41, .165), (0, .160)])
OUTER_INTAKE = [(.505, .180), (.575, .360), (.66, .405), (.865, .425), (.890, .345), (.872, .185)]
# Of each intake of the nose: its outline and the heights of its bars.
MOUTHS = {"centre_intake": (CENTRE_INTAKE, (.235, .310)), "outer_intake": (OUTER_INTAKE, (.255, .330))}
# How wide the frame of such an intake is, and how deep it leads.
FRAME, FUNNEL = .030, .034
TAIL_PANEL = mirrored([(0, .800), (.55, .795), (.80, .768), (.822, .735), (.80, .665), (.55, .628), (0, .628)])
TAIL_LAMP = [(.435, .780), (.62, .776), (.785, .754), (.805, .730), (.790, .672), (.62, .644), (.475, .644)]
PLATE = [(-.265, .455), (.265, .455), (.265, .575), (-.265, .575)]
DIFFUSER = mirrored([(0, .40), (.50, .395), (.60, .33), (.66, .05), (0, .05)])
VENT = [(.66, .33), (.70, .43), (.83, .46), (.85, .40), (.83, .345)]
HANDLE = [(-.30, .672), (-.475, .690), (-.49, .672), (-.47, .655), (-.31, .641)]
LOUVRES = 7


def louvre(k):
    """The outline of slat k of the engine lid."""
    pitch = .096
    z = -1.045 - k * pitch
    wide = lambda z: .500 + .03 * np.clip((z + 1.05) / -.7, 0, 1) - .05 * np.sin(np.pi * np.clip((z + 1.05) / -.7, 0, 1))
    a, b = z, z - pitch * .72
    return Outline(mirrored([(0, a), (wide(a), a - .008), (wide(b), b - .008), (0, b)]), TOP, (0, .012, .012, 0, .012, .012))


def fine(tag):
    """Where small things are cut out of the skin, so that it stays at its finest."""
    patch, i, j = tag
    if patch == "front":
        return i >= 2
    if patch == "rear":
        return j < 2 or i > 2
    if patch == "side":
        return 5 < i < 13 and j < 8 or i > 14
    return (i < 4 and j > 2) or (5 < i < 13 and j in (1, 2)) or i > 14 or (i > 11 and j == 1) or (i in (6, 7) and j < 3)


def windows(skin):
    pick = lambda where, label: (lambda t, l: l == label and where(t, l))
    for name, outline, axes, where, radius in (
            ("windscreen", WINDSCREEN, TOP, roof, .02), ("side_window", SIDE_WINDOW, SIDE, house, .012),
            ("quarter", QUARTER, SIDE, house, .012)):
        window = Outline(outline, axes, radius)
        skin.region(name + "_seal", window, pick(where, "body"))
        skin.region(name + "_frit", window, pick(where, name + "_seal"), -.007)
        skin.region(name, window, pick(where, name + "_frit"), -.034 if name == "windscreen" else -.013)
    skin.region("pillar", Outline(DAYLIGHT, SIDE, .012), pick(house, "body"))


def cut(skin):
    """Labels every face of the skin."""
    skin.coarsen(lambda tag: not fine(tag))
    windows(skin)
    for z, y, r in ARCHES:
        skin.region("hole", circle((z, y), r), side)
    pick = lambda where, label: (lambda t, l: l == label and where(t, l))
    lamp = Outline(LAMP, TOP, (.01, .1, .1, .06, .012, .03, .08, .08, .1, .02))
    skin.panel("lamp", lamp, nose, GAP)
    skin.panel("bumper", Outline(BUMPER, SIDE, (0, .05, .1, .1, .1, 0, 0, 0)), around_front, GAP)
    skin.panel("bonnet", Outline(BONNET, TOP, .05), nose_or_cowl, GAP)
    skin.panel("door", Outline(DOOR, SIDE, (0, .06, .1, .15, .08, .07, .07, .08, .1, .1, .06, 0)), flank, GAP)
    skin.panel("tail_bumper", Outline(REAR_BUMPER, SIDE, (0, .05, .1, 0, 0, 0)), around_rear, GAP)
    skin.panel("lid", Outline(LID, TOP, .05), deck, GAP)
    glass = Outline(REAR_WINDOW, TOP, .03)
    skin.region("rear_window_seal", glass, pick(deck, "lid"))
    skin.region("rear_window_frit", glass, pick(deck, "rear_window_seal"), -.007)
    skin.region("rear_window", glass, pick(deck, "rear_window_frit"), -.028)
    skin.region("louvre_field", Outline(mirrored([(0, -1.03), (.355, -1.035), (.325, -1.2), (.32, -1.4), (.375, -1.715), (0, -1.715)]), TOP, .02), pick(deck, "lid"))
    for k in range(LOUVRES):
        skin.region("slat%d" % k, louvre(k), pick(deck, "louvre_field"))
    skin.panel("flap", circle((-.985, .772), .058), flank, GAP * .8)
    skin.region("intake_frame", Outline(INTAKE, SIDE, .03), pick(side, "body"))
    skin.region("intake", Outline(INTAKE, SIDE, .03), pick(side, "intake_frame"), -.010)
    skin.panel("handle", Outline(HANDLE, SIDE, .012), side, .004, ("door",))
    skin.region("skirt", lambda p: p[:, 1] - (.178 + .012 * np.clip(-p[:, 2], 0, 1)), lambda t, l: side(t, l) and l in ("body", "door") and 3 < t[1] < 13)
    skin.region("bonnet_vent", Outline(BONNET_VENT, TOP, .02), pick(nose, "bonnet"))
    for name, (outline, bars) in MOUTHS.items():
        hole = Outline(outline, FRONT, .03)
        skin.region(name + "_frame", hole, pick(face, "bumper"), FRAME)
        skin.region(name, hole, pick(face, name + "_frame"))
        for y in bars:
            skin.region(name + "_bar", lambda p: np.abs(p[:, 1] - y - .05 * (p[:, 0] > .45) * (p[:, 0] - .45)) - .006, pick(face, name))
    panel = Outline(TAIL_PANEL, FRONT, .02)
    skin.region("tail_panel", panel, lambda t, l: tail_wide(t, l) and l in ("body",))
    skin.region("tail_lamp", Outline(TAIL_LAMP, FRONT, .02), pick(tail_wide, "tail_panel"))
    skin.panel("plate", Outline(PLATE, FRONT, .012), tail, .004, ("tail_bumper",))
    skin.region("diffuser", Outline(DIFFUSER, FRONT, .03), pick(tail_wide, "tail_bumper"))
    skin.region("vent", Outline(VENT, FRONT, .02), pick(tail_wide, "tail_bumper"))
    for _ in range(2):
        skin.coarsen()
    for _ in range(6):
        skin.weld()
    skin.mend()


def cut_roughly(skin):
    """The windows alone, for what is seen from inside."""
    skin.within = .006
    windows(skin)
    skin.region("rear_window", Outline(REAR_WINDOW, TOP, .03), lambda t, l: deck(t, l) and l == "body")
    for _ in range(2):
        skin.coarsen()
    for _ in range(4):
        skin.weld()
    skin.mend()


nose_or_cowl = lambda t, l: t[0] == "top" and t[1] < 7 and t[2] < 4
