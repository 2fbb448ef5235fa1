"""A dense surface that is cut along the zero lines of fields into regions, which become parts with turned-in edges."""

import numpy as np

from edges import folded
from mesh import DIGITS, Part, area, face_normals, unit, untwisted

NEAR = 2.5e-4
# What a normal between two corners may differ from their mean.
SHADED = .011


def tilted(normals, moved, points, faces):
    """The normals of points that were moved, turned as the faces about them turned."""
    change = np.zeros_like(normals)
    for f in faces:
        change[f] += area(moved[f]) - area(points[f])
    size = np.zeros(len(points))
    for f in faces:
        size[f] += np.linalg.norm(area(points[f]))
    return unit(normals + change / np.maximum(size, 1e-12)[:, None])


class Skin:
    """`tags`: what each face belongs to (patch, row, column); `labels`: the region that it has been cut into."""

    def __init__(self, points, faces, tags, parents, grandparents):
        self.points, self.faces, self.tags = np.asarray(points, float), [list(f) for f in faces], list(tags)
        self.parents = [(1, p) for p in parents]
        self.above = dict(zip(parents, grandparents))
        self.order = list(range(len(faces)))
        self.labels = ["body"] * len(faces)
        self.within = .0010
        self.normals = None

    def shade(self):
        sizes = face_normals(self.points, self.faces)
        normals = np.zeros_like(self.points)
        for k, f in enumerate(self.faces):
            normals[f] += sizes[k]
        on_axis = np.abs(self.points[:, 0]) < 1e-6
        normals[on_axis, 0] = 0
        self.normals = np.round(unit(normals), DIGITS)

    def split(self, field, choose, level=0.0):
        """Cuts the faces that `choose(tag, label)` picks where the field has a value, and returns its values."""
        values = np.round(field(self.points) - level, DIGITS)
        values[np.abs(values) < NEAR] = 0
        values = list(values)
        added, new_points, new_normals = {}, [], []

        def between(a, b):
            key = (a, b) if a < b else (b, a)
            if key not in added:
                t = values[a] / (values[a] - values[b])
                added[key] = len(values)
                values.append(0.0)
                new_points.append(at(a) * (1 - t) + at(b) * t)
                new_normals.append(unit(nm(a) * (1 - t) + nm(b) * t))
            return added[key]

        base = len(self.points)
        at = lambda i: self.points[i] if i < base else new_points[i - base]
        nm = lambda i: self.normals[i] if i < base else new_normals[i - base]

        def expand(face, make):
            out = []
            for a, b in zip(face, face[1:] + face[:1]):
                out.append(a)
                key = (a, b) if a < b else (b, a)
                if make and values[a] * values[b] < 0:
                    out.append(between(a, b))
                elif key in added:
                    out.append(added[key])
            return out

        def pieces(face):
            face = expand(face, True)
            sign = [int(np.sign(values[v])) for v in face]
            runs = [s for s in sign if s]
            changes = sum(1 for a, b in zip(runs, runs[1:] + runs[:1]) if a != b)
            if changes == 0:
                return [face]
            if changes == 2:
                out = []
                for s in (-1, 1):
                    n = len(face)
                    part = [face[i] for i in range(n) if sign[i] == s or (sign[i] == 0 and (sign[i - 1] == s or sign[(i + 1) % n] == s))]
                    if len(part) >= 3:
                        out.append(part)
                return out
            return [p for i in range(1, len(face) - 1) for p in pieces([face[0], face[i], face[i + 1]])]

        chosen = [choose(t, l) for t, l in zip(self.tags, self.labels)]
        work = []
        for k, f in enumerate(self.faces):
            v = [values[i] for i in f]
            if chosen[k] and min(v) < 0 < max(v):
                work.append((k, pieces(f)))
        if work:
            touched = set(i for key in added for i in key)
            cut = dict(work)
            faces, tags, labels, parents, order = [], [], [], [], []
            for k, f in enumerate(self.faces):
                if k in cut:
                    rows = [expand(p, False) for p in cut[k]]
                else:
                    rows = [expand(f, False)] if sum(1 for i in f if i in touched) > 1 else [f]
                for row in rows:
                    faces.append(row)
                    order.append(self.order[k])
                    tags.append(self.tags[k])
                    labels.append(self.labels[k])
                    parents.append(self.parents[k] if k not in cut and row == f else None)
            self.faces, self.tags, self.labels, self.parents, self.order = faces, tags, labels, parents, order
            # Rounded, so that machines whose last digits differ cut, weld and cover alike.
            self.points = np.concatenate([self.points, np.round(new_points, DIGITS)])
            self.normals = np.concatenate([self.normals, np.round(new_normals, DIGITS)])
        return np.array(values)

    def region(self, name, field, choose, level=0.0):
        """Gives the chosen faces inside of the field's level line a new label."""
        values = self.split(field, choose, level)
        for k, f in enumerate(self.faces):
            if choose(self.tags[k], self.labels[k]) and sum(values[i] for i in f) < 0:
                self.labels[k] = name

    def along(self, field):
        """A field whose values near 0 are distances along the surface, however that leans to the plane in which an outline is drawn."""
        def distance(points):
            values = field(points)
            near = np.abs(values) < .15
            p, n, v = points[near], self.normals[near], values[near]
            across = unit(np.cross(n, np.where(np.abs(n[:, 1:2]) < .9, (0, 1.0, 0), (1.0, 0, 0))))
            tiny = 1e-3
            slope = np.hypot(*((field(p + tiny * way) - field(p - tiny * way)) / (2 * tiny) for way in (across, np.cross(n, across))))
            values[near] = v / np.maximum(slope, .25)
            return values

        return distance

    def panel(self, name, field, choose, gap, paint=("body",)):
        """A panel with a gap around it, as wide everywhere."""
        field = self.along(field)
        pick = lambda tag, label: label in paint and choose(tag, label)
        self.region("gap", field, pick, gap / 2)
        self.region(name, field, lambda tag, label: label == "gap" and choose(tag, label), -gap / 2)

    def coarsen(self, choose=lambda tag: True):
        """Joins the four children of a face again where none was cut, keeping the corners that others have. What
        is left as it was can be joined later."""
        groups = {}
        for k, p in enumerate(self.parents):
            if p is not None:
                groups.setdefault(p, []).append(k)
        whole = {}
        for p, ks in groups.items():
            ks.sort(key=lambda k: self.order[k])
            if len(ks) == 4 and len({self.labels[k] for k in ks}) == 1 and all(len(self.faces[k]) == 4 for k in ks) and choose(self.tags[ks[0]]):
                if self.flat([self.faces[k] for k in ks], p[0] > 1):
                    whole[p] = ks
        joined = {k for ks in whole.values() for k in ks}
        used = {v for k, f in enumerate(self.faces) if k not in joined for v in f}
        times = {}
        for k, f in enumerate(self.faces):
            for v in f:
                times[v] = times.get(v, 0) + 1
        faces, tags, labels, parents, order = [], [], [], [], []
        for k, f in enumerate(self.faces):
            if k not in joined:
                order.append(self.order[k])
                faces.append(f)
                tags.append(self.tags[k])
                labels.append(self.labels[k])
                parents.append(self.parents[k])
        for (level, parent), ks in whole.items():
            row = []
            for k in ks:
                corner, middle = self.faces[k][0], self.faces[k][1]
                row.append(corner)
                if middle in used or times[middle] < 4:
                    row.append(middle)
            faces.append(row)
            tags.append(self.tags[ks[0]])
            labels.append(self.labels[ks[0]])
            parents.append((2, self.above[parent]) if level == 1 else None)
            order.append(parent)
        self.order = order
        self.faces, self.tags, self.labels, self.parents = faces, tags, labels, parents

    def flat(self, four, exactly):
        """Whether the larger face is shaded like the four, so that no crease blurs; `exactly`: and the middles of the edges and the centre lie
        on it, as far as `within` says."""
        a, b = self.normals[[f[0] for f in four]], self.normals[[f[1] for f in four]]
        if np.abs(b - (a + np.roll(a, -1, 0)) / 2).max() > SHADED:
            return False
        if not exactly:
            return True
        c = self.points[[f[0] for f in four]]
        e = self.points[[f[1] for f in four]]
        bent = np.abs(e - (c + np.roll(c, -1, 0)) / 2).max()
        return bent < self.within and np.abs(self.points[four[0][2]] - c.mean(0)).max() < self.within

    def faces_of(self, labels, pick=None):
        return [f for f, l, t in zip(self.faces, self.labels, self.tags) if l in labels and (pick is None or pick(t))]

    def part(self, name, material, labels, offset=0.0, fold=0.0, lip=0.0015, shift=None, pick=None, walls=False, into=None):
        """The faces of some labels, moved along their normals by `offset` (a number, or a function of positions), with
        edges turned in by `fold`; `shift(points, normals)` may move them anywhere. With `walls`, there is nothing but
        the edges, seen from inside. The part's `folds` is how many of its last faces are edges, by turns a lip and a wall. `into`: a direction in which offset (then negative) and edges go instead of along the normals."""
        faces = self.faces_of(labels, pick)
        index = {}
        for f in faces:
            for v in f:
                index.setdefault(v, len(index))
        ids = list(index)
        n = self.normals[ids]
        p = self.points[ids]
        off = offset(p) if callable(offset) else offset
        out = n if into is None else -unit(np.broadcast_to(np.asarray(into, float), n.shape))
        p = p + out * np.reshape(off, (-1, 1) if np.ndim(off) else (1, 1))
        if shift is not None:
            p = shift(p, n)
        faces = [[index[v] for v in f] for f in faces]
        if callable(offset):
            n = tilted(n, p, self.points[ids], faces)
        if not fold:
            return Part(name, material, p, untwisted(p, n, faces), n)
        extra = list(folded(p, out, faces, fold, lip))
        if callable(offset):
            # The rounded edge starts from the normals that it was made from, not from those that were turned.
            first = len(n) + len(extra[2])
            extra[2] = np.concatenate([extra[2], out])
            extra[3] = [[c + first if c < len(n) else c for c in row] for row in extra[3]]
        faces = untwisted(p, n, faces)
        if walls:
            return Part(name, material, np.concatenate([p, extra[0]]), extra[1], np.concatenate([n, extra[2]]), extra[3]).flipped()
        part = Part(name, material, np.concatenate([p, extra[0]]), faces + extra[1],
                    np.concatenate([n, extra[2]]), faces + extra[3])
        part.folds = len(extra[1])
        return part
