"""Where the body is cut: arches, doors, bonnet, bumpers, windows, lamps, intakes. One table of outlines."""

import numpy as np

from sculpt import FLARES, OPENING
from fields import FRONT, SIDE, TOP, Outline, below, circle, curve, mirrored
from weld import mend, weld

# Of each arch: z and y of its axle, and its radius.
ARCHES = tuple(row[:3] for row in FLARES)
# Where sill and front bumper end at an arch, below: z is ahead of or behind the axle; the height of the lower edge and the radius of the corner.
CORNERS, FOOT, ROUND = ((0, 1), (0, -1), (1, 1)), .115, .024
# How wide every shut line is, the rounding of its two lips included; their radius, and how deep its floor lies.
GAP, LIP, DEPTH = .009, .002, .012

side = lambda t, l: t[0] == "side"
flank = lambda t, l: t[0] == "side" or (t[0] == "top" and t[2] >= 3)
upper = lambda t, l: t[0] == "top"
nose = lambda t, l: t[0] == "top" and t[1] < 5
hood = lambda t, l: t[0] == "top" and t[1] < 7 and t[2] < 4
face = lambda t, l: t[0] == "front" or (t[0] == "side" and t[1] < 2) or (t[0] == "top" and t[1] < 1)
around_front = lambda t, l: t[0] == "front" or (t[0] in ("side", "top") and t[1] < 3)
around_rear = lambda t, l: t[0] == "rear" or (t[0] == "side" and t[1] > 11)
tail = lambda t, l: t[0] == "rear"
tail_wide = lambda t, l: t[0] == "rear" or (t[0] == "side" and t[1] > 14)
house = lambda t, l: t[0] == "top" and 5 < t[1] < 13 and t[2] in (1, 2)
roof = lambda t, l: t[0] == "top" and 5 < t[1] < 13 and t[2] < 2
deck = lambda t, l: t[0] == "top" and t[1] > 9 and t[2] < 4

WINDSCREEN = mirrored([*curve([(0, 1.108), (.16, 1.100), (.30, 1.074), (.42, 1.024), (.505, .948), (.545, .860), (.556, .740), (.545, .570), (.522, .390), (.500, .260)], 4),
                       *curve([(.470, .262), (.30, .293), (0, .308)], 4)])
SIDE_WINDOW = [*curve([(.845, .797), (.690, .850), (.470, .934), (.220, 1.018), (.020, 1.060), (-.190, 1.068), (-.345, 1.048)], 4),
               *curve([(-.418, .838), (-.230, .820), (.070, .806), (.470, .793), (.770, .789)], 4)]
QUARTER = [*curve([(-.386, 1.036), (-.510, .994), (-.620, .946), (-.692, .912)], 4), (-.652, .862), (-.462, .846)]
# Black around both side windows, so that they look like one.
DAYLIGHT = [*curve([(.870, .786), (.690, .860), (.470, .944), (.220, 1.028), (.020, 1.071), (-.190, 1.079), (-.350, 1.060), (-.530, 1.000), (-.715, .914)], 4),
            *curve([(-.662, .850), (-.470, .834), (-.230, .809), (.070, .796), (.470, .783), (.770, .778)], 4)]
REAR_WINDOW = mirrored([(0, -.420), (.34, -.435), (.375, -.480), (.335, -.750), (.30, -.775), (0, -.775)])
# It ends ahead at the bumper, behind at the cowl.
BONNET = mirrored([(0, 2.5), *curve([(.602, 2.5), (.596, 2.20), (.600, 1.98), (.618, 1.7445), (.6035, 1.532), (.6035, 1.418), (.609, 1.309), (.617, 1.208), (.613, 1.11), (.592, 1.042)], 5),
                   *curve([(.558, 1.006), (.512, 1.026), (.430, 1.080), (.30, 1.122), (.16, 1.146), (0, 1.153)], 5)])
# Beside the bonnet it is as wide as between that and the glass, and ends round where the glass turns up.
COWL = mirrored([(0, 1.170), *curve([(.16, 1.163), (.30, 1.139), (.440, 1.094), (.520, 1.048), (.562, 1.004), (.584, .950), (.588, .905), (.576, .872), (.548, .858)], 5), (.50, .86), (0, .86)])
LAMP = [*curve([(.598, 2.092), (.700, 2.062), (.785, 1.988), (.838, 1.893), (.862, 1.785), (.864, 1.640)], 5)[:-1],
        *curve([(.864, 1.640), (.800, 1.735), (.732, 1.838), (.660, 1.960), (.598, 2.092)], 5)[:-1]]
