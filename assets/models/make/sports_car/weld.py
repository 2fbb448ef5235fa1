"""What cutting leaves on a skin is tidied: short edges, lines of too many corners, holes of a few edges."""

import numpy as np

from edges import rim
from mesh import DIGITS, area

# What a line between regions may move when it is simplified.
BEND = 4e-4


def borders(skin):
    """Of each corner the regions about it; of each edge the regions on its sides; of corners on lines between regions, the next ones."""
    around, sides = {}, {}
    for f, l in zip(skin.faces, skin.labels):
        for a, b in zip(f, f[1:] + f[:1]):
            around.setdefault(a, set()).add(l)
            sides.setdefault((min(a, b), max(a, b)), []).append(l)
    lines = {}
    for (a, b), labels in sides.items():
        if len(set(labels)) == 2:
            lines.setdefault(a, []).append(b)
            lines.setdefault(b, []).append(a)
    return around, sides, lines


def weld(skin, shorter=.0075, straight=.03):
    """Collapses short edges, towards the corner where more regions meet, so that no line between regions moves. Along such a
    line edges are joined up to the length `straight`, where it bends by nothing that is seen."""
    around, sides, lines = borders(skin)

    def bends(drop, keep):
        """How far a corner of a line lies from the edge that would take its place."""
        ends = lines.get(drop, [])
        if len(ends) != 2 or len(around[drop]) != 2 or keep not in ends or ends[0] in busy or ends[1] in busy:
            return np.inf
        a, b = skin.points[ends]
        t = np.clip((skin.points[drop] - a) @ (b - a) / max((b - a) @ (b - a), 1e-12), 0, 1)
        return round(np.linalg.norm(skin.points[drop] - a - t * (b - a)), DIGITS)

    holders = {}
    for k, f in enumerate(skin.faces):
        for v in f:
            holders.setdefault(v, []).append(k)

    goal, busy = {}, set()

    def turns(drop, keep):
        """Whether a face would be folded over."""
        for k in holders[drop]:
            row = [goal.get(v, v) for v in skin.faces[k]]
            moved = [keep if v == drop else v for v in row]
            moved = [v for i, v in enumerate(moved) if v != moved[i - 1]]
            if len(set(moved)) > 2 and area(skin.points[moved]) @ area(skin.points[row]) < -1e-15:
                return True
        return False

    for (a, b), labels in sides.items():
        if a in busy or b in busy:
            continue
        length = round(np.linalg.norm(skin.points[a] - skin.points[b]), DIGITS)
        if shorter < length < straight and bends(b, a) < BEND and not turns(b, a):
            goal[b] = a
            busy |= {*lines[b], b}
            continue
        if length > shorter:
            continue
        if len(labels) < 2 or (skin.points[a, 0] == 0) != (skin.points[b, 0] == 0):
            continue
        m, n = len(around[a]), len(around[b])
        if m == n and m > 1 and len(set(labels)) < 2:
            continue
        keep, drop = (a, b) if m >= n else (b, a)
        if turns(drop, keep):
            continue
        goal[drop] = keep
        for f in (a, b):
            busy.add(f)
    rows = []
    for f in skin.faces:
        g = [goal.get(v, v) for v in f]
        rows.append([v for i, v in enumerate(g) if v != g[i - 1]])
    good = [k for k, f in enumerate(rows) if len(f) > 2 and len(set(f)) == len(f)]
    for name in ("labels", "tags", "parents", "order"):
        setattr(skin, name, [getattr(skin, name)[k] for k in good])
    skin.faces = [rows[k] for k in good]


def mend(skin, longest=6):
    """Fills the holes of a few edges that collapsing others left."""
    after = {}
    for a, b in rim(skin.points, skin.faces):
        after.setdefault(b, []).append(a)
    side = {(a, b): k for k, f in enumerate(skin.faces) for a, b in zip(f, f[1:] + f[:1])}
    done = set()
    for start in sorted(after):
        loop = [start]
        while len(loop) <= longest and len(after.get(loop[-1], ())) == 1 and after[loop[-1]][0] not in loop:
            loop.append(after[loop[-1]][0])
        if len(loop) < 3 or len(loop) > longest or after.get(loop[-1]) != [start] or done & set(loop):
            continue
        done |= set(loop)
        near = side[loop[1], loop[0]]
        skin.faces.append(loop)
        for row in (skin.labels, skin.tags, skin.parents, skin.order):
            row.append(row[near])
