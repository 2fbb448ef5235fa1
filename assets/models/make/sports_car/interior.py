"""The cabin: two bucket seats with belts, dashboard with binnacle and screen, steering wheel, console, bulkhead, carpet."""

import numpy as np

from mesh import Part, joined, unit
from shapes import box, lathe, oriented, plate, soft_loft, sweep, tube, turned

# How far all of it stands ahead of where its numbers have it.
FORWARD = .175
# Path of a seat's middle: y, z, width, how deep the bolsters are.
SEAT = ((.245, .235, .78, .3), (.278, .10, .98, .9), (.262, -.05, 1.0, 1.0), (.262, -.17, 1.0, .9), (.315, -.275, 1.0, .9), (.42, -.325, 1.0, 1.1),
        (.55, -.375, 1.02, 1.25), (.68, -.43, 1.0, 1.1), (.765, -.468, .78, .6), (.80, -.483, .52, .3), (.93, -.525, .46, .2), (.955, -.537, .34, .1))
SECTION = ((-.245, -.01), (-.235, .075), (-.18, .085), (-.125, .022), (0, .012), (.125, .022), (.18, .085), (.235, .075), (.245, -.01), (.17, -.055), (0, -.06), (-.17, -.055))
INSERT = ((-.115, .012), (-.10, .036), (0, .030), (.10, .036), (.115, .012), (0, -.01))


def along(path, section, scale_depth=True):
    p = np.array([(0, y, z) for y, z, _, _ in path])
    t = unit(np.gradient(p, axis=0))
    rings = []
    for k, (_, _, w, d) in enumerate(path):
        n = np.array((0, -t[k][2], t[k][1]))
        if n[1] + n[2] < 0:
            n = -n
        rings.append([p[k] + np.array((u * w, 0, 0)) + n * (v * (d if v > .03 and scale_depth else 1)) for u, v in section])
    return rings


def seat(x, word):
    shell = soft_loft("seat", "leather", along(SEAT, SECTION), 2)
    insert = soft_loft("seat_insert", "leather_dark", along(SEAT[2:9], INSERT, False), 2)
    strip = soft_loft("head_insert", "leather_dark", [[(a * .55, b, c) for a, b, c in ring] for ring in along([(y, z, 1, 1) for y, z, _, _ in SEAT[9:11]], INSERT, False)], 2)
    belt_path = [(.19, .80, -.50), (.17, .775, -.432), (.15, .66, -.365), (.10, .52, -.312), (-.02, .37, -.245), (-.16, .325, -.20), (-.215, .30, -.20)]
    belt = sweep("belt", "belt", belt_path, [(-.0015, -.022), (.0015, -.022), (.0015, .022), (-.0015, .022)], 30)
    side = 1 if x > 0 else -1
    parts = [p if side > 0 else p.mirrored() for p in (shell, insert, strip, oriented(belt))]
    base = box("seat_base", "trim_black", (x, .185, .02), (.36, .09, .40), .02)
    return [p.moved(None, (x, 0, 0), p.name + "_" + word) for p in parts] + [base]


def dashboard():
    rings = []
    for x in (-.84, -.78, -.36, 0, .17, .25, .36, .47, .55, .78, .84):
        hood = .030 * np.exp(-((x - .36) / .16) ** 4)
        drop = .02 * (abs(x) / .84) ** 2
        back = .84 - .14 * (abs(x) / .84) ** 2
        profile = ((.700 - drop, back), (.712 - drop, .68), (.718 - drop + hood * 1.3, .56), (.712 - drop + hood * 1.6, .49), (.690 - drop + hood * 1.2, .462), (.640 - drop, .485),
                   (.585, .50), (.545, .545), (.40, .60), (.30, .70), (.45, back), (.60, back))
        rings.append([(x, y, z) for y, z in profile])
    body = soft_loft("dashboard", "alcantara", rings, 1)
    band = box("dash_band", "leather", (-.22, .600, .488), (.98, .085, .024), .010)
    screen = box("screen", "gloss_black", (0, .628, .458), (.24, .135, .014), .006, turn=turned(0, -12))
    image = flat("screen_image", "screen", (0, .629, .4505), (.222, .118), -12)
    cluster = flat("cluster", "screen", (.36, .655, .4800), (.235, .085), -18)
    vents = [box("vents", "trim_black", (x, .655, .470), (.13, .035, .02), .006) for x in (-.66, -.47, .62)]
    return [body, band, screen, image, cluster, joined("vents", vents)]


def flat(name, material, centre, size, tilt):
    w, h = size[0] / 2, size[1] / 2
    points = np.array([(w, -h, 0), (-w, -h, 0), (-w, h, 0), (w, h, 0)]) @ turned(0, tilt).T + np.array(centre)
    return Part(name, material, points, [[0, 1, 2, 3]], [turned(0, tilt) @ (0, 0, -1)], [[0, 0, 0, 0]], [(0, 0), (1, 0), (1, 1), (0, 1)], [[0, 1, 2, 3]])