DOOR = [(.890, 1.4), (.890, .76), (.915, .62), (.905, .44), (.865, .250), (.80, .163), (-.24, .163), (-.345, .250), (-.395, .43), (-.420, .60), (-.45, .78), (-.45, 1.4)]
# Its front edge lies on the floor of the scoop, its rear edge is the blade's; above and below it ends at the scoop's walls.
INTAKE = [(OPENING[1][1], .672), (OPENING[2][1], .690), (OPENING[2][0], .443), (OPENING[1][0], .426)]
INTAKE_CORNERS = (.028, .022, .050, .030)
# Height of the seam above the front bumper, by x: from the bonnet's edge through the lamp to the arch.
BUMPER = curve([(0, .472), (.25, .474), (.45, .486), (.60, .512), (.75, .536), (.83, .524), (.88, .500), (.93, .475), (.99, .455), (1.2, .448)], 6)
REAR_BUMPER = [(-1.2, .60), (-1.72, .60), (-1.90, .598), (-2.7, .590), (-2.7, -.5), (-1.2, -.5)]
CENTRE_INTAKE = mirrored([(0, .318), (.30, .317), (.552, .304), (.508, .154), (.30, .149), (0, .149)])
OUTER_INTAKE = [(.634, .299), (.745, .322), (.868, .352), (.852, .166), (.594, .158)]
# The intakes of the nose, and how their corners are rounded.
MOUTHS = {"centre_intake": (CENTRE_INTAKE, .022), "outer_intake": (OUTER_INTAKE, (.022, 0, .034, .046, .022))}
# The band of light across the tail, and how deep the walls go behind its lens.
TAIL_LAMP, LAMP_DEPTH = mirrored([(0, .780), (.45, .778), (.64, .771), (.788, .759), (.788, .722), (.64, .716), (.45, .714), (0, .714)]), .050
# The lower edge of the rear bumper, and the openings for the exhausts in the valance below it.
DIFFUSER = mirrored([(0, .372), (.54, .370), *curve([(.615, .363), (.668, .338), (.698, .292), (.708, .235)], 5), (.710, .05), (0, .05)])
EXHAUST, EXHAUST_CORNER = [(.378, .352), (.592, .348), (.604, .284), (.378, .282)], .026
# The pocket of the number plate.
POCKET = mirrored([(0, .570), (.288, .570), (.288, .410), (0, .410)])
HANDLE = [(-.155, .700), (-.335, .713), (-.347, .700), (-.335, .687), (-.155, .674), (-.143, .687)]
# The engine lid; in it the louvres' opening, its frame included, and how wide that is.
LID = mirrored([(0, -.802), (.392, -.814), (.378, -1.05), (.374, -1.35), (.394, -1.752), (0, -1.764)])
LOUVRES = mirrored([(0, -.842), (.346, -.852), (.332, -1.05), (.328, -1.35), (.346, -1.696), (0, -1.706)])
LOUVRE_FRAME = .020


def fine(tag):
    """Where small things are cut out of the skin, so that it stays at its finest."""
    patch, i, j = tag
    if patch == "front":
        return i >= 2
    if patch == "rear":
        return True
    if patch == "side":
        return 5 < i < 13 and j < 8 or i > 14
    return (i < 4 and j > 2) or i < 2 or (5 < i < 13 and j in (1, 2)) or i > 14 or (i > 10 and j < 2) or (i in (6, 7) and j < 3)


def bumper(p):
    """How far above the front bumper's seam, along the surface, which lies flatter towards the middle."""
    return (p[:, 1] - np.interp(p[:, 0], *BUMPER.T)) * np.interp(p[:, 0], (0, .6, .85, .96), (2.4, 2.2, 1.6, .9))


def corner(z, y, radius, way):
    """Where the corner between a lower edge and an arch is taken off: the centre of its rounding, and a field that is negative there."""
    rise = y - FOOT - ROUND
    centre = np.array((z + way * np.sqrt((radius + ROUND) ** 2 - rise ** 2), FOOT + ROUND))
    down, across = np.array((0, -1.0)), np.array((z, y)) - centre
    across /= np.hypot(*across)
    # A point as so much of one way and so much of the other.
    split = np.linalg.inv(np.stack([down, across], 1))

    def field(p):
        off = p[:, [2, 1]] - centre
        far = np.hypot(*off.T)
        return np.maximum(np.maximum(ROUND - far, far - 4 * ROUND), .0005 - (off @ split.T).min(1))

    return centre, field


