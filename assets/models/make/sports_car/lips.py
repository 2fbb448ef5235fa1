"""Rolled edges of the wheel arches, which hide the bare edge of the sheet, and what returns behind them; beads along the glass; side markers."""

import numpy as np

from edges import rim
from mesh import joined, smooth
from fields import fillet
from panels import ARCHES, INTAKE
from shapes import disk, oriented, sweep
from shell import pair
from surface import on_side

# Where the beads of the front and the rear arch begin and end, in degrees from straight ahead over the top.
TURNS = ((-29, 206), (-27, 199))
# How far in the return of an arch reaches, where the liner begins.
LINER = .94


def arch(skin, turns, z, y, radius):
    """The bead along an arch, and the wall from it to the liner."""
    turn = np.radians(np.linspace(*turns, 50))
    edge = np.array([on_side(skin, z + radius * np.cos(a), y + radius * np.sin(a), -.0035) for a in turn])
    edge[1:-1] = (edge[:-2] + 2 * edge[1:-1] + edge[2:]) / 4
    bead = oriented(sweep("arch_lip", "paint", edge, disk(.0068, 7), 60))
    inner = edge.copy()
    inner[:, 0] = np.minimum(edge[:, 0] - .02, LINER)
    n = len(turn)
    faces = [[k, n + k, n + k + 1, k + 1] for k in range(n - 1)]
    wall = smooth("arch_return", "liner", np.concatenate([edge, inner]), faces, 60)
    inwards = (0, y, z) - wall.points[0]
    return bead, wall if wall.normals[wall.corners[0][0]] @ inwards > 0 else wall.flipped()


def intake(skin):
    """The rolled lip of the side intake."""
    path = np.array([on_side(skin, z, y, -.0045) for z, y in fillet(INTAKE, .03)])
    path = path[np.linalg.norm(path - np.roll(path, 1, 0), axis=1) > .004]
    for _ in range(2):
        path = (np.roll(path, 1, 0) + 2 * path + np.roll(path, -1, 0)) / 4
    return oriented(sweep("intake_lip", "paint", path, disk(.0068, 8), 60, closed=True))


def marker(skin, material, z, y, long, high):
    """A domed lens on the flank, half so `long` and `high`, in a black bezel."""
    turn = np.arange(24) * 2 * np.pi / 24
    c, s = np.cos(turn), np.sin(turn)
    c, s = np.sign(c) * np.abs(c) ** .6, np.sign(s) * np.abs(s) ** .6
    rows = [[on_side(skin, z + t * long * a, y + t * (high * b + .10 * long * a), .0045 - .004 * t ** 3) for a, b in zip(c, s)] for t in (1, .92, .75, .4)]
    n = len(turn)
    faces = [[i * n + k, i * n + (k + 1) % n, (i + 1) * n + (k + 1) % n, (i + 1) * n + k] for i in range(len(rows) - 1) for k in range(n)]
    faces.append([(len(rows) - 1) * n + k for k in range(n)])
    lens = smooth("side_marker", material, np.array(rows).reshape(-1, 3), faces, 60)
    lens = lens if lens.normals[lens.corners[-1][0]][0] > 0 else lens.flipped()
    return [lens, oriented(sweep("side_marker_bezel", "gloss_black", np.array(rows[0]), disk(.0034, 8), 60, closed=True))]


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
    out.append(intake(skin))
    out += [moulding(skin)] + marker(skin, "indicator", 1.85, .402, .046, .013) + marker(skin, "tail_reflector", -1.80, .452, .050, .013)
    return [p for part in out for p in pair(part)]
