"""Checks the models' geometry: `python3 check.py`. Prints what it finds, and exits with 1 if anything is wrong.

Every closed object must be closed (each edge used once in each direction), turned outwards (positive volume), free of
empty faces, and its normals must agree with its faces.
"""

import sys
from pathlib import Path

from vector import cross, dot, sub

MODELS = Path(__file__).resolve().parent.parent
# Objects that enclose a volume. The pot's shell is one closed surface of five objects.
CLOSED = {
    "cornell-box.obj": [("tall_box",), ("ball",)],
    "glass.obj": [("mirror_block",), ("glass_ball",), ("gold_ball",)],
    "teapot.obj": [("lid", "gap", "rim", "body", "bottom")],
}


def read(path):
    positions, normals, objects, name = [], [], {}, None
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            positions.append(tuple(map(float, rest)))
        elif word == "vn":
            normals.append(tuple(map(float, rest)))
        elif word == "o":
            name = rest[0]
            objects[name] = []
        elif word == "f":
            corners = [tuple(int(i) - 1 for i in corner.split("//")) for corner in rest]
            objects[name] += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return positions, normals, objects


def check(path):
    wrong = []
    positions, normals, objects = read(path)
    for name, faces in objects.items():
        against = empty = 0
        for face in faces:
            a, b, c = (positions[corner[0]] for corner in face)
            n = cross(sub(b, a), sub(c, a))
            if dot(n, n) <= 1e-20:
                empty += 1
            against += sum(1 for corner in face if len(corner) > 1 and dot(n, normals[corner[1]]) <= 0)
        if against or empty:
            wrong.append("%s: %s: %d normals against their face, %d empty faces" % (path.name, name, against, empty))
    bad = sum(1 for n in normals if abs(dot(n, n) - 1) > 1e-4)
    if bad:
        wrong.append("%s: %d normals not of unit length" % (path.name, bad))
    for group in CLOSED[path.name]:
        edges, volume = {}, 0.0
        for name in group:
            for face in objects[name]:
                a, b, c = (corner[0] for corner in face)
                volume += dot(positions[a], cross(positions[b], positions[c])) / 6
                for edge in ((a, b), (b, c), (c, a)):
                    edges[edge] = edges.get(edge, 0) + 1
        open_edges = sum(1 for (a, b), n in edges.items() if n != 1 or edges.get((b, a)) != 1)
        print("%s: %s: volume %.4f, %d open edges" % (path.name, "+".join(group), volume, open_edges))
        if open_edges or volume <= 0:
            wrong.append("%s: %s is not closed and turned outwards" % (path.name, "+".join(group)))
    print("%s: %d positions, %d normals, %d triangles" % (path.name, len(positions), len(normals), sum(map(len, objects.values()))))
    return wrong


def main():
    wrong = [line for name in CLOSED for line in check(MODELS / name)]
    print("\n".join(wrong) if wrong else "all well")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
