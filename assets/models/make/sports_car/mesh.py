"""Parts of a model, and the writer of OBJ files. A part is one object of one material."""

import numpy as np


def number(value, digits):
    text = ("%.*f" % (digits, value)).rstrip("0").rstrip(".") if digits else "%d" % value
    return "0" if text in ("-0", "") else text


def unit(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.maximum(length, 1e-12)


class Part:
    """Positions and polygons; normals and texture coordinates are per corner, by indices of their own."""

    def __init__(self, name, material, points, faces, normals=None, corners=None, uvs=None, uv_corners=None):
        self.name, self.material = name, material
        self.points = np.asarray(points, float).reshape(-1, 3)
        self.faces = [list(f) for f in faces]
        self.normals = None if normals is None else np.asarray(normals, float).reshape(-1, 3)
        self.corners = corners if corners is not None else self.faces
        self.uvs = None if uvs is None else np.asarray(uvs, float).reshape(-1, 2)
        self.uv_corners = uv_corners if uv_corners is not None else self.faces

    def copy(self, name=None, material=None):
        return Part(name or self.name, material or self.material, self.points.copy(), self.faces,
                    None if self.normals is None else self.normals.copy(), self.corners, self.uvs, self.uv_corners)

    def moved(self, matrix=None, by=(0, 0, 0), name=None):
        """Turned by a rotation (3x3, rows times columns) and moved."""
        part = self.copy(name)
        if matrix is not None:
            m = np.asarray(matrix, float)
            part.points = part.points @ m.T
            if part.normals is not None:
                part.normals = part.normals @ m.T
        part.points = part.points + np.asarray(by, float)
        return part

    def mirrored(self, name=None):
        """On x = 0."""
        flip = np.array((-1.0, 1.0, 1.0))
        turn = lambda lists: [f[::-1] for f in lists]
        return Part(name or self.name, self.material, self.points * flip, turn(self.faces),
                    None if self.normals is None else self.normals * flip, turn(self.corners),
                    self.uvs, turn(self.uv_corners))

    def flipped(self):
        turn = lambda lists: [f[::-1] for f in lists]
        return Part(self.name, self.material, self.points, turn(self.faces),
                    None if self.normals is None else -self.normals, turn(self.corners), self.uvs, turn(self.uv_corners))


def joined(name, parts):
    """One part of several of the same material."""
    points, faces, normals, corners, uvs, uv_corners = [], [], [], [], [], []
    p = n = t = 0
    with_uv = all(part.uvs is not None for part in parts)
    for part in parts:
        points.append(part.points)
        faces += [[i + p for i in f] for f in part.faces]
        normals.append(part.normals)
        corners += [[i + n for i in f] for f in part.corners]
        p, n = p + len(part.points), n + len(part.normals)
        if with_uv:
            uvs.append(part.uvs)
            uv_corners += [[i + t for i in f] for f in part.uv_corners]
            t += len(part.uvs)
    return Part(name, parts[0].material, np.concatenate(points), faces, np.concatenate(normals), corners,
                np.concatenate(uvs) if with_uv else None, uv_corners if with_uv else None)


def face_normals(points, faces):
    out = np.zeros((len(faces), 3))
    for k, f in enumerate(faces):
        p = points[f]
        out[k] = np.cross(p, np.roll(p, -1, 0)).sum(0)
    return out


def smooth(name, material, points, faces, angle=35.0, uvs=None, uv_corners=None):
    """A part whose normals are smooth where faces meet by less than `angle` degrees."""
    points = np.asarray(points, float)
    faces = [list(f) for f in faces]
    area = face_normals(points, faces)
    flat = unit(area)
    around = {}
    for k, f in enumerate(faces):
        for v in f:
            around.setdefault(v, []).append(k)
    limit = np.cos(np.radians(angle))
    normals, corners, known = [], [], {}
    for k, f in enumerate(faces):
        row = []
        for v in f:
            near = around[v]
            close = [j for j in near if flat[j] @ flat[k] >= limit] or [k]
            key = (v, tuple(close))
            if key not in known:
                known[key] = len(normals)
                normals.append(unit(area[close].sum(0)))
            row.append(known[key])
        corners.append(row)
    return Part(name, material, points, faces, normals, corners, uvs, uv_corners)


# Where two digits of a normal do.
ROUGH = {"tyre", "leather_dark", "alcantara", "lining", "gap_black", "carpet", "mortar", "wall", "kerb", "wall_cap", "bark", "leaves"}


def fans(points, face):
    """Corners of a polygon as one polygon, begun where a fan of triangles covers it, or as triangles where none does."""
    n = len(face)
    normal = unit(np.cross(points[face], np.roll(points[face], -1, 0)).sum(0))
    drop = int(np.abs(normal).argmax())
    u, v = [(drop + 1) % 3, (drop + 2) % 3] if normal[drop] > 0 else [(drop + 2) % 3, (drop + 1) % 3]
    p = points[face][:, [u, v]].tolist()

    def size(a, b, c):
        (x, y), (s, t), (q, r) = p[a], p[b], p[c]
        return (s - x) * (r - y) - (t - y) * (q - x)

    for start in range(n if n < 12 else 0):
        if all(size(start, (start + k) % n, (start + k + 1) % n) > 2e-8 for k in range(1, n - 1)):
            return [[(k + start) % n for k in range(n)]]
    left, out = list(range(n)), []
    while len(left) > 3:
        ears = []
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            area = size(a, b, c)
            if area > 1e-10 and not any(min(size(a, b, q), size(b, c, q), size(c, a, q)) > -1e-10 for q in left if q not in (a, b, c)):
                long = sum((p[j][0] - p[k][0]) ** 2 + (p[j][1] - p[k][1]) ** 2 for j, k in ((a, b), (b, c), (c, a)))
                ears.append((area / long, -i))
        i = -max(ears)[1] if ears else 0
        out.append([left[i - 1], left[i], left[(i + 1) % len(left)]])
        del left[i]
    return out + [left]


def write(path, comment, library, parts):
    """Shared numbers are written once. Corners that print alike are merged, faces without area left out."""
    lines = ["# " + line for line in comment] + ["mtllib " + library]
    known = {"v": {}, "vt": {}, "vn": {}}

    def index(kind, vector, digits):
        text = " ".join(number(c, digits) for c in vector)
        table = known[kind]
        if text not in table:
            table[text] = len(table) + 1
            lines.append(kind + " " + text)
        return table[text]

    triangles = 0
    for part in parts:
        written = set()
        lines += ["o " + part.name, "usemtl " + part.material]
        v = [index("v", p, 4) for p in part.points]
        vt = [index("vt", t, 4) for t in part.uvs] if part.uvs is not None else None
        vn = [index("vn", n, 2 if part.material in ROUGH else 3) for n in part.normals]
        for k, f in enumerate(part.faces):
            text, kept, seen = [], [], set()
            for c, p in enumerate(f):
                if v[p] in seen:
                    continue
                seen.add(v[p])
                kept.append(p)
                uv = str(vt[part.uv_corners[k][c]]) if vt else ""
                text.append("%d/%s/%d" % (v[p], uv, vn[part.corners[k][c]]))
            if len(text) < 3:
                continue
            triangles += len(text) - 2
            for row in fans(part.points, kept) if len(text) > 4 else [range(len(text))]:
                key = frozenset(text[c] for c in row)
                if key in written:
                    continue
                written.add(key)
                lines.append("f " + " ".join(text[c] for c in row))
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write("\n".join(lines) + "\n")
    print("%s: %d triangles, %.2f MB" % (path.name, triangles, path.stat().st_size / 1e6))
