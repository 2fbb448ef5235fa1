"""Writes ../cornell-box.obj. Run it from anywhere: `python3 cornell_box.py`. The same file comes out every time.

After the Cornell box of Goral, Torrance, Greenberg and Battaile, "Modeling the Interaction of Light Between Diffuse
Surfaces" (SIGGRAPH 1984), as a room two units wide round the origin, open towards the camera on +z: a tall box turned
by 30 degrees at the left back, a large ball right in front, a square light just below the ceiling. Sizes are ours.
"""

from math import cos, radians, sin, sqrt
from pathlib import Path

from obj import Obj
from vector import add, mul, unit

# Below the ceiling by 0.2 % of the room: a plane of its own for the tracer, no gap for the eye.
LIGHT_HEIGHT = 0.996
LIGHT_HALF = 0.35

BOX_CENTRE = (-0.36, -1.0, -0.36)
BOX_HALF = 0.29
BOX_HEIGHT = 1.22
BOX_TURN = 30.0

BALL_CENTRE = (0.4, -0.58, 0.28)
BALL_RADIUS = 0.42
BALL_CUTS = 14


def quad(obj, name, material, a, b, c, d):
    obj.object(name, material)
    obj.face([a, b, c])
    obj.face([a, c, d])


def room(obj):
    """Walls that face inwards."""
    quad(obj, "floor", "white", (-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1))
    quad(obj, "ceiling", "white", (-1, 1, 1), (-1, 1, -1), (1, 1, -1), (1, 1, 1))
    quad(obj, "back", "white", (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1))
    quad(obj, "left", "red", (-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1))
    quad(obj, "right", "green", (1, -1, 1), (1, 1, 1), (1, 1, -1), (1, -1, -1))
    h, y = LIGHT_HALF, LIGHT_HEIGHT
    quad(obj, "light", "ceiling_light", (-h, y, h), (-h, y, -h), (h, y, -h), (h, y, h))


def box(obj, name, centre, half, height, degrees):
    """Standing on its base's centre, turned about it, closed below too."""
    turn = radians(degrees)
    ring = []
    for x, z in ((-1, 1), (1, 1), (1, -1), (-1, -1)):
        x, z = x * half, z * half
        ring.append(add(centre, (x * cos(turn) + z * sin(turn), 0, z * cos(turn) - x * sin(turn))))
    top = [add(p, (0, height, 0)) for p in ring]
    obj.object(name, name)
    faces = [(ring[k], ring[(k + 1) % 4], top[(k + 1) % 4], top[k]) for k in range(4)]
    faces += [tuple(top), tuple(reversed(ring))]
    for a, b, c, d in faces:
        obj.face([a, b, c])
        obj.face([a, c, d])


def icosahedron():
    """Twelve corners and twenty faces, counter-clockwise from outside."""
    golden = (1 + sqrt(5)) / 2
    corners = []
    for a in (-1, 1):
        for b in (-golden, golden):
            corners += [(0, a, b), (a, b, 0), (b, 0, a)]
    edge = 4.0 + 1e-9
    near = lambda p, q: sum((x - y) ** 2 for x, y in zip(p, q)) <= edge
    faces = []
    for i, p in enumerate(corners):
        for j, q in enumerate(corners):
            for k, r in enumerate(corners):
                if i < j and i < k and j != k and near(p, q) and near(q, r) and near(r, p):
                    volume = (
                        p[0] * (q[1] * r[2] - q[2] * r[1])
                        + p[1] * (q[2] * r[0] - q[0] * r[2])
                        + p[2] * (q[0] * r[1] - q[1] * r[0])
                    )
                    if volume > 0:
                        faces.append((p, q, r))
    return faces


def ball(obj, name, centre, radius, n):
    """A geodesic sphere with the sphere's own normals: 20 faces of an icosahedron, each cut into n x n."""
    obj.object(name, name)

    def corner(face, i, j):
        weights = (n - i - j, i, j)
        return unit(tuple(sum(w * v[axis] for w, v in zip(weights, face)) for axis in range(3)))

    def emit(face, *places):
        normals = [corner(face, i, j) for i, j in places]
        obj.face([add(centre, mul(v, radius)) for v in normals], normals)

    for face in icosahedron():
        for i in range(n):
            for j in range(n - i):
                emit(face, (i, j), (i + 1, j), (i, j + 1))
                if i + j < n - 1:
                    emit(face, (i + 1, j), (i + 1, j + 1), (i, j + 1))


def main():
    obj = Obj(["Lucerna's Cornell box, made by make/cornell_box.py", "MIT OR Apache-2.0"], "cornell-box.mtl")
    room(obj)
    box(obj, "tall_box", BOX_CENTRE, BOX_HALF, BOX_HEIGHT, BOX_TURN)
    ball(obj, "ball", BALL_CENTRE, BALL_RADIUS, BALL_CUTS)
    obj.write(Path(__file__).resolve().parent.parent / "cornell-box.obj")


if __name__ == "__main__":
    main()
