"""Parts of a model, and the writer of OBJ files. A part is one object of one material."""

import numpy as np

from obj import Obj


# To so many digits machines agree, whatever order they add in.
DIGITS = 9


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

    def only(self, choose, material=None):
        """The faces that `choose` picks by their number."""
        keep = [k for k in range(len(self.faces)) if choose(k)]
        pick = lambda lists: [lists[k] for k in keep]
        return Part(self.name, material or self.material, self.points, pick(self.faces), self.normals, pick(self.corners), self.uvs, pick(self.uv_corners))

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


def area(points):
    """A polygon's normal, twice as long as its area."""
    return np.cross(points, np.roll(points, -1, 0)).sum(0)


def face_normals(points, faces):
    return np.array([area(points[f]) for f in faces])


def untwisted(points, normals, faces):
    """The faces, with those of four corners that cross themselves as triangles that look where their normals do."""
    out = []
    for f in faces:
        halves = [[f[0], f[1], f[2]], [f[0], f[2], f[3]]] if len(f) == 4 else [f]
        looks = [area(points[h]) @ normals[h].sum(0) for h in halves]
        out += [f] if min(looks) > 0 else [h if look > 0 else h[::-1] for h, look in zip(halves, looks)]
    return out


def smooth(name, material, points, faces, angle=35.0, uvs=None, uv_corners=None):
    """A part whose normals are smooth where faces meet by less than `angle` degrees."""
    points = np.asarray(points, float)
    faces = [list(f) for f in faces]
    sizes = face_normals(points, faces)
    flat = unit(sizes)
    around = {}
    for k, f in enumerate(faces):
        for v in f:
            around.setdefault(v, []).append(k)
    limit = np.cos(np.radians(angle)) - 10.0 ** -DIGITS
    normals, corners, known = [], [], {}
    for k, f in enumerate(faces):
        row = []
        for v in f:
            near = around[v]
            close = [j for j in near if flat[j] @ flat[k] >= limit] or [k]
            key = (v, tuple(close))
            if key not in known:
                known[key] = len(normals)
                normals.append(unit(sizes[close].sum(0)))
            row.append(known[key])
        corners.append(row)
    return Part(name, material, points, faces, normals, corners, uvs, uv_corners)


# Where two digits of a normal do.
ROUGH = {"tyre", "tyre_letters", "leather_dark", "alcantara", "lining", "gap_black", "carpet", "mortar", "wall", "kerb", "wall_cap", "bark", "leaves", "wood", "blades",
         "rubber", "trim_black", "leather", "grille", "grille_fine", "underbody", "liner", "belt"}


# Where a hundredth of a metre does: what stands far away, and in no row.
LOOSE = {"leaves", "blades", "bark"}


def write(path, comment, library, parts, position="%.4f"):
    obj = Obj(comment, library, position, "%.3f", "%.3f")
    for part in parts:
        obj.object(part.name, part.material)
        points, normals = np.round(part.points, DIGITS).tolist(), np.round(part.normals, DIGITS).tolist()
        uvs = part.uvs.tolist() if part.uvs is not None else None
        for face, corners, uv_corners in zip(part.faces, part.corners, part.uv_corners):
            obj.face([points[v] for v in face], [normals[c] for c in corners], [uvs[c] for c in uv_corners] if uvs else None,
                     "%.2f" if part.material in ROUGH else None, "%.2f" if part.material in LOOSE else None)
    obj.write(path)
