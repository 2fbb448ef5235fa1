"""Rolled edges of the wheel arches, which hide the bare edge of the sheet, and what returns behind them; side markers."""

import numpy as np

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
    turn = np.radians(np.linspace(*turns, 60))
    edge = np.array([on_side(skin, z + radius * np.cos(a), y + radius * np.sin(a), -.002) for a in turn])
    edge[1:-1] = (edge[:-2] + 2 * edge[1:-1] + edge[2:]) / 4
    bead = oriented(sweep("arch_lip", "paint", edge, disk(.0085, 8), 60))
    inner = edge.copy()
    inner[:, 0] = np.minimum(edge[:, 0] - .02, LINER)
    n = len(turn)
    faces = [[k, n + k, n + k + 1, k + 1] for k in range(n - 1)]
    wall = smooth("arch_return", "liner", np.concatenate([edge, inner]), faces, 60)
    inwards = (0, y, z) - wall.points[0]
    return bead, wall if wall.normals[wall.corners[0][0]] @ inwards > 0 else wall.flipped()


def intake(skin):
    """The rolled lip of the side intake."""
    path = np.array([on_side(skin, z, y, -.003) for z, y in fillet(INTAKE, .03)])
    path = path[np.linalg.norm(path - np.roll(path, 1, 0), axis=1) > .004]
    for _ in range(2):
        path = (np.roll(path, 1, 0) + 2 * path + np.roll(path, -1, 0)) / 4
    return oriented(sweep("intake_lip", "paint", path, disk(.0095, 8), 60, closed=True))


def marker(skin, material, low, high, height):
    """A slim lens along the flank, between two z."""
    path = np.array([on_side(skin, z, height, -.0065) for z in np.linspace(low, high, 6)])
    return oriented(sweep("side_marker", material, path, disk(.010, 10, .55), 60))


def all_parts(skin):
    arches = [arch(skin, turns, *a) for turns, a in zip(TURNS, ARCHES)]
    out = [joined("arch_lips", [bead for bead, _ in arches]), joined("arch_returns", [wall for _, wall in arches])]
    out.append(intake(skin))
    out += [marker(skin, "indicator", 1.80, 1.90, .400), marker(skin, "tail_reflector", -1.86, -1.75, .450)]
    return [p for part in out for p in pair(part)]
