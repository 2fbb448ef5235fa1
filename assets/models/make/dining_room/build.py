"""From shapes to finished meshes: Blender's modifiers are put on, and what comes out is kept as arrays."""

from math import radians
from zlib import crc32

import bpy
import numpy as np


class Mesh:
    """Positions, and for each face its corners' positions, normals and uvs; one material."""

    def __init__(self, material, points, faces, normals, uvs):
        self.material, self.points, self.faces, self.normals, self.uvs = material, points, faces, normals, uvs


def grain(name, axis=0, scale=1.0):
    """Texture coordinates in metres times scale by the side a face looks to; u runs along `axis`. The name shifts them."""
    seed = crc32(name.encode())
    shift = np.array([seed % 997 / 997, seed // 997 % 991 / 991])

    def uv(points, normal):
        side = int(np.argmax(np.abs(normal)))
        rest = [k for k in (0, 1, 2) if k != side]
        if axis in rest:
            rest.remove(axis)
            rest.insert(0, axis)
        return points[:, rest] * scale + shift

    return uv


def finish(material, shape, bevel=0.0, segments=2, subdivide=0, thickness=0.0, smooth=40, uv=None):
    """Modifiers in this order: solidify, bevel, subdivision surface. `smooth` is the angle up to which edges are soft, in
    degrees; None is flat. `uv` is a function of a face's points and normal."""
    data = bpy.data.meshes.new("part")
    data.from_pydata([tuple(p) for p in shape.points], [], shape.faces)
    if shape.uvs:
        layer = data.uv_layers.new(name="uv")
        layer.data.foreach_set("uv", np.array([c for face in shape.uvs for c in face], np.float32).ravel())
    body = bpy.data.objects.new("part", data)
    bpy.context.collection.objects.link(body)
    if thickness:
        m = body.modifiers.new("thickness", "SOLIDIFY")
        m.thickness, m.offset = thickness, -1
    if bevel:
        m = body.modifiers.new("bevel", "BEVEL")
        m.width, m.segments, m.limit_method, m.angle_limit = bevel, segments, "ANGLE", radians(35)
        m.use_clamp_overlap = True
    if subdivide:
        m = body.modifiers.new("subdivide", "SUBSURF")
        m.levels = m.render_levels = subdivide
    done = bpy.data.meshes.new_from_object(body.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    if smooth is None:
        done.shade_flat()
    else:
        done.shade_smooth()
        done.set_sharp_from_angle(angle=radians(smooth))
    mesh = read(material, done, uv)
    bpy.data.objects.remove(body)
    bpy.data.meshes.remove(data)
    bpy.data.meshes.remove(done)
    return mesh


def read(material, data, uv):
    points = np.empty(len(data.vertices) * 3, np.float32)
    data.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3).astype(float)
    normals = np.empty(len(data.loops) * 3, np.float32)
    data.corner_normals.foreach_get("vector", normals)
    normals = normals.reshape(-1, 3)
    layer = data.uv_layers.active
    flat = None
    if layer and not uv:
        flat = np.empty(len(data.loops) * 2, np.float32)
        layer.data.foreach_get("uv", flat)
        flat = flat.reshape(-1, 2)
    faces, corners, uvs = [], [], []
    for face in data.polygons:
        ids = list(face.vertices)
        span = slice(face.loop_start, face.loop_start + face.loop_total)
        faces.append(ids)
        corners.append(normals[span])
        if uv:
            uvs.append(np.asarray(uv(points[ids], np.array(face.normal))))
        elif flat is not None:
            uvs.append(flat[span])
    return Mesh(material, points, faces, corners, uvs or None)


def turn(x=0.0, y=0.0, z=0.0, at=(0, 0, 0), scale=1.0):
    """A matrix: scales, turns about x, y and z (degrees), then moves."""
    out = np.eye(4)
    for axis, angle in enumerate((x, y, z)):
        c, s = np.cos(radians(angle)), np.sin(radians(angle))
        i, j = (axis + 1) % 3, (axis + 2) % 3
        m = np.eye(4)
        m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
        out = m @ out
    out[:3, :3] *= scale
    out[:3, 3] = at
    return out


class Scene:
    """Groups of meshes, in the order in which they were put."""

    def __init__(self):
        self.groups = {}

    def put(self, group, meshes, matrix=None):
        for mesh in meshes if isinstance(meshes, (list, tuple)) else [meshes]:
            if matrix is not None:
                spin = matrix[:3, :3] / np.cbrt(np.linalg.det(matrix[:3, :3]))
                points = mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
                mesh = Mesh(mesh.material, points, mesh.faces, [n @ spin.T for n in mesh.normals], mesh.uvs)
            self.groups.setdefault(group, []).append(mesh)
