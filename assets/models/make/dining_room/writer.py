"""A scene as an OBJ file, positions to 0.1 mm. Texture coordinates are for the materials in `textured` alone."""

from obj import Obj
from vector import unit

# What mirrors so sharply that a third digit of a normal is seen.
POLISHED = {"glass", "silver", "plate", "enamel", "glaze_blue", "glaze_white"}


def write(scene, path, library, textured):
    obj = Obj(["A dining room. Metres, y up. Made by make/dining_room/main.py."], library, "%.4f", "%.3f", "%.2f")
    for group, meshes in scene.groups.items():
        material = None
        for mesh in sorted(meshes, key=lambda m: m.material):
            if material is None:
                obj.object(group, mesh.material)
            elif mesh.material != material:
                obj.material(mesh.material)
            material = mesh.material
            points = mesh.points.tolist()
            for k, face in enumerate(mesh.faces):
                uvs = mesh.uvs[k] if mesh.uvs and material in textured else None
                obj.face([points[v] for v in face], [unit(n.tolist()) for n in mesh.normals[k]], uvs, "%.3f" if material in POLISHED else None)
    obj.write(path)