def windows(skin):
    pick = lambda where, label: (lambda t, l: l == label and where(t, l))
    for name, outline, axes, where, radius in (
            ("windscreen", WINDSCREEN, TOP, roof, .02), ("side_window", SIDE_WINDOW, SIDE, house, .012),
            ("quarter", QUARTER, SIDE, house, .012)):
        window = Outline(outline, axes, radius)
        skin.region(name + "_seal", window, pick(where, "body"))
        skin.region(name + "_frit", window, pick(where, name + "_seal"), -.007)
        skin.region(name, window, pick(where, name + "_frit"), -.026 if name == "windscreen" else -.010)
    skin.region("pillar", Outline(DAYLIGHT, SIDE, .012), pick(house, "body"))


def cut(skin):
    """Labels every face of the skin."""
    skin.coarsen(lambda tag: not fine(tag))
    windows(skin)
    for z, y, r in ARCHES:
        skin.region("hole", circle((z, y), r), side)
    for k, way in CORNERS:
        skin.region("hole", corner(*ARCHES[k], way)[1], lambda t, l: side(t, l) and l == "body")
    pick = lambda where, label: (lambda t, l: l == label and where(t, l))
    skin.panel("bonnet", Outline(BONNET, TOP, .02), hood, GAP)
    skin.region("cowl", Outline(COWL, TOP, .02), lambda t, l: l == "body" and t[0] == "top" and 2 < t[1] < 8 and t[2] < 4)
    # Each takes what it covers of the one before, so that their gaps meet.
    skin.panel("bumper", bumper, around_front, GAP, ("body", "bonnet"))
    skin.panel("lamp", Outline(LAMP, TOP, .008), nose, GAP, ("body", "bonnet", "bumper"))
    skin.panel("door", Outline(DOOR, SIDE, (0, .06, .1, .15, .08, .07, .07, .08, .1, .1, .06, 0)), flank, GAP)
    skin.panel("tail_bumper", Outline(REAR_BUMPER, SIDE, (0, .05, .1, 0, 0, 0)), around_rear, GAP)
    glass = Outline(REAR_WINDOW, TOP, .03)
    skin.region("rear_window_seal", glass, pick(deck, "body"))
    skin.region("rear_window_frit", glass, pick(deck, "rear_window_seal"), -.007)
    skin.region("rear_window", glass, pick(deck, "rear_window_frit"), -.028)
    louvres = Outline(LOUVRES, TOP, .035)
    skin.panel("engine_lid", Outline(LID, TOP, .045), deck, GAP)
    skin.region("louvre_frame", louvres, pick(deck, "engine_lid"))
    skin.region("louvre_bay", louvres, pick(deck, "louvre_frame"), -LOUVRE_FRAME)
    skin.region("intake", Outline(INTAKE, SIDE, INTAKE_CORNERS), pick(side, "body"))
    skin.panel("handle", Outline(HANDLE, SIDE, .010), flank, GAP * .8, ("door",))
    for name, (outline, radius) in MOUTHS.items():
        skin.region(name, Outline(outline, FRONT, radius), pick(face, "bumper"))
    skin.panel("tail_lamp", Outline(TAIL_LAMP, FRONT, .018), tail_wide, GAP)
    skin.region("diffuser", Outline(DIFFUSER, FRONT), pick(tail_wide, "tail_bumper"))
    skin.region("exhaust", Outline(EXHAUST, FRONT, EXHAUST_CORNER), pick(tail, "diffuser"))
    skin.region("pocket", Outline(POCKET, FRONT, .022), pick(tail, "tail_bumper"))
    for _ in range(2):
        skin.coarsen()
    for _ in range(6):
        weld(skin)
    mend(skin)


def cut_roughly(skin):
    """The windows alone, for what is seen from inside."""
    skin.within = .006
    windows(skin)
    skin.region("rear_window", Outline(REAR_WINDOW, TOP, .03), lambda t, l: deck(t, l) and l == "body")
    skin.region("behind_doors", below(2, -.42), lambda t, l: l == "body" and (t[0] == "side" or t[2] > 2))
    for _ in range(2):
        skin.coarsen()
    for _ in range(4):
        weld(skin)
    mend(skin)
