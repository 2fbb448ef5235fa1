"""Rolled lips of the wheel arches and of the intakes, what returns behind the arches, the vane of the side intake, and beads along the glass."""

import numpy as np

from edges import rim
from mesh import joined, smooth, unit
from panels import ARCHES, CORNERS, INTAKE, corner
from shapes import disk, oriented, sweep
from shell import INWARDS, both, pair
from surface import nearest

# Where the lips of the front and the rear arch begin and end where no rounded corner does it, in degrees from straight ahead over the top.
ENDS = ((-29, 209), (-29, 209.5))
# Radius of a lip, in how many steps it turns, and how wide it is across, radius included; and over how many degrees that of an arch grows from nothing at its ends.
RADIUS, BENDS, WIDE, MOUTH_RADIUS, GROWS = .010, 6, .024, .012, 7.0
# Of the vane in the side intake: how far behind the opening, how long and how thick.
VANE_BACK, VANE_LONG, VANE_THICK = .034, .085, .007
# How far in the return of an arch reaches, where the liner begins.
LINER = .80


def outside(skin, z, y):
    """A point of the flank and the way out of it."""
    x, n = nearest(skin, (y, z), (1, 2), 0, 1, .3)
    return np.array((x, y, z)), n


def rolled(name, edge, looks, inner, radius=RADIUS, closed=False, out=None):
    """A lip along an edge of the sheet: it bends into the opening and goes straight in from there. `looks`: the way out of the sheet at each point of the
    edge; `inner`: the way into the opening; `radius`: one for all, or one a point; `out`: against the way in which the lip goes in, if not that of the sheet."""
    looks = unit(looks)
    out = looks if out is None else np.broadcast_to(np.asarray(out, float), looks.shape)
    inner = unit(inner - out * (inner * out).sum(1, keepdims=True))
    r = np.broadcast_to(radius, len(edge))[:, None]
    rows = [edge + out * r * (np.cos(turn) - 1) + inner * r * np.sin(turn) for turn in np.linspace(0, np.pi / 2, BENDS)]
    deep = rows[-1] - out * (WIDE - r)
    points = np.stack([*rows, deep], 1)
    n, m = points.shape[:2]
    faces = [[i * m + k, i * m + k + 1, (i + 1) % n * m + k + 1, (i + 1) % n * m + k] for i in range(n if closed else n - 1) for k in range(m - 1)]
    part = smooth(name, "paint", points.reshape(-1, 3), faces, 80)
    part = part if part.normals[part.corners[0][0]] @ out[0] > 0 else part.flipped()
    # Along the edge the lip is shaded as the sheet is.
    lip = {i * m: i for i in range(n)}
    for face, corners in zip(part.faces, part.corners):
        for v, c in zip(face, corners):
            if v in lip:
                part.normals[c] = looks[lip[v]]
    return part, deep


def turns(k):
    """Where the lip of an arch begins and ends, in degrees: at a rounded corner where there is one."""
    z, y, radius = ARCHES[k]
    out = list(ENDS[k])
    for arch, way in CORNERS:
        if arch == k:
            centre, _ = corner(z, y, radius, way)
            turn = np.degrees(np.arcsin((centre[1] - y) / np.hypot(centre[0] - z, centre[1] - y)))
            out[0 if way > 0 else 1] = turn if way > 0 else 180 - turn
    return out


def arch(skin, k):
    """The lip along an arch, and the wall from it to the liner."""
    z, y, radius = ARCHES[k]
    degrees = np.linspace(*turns(k), 72)
    turn = np.radians(degrees)
    found = [outside(skin, z + radius * np.cos(a), y + radius * np.sin(a)) for a in turn]
    edge, out = evened(np.array([p for p, _ in found])), unit(evened(np.array([n for _, n in found])))
    inner = np.stack([0 * turn, -np.sin(turn), -np.cos(turn)], 1)
    grown = np.clip(np.minimum(degrees - degrees[0], degrees[-1] - degrees) / GROWS, .02, 1)
    lip, deep = rolled("arch_lip", edge, out, inner, RADIUS * np.sqrt(grown * (2 - grown)), out=(1.0, 0, 0))
    back = deep.copy()
    back[:, 0] = LINER
    n = len(turn)
    faces = [[k, n + k, n + k + 1, k + 1] for k in range(n - 1)]
    wall = smooth("arch_return", "liner", np.concatenate([deep, back]), faces, 60)
    inwards = (0, y, z) - wall.points[0]
    return lip, wall if wall.normals[wall.corners[0][0]] @ inwards > 0 else wall.flipped()


