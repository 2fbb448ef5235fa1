"""Rolled lips of the wheel arches and of the side intake, what returns behind the arches, the intake's vane, and beads along the glass."""

import numpy as np

from edges import rim
from fields import SIDE, Outline, fillet
from mesh import joined, smooth, unit
from panels import ARCHES, INTAKE, INTAKE_CORNERS, VANE
from shapes import disk, oriented, sweep
from shell import pair
from surface import nearest

# Where the lips of the front and the rear arch begin and end, in degrees from straight ahead over the top.
TURNS = ((-38, 218), (-36, 211))
# Radius of a lip, in how many steps it turns, and how wide it is across, radius included: of arches, and of the intake.
RADIUS, BENDS, ARCH_WIDE, INTAKE_WIDE = .007, 5, .025, .040
# How far in the return of an arch reaches, where the liner begins.
LINER = .80


def outside(skin, z, y):
    """A point of the flank and the way out of it."""
    x, n = nearest(skin, (y, z), (1, 2), 0, 1, .3)
    return np.array((x, y, z)), n


def rolled(name, edge, out, inner, wide, closed=False):
    """A lip along an edge of the sheet: it leaves as the sheet runs, bends into the opening, and goes straight in from there. `out`: the way out of the
    sheet at each point of the edge; `inner`: the way into the opening."""
    out = unit(out)
    inner = unit(inner - out * (inner * out).sum(1, keepdims=True))
    rows, looks = [], []
    for turn in np.linspace(0, np.pi / 2, BENDS):
        rows.append(edge + out * RADIUS * (np.cos(turn) - 1) + inner * RADIUS * np.sin(turn))
    deep = rows[-1] - out * (wide - RADIUS)
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
                part.normals[c] = out[lip[v]]
    return part, deep


def arch(skin, turns, z, y, radius):
    """The lip along an arch, and the wall from it to the liner."""
    turn = np.radians(np.linspace(*turns, 72))
    found = [outside(skin, z + radius * np.cos(a), y + radius * np.sin(a)) for a in turn]
    edge, out = evened(np.array([p for p, _ in found])), unit(evened(np.array([n for _, n in found])))
    inner = np.stack([0 * turn, -np.sin(turn), -np.cos(turn)], 1)
    lip, deep = rolled("arch_lip", edge, out, inner, ARCH_WIDE)
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


def around(points, step):
    """A closed polygon's border at even steps."""
    path = np.concatenate([points, points[:1]])
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    even = np.linspace(0, along[-1], int(along[-1] / step), endpoint=False)
    return np.stack([np.interp(even, along, path[:, k]) for k in (0, 1)], 1)


def intake(skin):
    """The rolled lip of the side intake."""
    path = around(fillet(INTAKE, INTAKE_CORNERS, 9), .012)
    found = [outside(skin, z, y) for z, y in path]
    along = np.roll(path, -1, 0) - np.roll(path, 1, 0)
    inner = np.stack([0 * along[:, 0], along[:, 0], -along[:, 1]], 1)
    middle = path.mean(0) - path[0]
    inner = inner * np.sign(inner[0, 2] * middle[0] + inner[0, 1] * middle[1])
    return rolled("intake_lip", np.array([p for p, _ in found]), np.array([n for _, n in found]), unit(inner), INTAKE_WIDE, closed=True)[0]


def vane(skin):
    """One wing across the intake, set in, from its front to its rear edge."""
    thick, height, rise = VANE
    hole = Outline(INTAKE, SIDE, INTAKE_CORNERS)
    zs = np.linspace(-.40, -.90, 101)
    line = np.stack([0 * zs, height + rise * (-.45 - zs), zs], 1)
    line = line[hole(line) < -.001][[0, *range(8, 60, 8), -1]]
    path = np.array([outside(skin, z, y)[0] - (.050, 0, 0) for _, y, z in line])
    section = [(-.030, -thick * .3), (.024, -thick), (.034, -thick * .55), (.036, 0), (.034, thick * .55), (.024, thick), (-.030, thick * .3)]
    return oriented(sweep("intake_vane", "gloss_black", path, section, 40))


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
    after = dict(rim(skin.points, skin.faces_of(labels)))
    ends = set(after) - set(after.values())
    at = min(ends) if ends else min(after)
    ids = [at]
    while after.get(ids[-1]) not in (None, ids[0]):
        ids.append(after[ids[-1]])
    path = skin.points[ids + ids[:1]] if not ends else skin.points[ids]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    even = np.linspace(0, along[-1], int(along[-1] / .027))
    path = np.stack([np.interp(even, along, path[:, k]) for k in range(3)], 1)
    if not ends:
        path = path[:-1]
    for _ in range(3):
        mean = (np.roll(path, 1, 0) + 2 * path + np.roll(path, -1, 0)) / 4
        path = mean if not ends else np.concatenate([path[:1], mean[1:-1], path[-1:]])
    return path, not ends


def all_parts(skin):
    arches = [arch(skin, turns, *a) for turns, a in zip(TURNS, ARCHES)]
    out = [joined("arch_lips", [bead for bead, _ in arches]), joined("arch_returns", [wall for _, wall in arches])]
    out += [intake(skin), vane(skin), moulding(skin)]
    return [p for part in out for p in pair(part)]
