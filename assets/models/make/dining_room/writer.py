"""Writes groups of meshes as an OBJ file: positions to 0.1 mm, normals to three digits, nothing twice.

Texture coordinates are for the materials in `textured` alone.
"""

import numpy as np


def number(x, digits):
    text = "%.*f" % (digits, x)
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class Pool:
    """Lines of one kind, each written once for the whole file."""

    def __init__(self, word, digits):
        self.word, self.digits, self.ids, self.lines = word, digits, {}, []

    def index(self, values):
        key = " ".join(number(v, self.digits) for v in values)
        if key not in self.ids:
            self.ids[key] = len(self.ids) + 1
            self.lines.append(self.word + " " + key)
        return self.ids[key]


def write(scene, path, library, textured):
    normals, uvs = Pool("vn", 3), Pool("vt", 4)
    out, base, triangles = [], 0, 0
    for group, meshes in scene.groups.items():
        positions, body = Pool("v", 4), []
        for mesh in sorted(meshes, key=lambda m: m.material):
            body.append("usemtl " + mesh.material)
            ids = [positions.index(p) + base for p in mesh.points]
            for k, face in enumerate(mesh.faces):
                corners, seen = [], set()
                for c, vertex in enumerate(face):
                    v = ids[vertex]
                    if v in seen:
                        continue
                    seen.add(v)
                    n = np.asarray(mesh.normals[k][c], float)
                    t = uvs.index(mesh.uvs[k][c]) if mesh.uvs and mesh.material in textured else ""
                    corners.append("%d/%s/%d" % (v, t, normals.index(n / max(np.linalg.norm(n), 1e-9))))
                if len(corners) >= 3 and area(mesh.points[face]) > 1e-9:
                    body.append("f " + " ".join(corners))
                    triangles += len(corners) - 2
        body = without_repeats(body)
        out += ["o " + group] + positions.lines + body
        base += len(positions.lines)
    path.write_text("\n".join(["mtllib " + library] + normals.lines + uvs.lines + out) + "\n")
    return triangles


def without_repeats(lines):
    """Without the lines that name the material that is there already."""
    out, material = [], None
    for line in lines:
        if line.startswith("usemtl"):
            if line == material:
                continue
            material = line
        out.append(line)
    return out


def area(points):
    n = np.zeros(3)
    for a, b in zip(points[1:-1], points[2:]):
        n += np.cross(a - points[0], b - points[0])
    return np.linalg.norm(n) / 2