def steering():
    """About the z axis, then tilted; the driver sits on the left."""
    a = np.arange(36) * 2 * np.pi / 36
    r = .172 - .022 * np.clip(-np.sin(a) - .55, 0, 1) / .45
    ring = np.stack([r * np.cos(a), r * np.sin(a), 0 * a], 1)
    parts = [oriented(tube("steering_ring", "leather_dark", ring, .0155, 8, closed=True))]
    for angle in (0, 180, 270):
        spoke = box("steering_spokes", "chrome", (.10, 0, .004), (.13, .030, .010), .004)
        parts.append(spoke.moved(turned(2, angle)))
    boss = lathe("steering_boss", "trim_black", [(.03, .052), (-.004, .056), (-.014, .048), (-.018, 0)], 28, 30)
    parts.append(oriented(boss).moved(np.array([[0, 0, -1], [0, 1, 0], [1, 0, 0]], float)))
    mark = box("steering_mark", "caliper", (0, .172, 0), (.016, .030, .030), .006)
    column = tube("steering_column", "trim_black", [(0, 0, .02), (0, 0, .22)], .035, 16)
    tilt = turned(0, 22)
    groups = [parts[0], joined("steering_spokes", parts[1:4]), parts[4], mark, oriented(column)]
    return [oriented(p).moved(tilt, (.36, .655, .270)) for p in groups]


def console():
    tunnel = soft_loft("console", "leather_dark", [[(s * w, y, z) for s, y in ((-1, .13), (-1, h - .03), (-.8, h), (.8, h), (1, h - .03), (1, .13))]
                                                   for z, w, h in ((-.56, .11, .40), (-.53, .115, .43), (-.25, .115, .43), (.05, .11, .40), (.35, .11, .45), (.55, .12, .55), (.60, .12, .55))], 1)
    top = box("console_top", "carbon", (0, .425, -.02), (.15, .012, .34), .004, turn=turned(0, 5))
    lever = lathe("gear_knob", "chrome", [(0, .012), (.05, .012), (.06, .022), (.085, .024), (.10, .016), (.104, 0)], 24, 40)
    m = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
    return [tunnel, top, oriented(lever).moved(m, (0, .42, .10))]


def doors():
    """An armrest on each door, and a bar to pull it shut by."""
    rests = [box("armrests", "leather_dark", (side * .765, .590, .02), (.085, .055, .46), .020, 2) for side in (-1, 1)]
    path = np.array([(.775, .640, -.10), (.745, .665, -.07), (.742, .672, .02), (.745, .668, .11), (.775, .645, .14)])
    bar = oriented(tube("door_pulls", "chrome", path, .008, 8))
    return [joined("armrests", rests), joined("door_pulls", [bar, bar.mirrored()])]


def bulkhead():
    wall = box("bulkhead", "leather_dark", (0, .45, -.605), (1.50, .66, .04), .01)
    shelf = box("parcel_shelf", "alcantara", (0, .80, -.75), (1.30, .02, .36), .008)
    carpet = plate("carpet", "carpet", [(-.86, -.60), (.86, -.60), (.86, .74), (.56, .74), (.56, .86), (-.56, .86), (-.56, .74), (-.86, .74)], .135, .15)
    toe = box("toe_board", "carpet", (0, .40, .86), (1.12, .56, .03), .01)
    glass_mirror = [box("inner_mirror", "trim_black", (0, 1.015, .10), (.21, .055, .025), .012), box("inner_mirror", "trim_black", (0, 1.048, .10), (.02, .05, .015), .005)]
    return [wall, shelf, carpet, toe, joined("inner_mirror", glass_mirror)]


def engine():
    """What is seen of it between the slats of the louvres: ribbed covers with a plenum between them, on a dark bed."""
    bed = box("engine_bed", "trim_black", (0, .66, -1.20), (.78, .04, .80), .01)
    plenum = [box("engine", "badge", (0, .765, -1.18), (.20, .07, .56), .025)]
    plenum += [box("engine", "badge", (side * .15, .755, z), (.16, .035, .045), .016) for side in (-1, 1) for z in np.linspace(-1.40, -.96, 6)]
    covers = [box("engine_covers", "caliper", (side * .265, .745, -1.18), (.11, .06, .58), .022) for side in (-1, 1)]
    return [bed, joined("engine", plenum), joined("engine_covers", covers)]


def all_parts():
    parts = seat(.37, "left") + seat(-.37, "right") + dashboard() + steering() + console() + doors() + bulkhead()
    return [part.moved(by=(0, 0, FORWARD)) for part in parts] + engine()