def evened(rows):
    """Means with the next ones, but for the ends."""
    return np.concatenate([rows[:1], (rows[:-2] + 2 * rows[1:-1] + rows[2:]) / 4, rows[-1:]])


def chain(skin, labels):
    """The corners of the skin around a region, in order; whether they close, or end on the middle line."""
    after = dict(rim(skin.points, skin.faces_of(labels)))
    ends = set(after) - set(after.values())
    ids = [min(ends) if ends else min(after)]
    while after.get(ids[-1]) not in (None, ids[0]):
        ids.append(after[ids[-1]])
    return ids, not ends


def mouth(skin, label, radius=MOUTH_RADIUS):
    """The rolled lip of an intake, from the skin's own edge."""
    ids, closed = chain(skin, {label})
    edge, out = skin.points[ids], skin.normals[ids]
    along = unit(np.roll(edge, -1, 0) - np.roll(edge, 1, 0)) if closed else unit(np.gradient(edge, axis=0))
    for _ in range(2):
        along = unit((np.roll(along, 1, 0) + 2 * along + np.roll(along, -1, 0)) / 4) if closed else unit(evened(along))
    # A region's border runs counter-clockwise, seen from outside.
    inner = np.cross(out, along)
    if not closed:
        inner[[0, -1], 0] = out[[0, -1], 0] = 0
    return rolled(label + "_lip", edge, out, inner, radius, closed)[0]


def vane(skin):
    """One upright wing in the duct, behind the middle of the opening and along its rear edge, which leads the way the duct goes."""
    into, points = unit(np.array(INWARDS)), []
    upper, lower = (np.mean(INTAKE[k:k + 2], 0) for k in (0, 2))
    sides = ((0, 0), (.06, .75), (.35, 1), (1, .2), (1, -.2), (.35, -1), (.06, -.75))
    heights = np.linspace(-.06, 1.06, 7)
    flush = np.mean([outside(skin, INTAKE[1][0] - .02, INTAKE[1][1] - .05)[0][0], outside(skin, INTAKE[3][0] + .02, INTAKE[3][1] + .06)[0][0]])
    across = np.cross(into, (0, 1, 0))
    for t in heights:
        z, y = lower + (upper - lower) * t
        points += [np.array((flush, y, z)) + into * (VANE_BACK + VANE_LONG * a) + across * VANE_THICK * b for a, b in sides]
    n, m = len(heights), len(sides)
    faces = [[i * m + k, i * m + (k + 1) % m, (i + 1) * m + (k + 1) % m, (i + 1) * m + k] for i in range(n - 1) for k in range(m)]
    faces += [list(range(m))[::-1], [(n - 1) * m + k for k in range(m)]]
    return oriented(smooth("intake_vane", "gloss_black", points, faces, 50))


def moulding(skin):
    """Beads along the edges of the glass: around the side windows, and around the windscreen."""
    names = lambda *windows: {name + ending for name in windows for ending in ("", "_seal", "_frit")}
    beads = []
    for labels in (names("side_window", "quarter") | {"pillar"}, names("windscreen")):
        path, closed = border(skin, labels)
        beads.append(oriented(sweep("moulding", "gloss_black", path, disk(.0042, 6), 60, closed=closed, cap=False)))
    return joined("mouldings", beads)


def border(skin, labels):
    """The line around regions of the skin, as points at even steps; whether it is closed, or ends on the middle line."""
    ids, closed = chain(skin, labels)
    path = skin.points[ids + ids[:1]] if closed else skin.points[ids]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    even = np.linspace(0, along[-1], int(along[-1] / .027))
    path = np.stack([np.interp(even, along, path[:, k]) for k in range(3)], 1)
    if closed:
        path = path[:-1]
    for _ in range(3):
        mean = (np.roll(path, 1, 0) + 2 * path + np.roll(path, -1, 0)) / 4
        path = mean if closed else np.concatenate([path[:1], mean[1:-1], path[-1:]])
    return path, closed


def all_parts(skin):
    arches = [arch(skin, k) for k in range(len(ARCHES))]
    out = [joined("arch_lips", [bead for bead, _ in arches]), joined("arch_returns", [wall for _, wall in arches])]
    out += [mouth(skin, "intake", RADIUS), vane(skin), moulding(skin), mouth(skin, "outer_intake")]
    return [p for part in out for p in pair(part)] + [both(mouth(skin, "centre_intake"))]
