"""Writes ../teapot.obj. Run it from anywhere: `python3 teapot.py`. The same file comes out every time.

The teapot is Martin Newell's ("The Utilization of Procedure Models in Digital Image Synthesis", thesis, University of
Utah, 1975), in the height that Jim Blinn gave it; the numbers are those printed in F. Crow, "The Origins of the Teapot",
IEEE Computer Graphics and Applications 7 (1), 1987. 32 bicubic Bezier patches: four each for the rim, the two parts of the
body, the two parts of the lid and the bottom, which are products of a profile and a quarter of a nearly round curve, and
four each for handle and spout, which are mirrored on y = 0. Newell's z is up. Points and normals are those of the
patches themselves, not of a coarser mesh.

What is ours: the ring that closes the gap between lid and rim, the sleeves by which handle and spout reach into the body
(Newell's handle only touches it), the plinth, the studio, and the lights.
"""

from math import cos, pi, radians, sin
from pathlib import Path

from obj import Obj
from vector import add, cross, dot, mul, sub, unit

SCALE = 1.5
# The spout points right and a little to the camera, which looks along -x.
TURN = 62.0

# Steps along each profile segment, and round each quarter.
PROFILE_STEPS = 20
QUARTER_STEPS = 44
# Steps along each handle or spout segment, and round half of it.
TUBE_STEPS = 32
HALF_STEPS = 20

# A quarter of a circle in Newell's approximation: in units of the radius, from the x axis towards -y.
QUARTER = ((1.0, 0.0), (1.0, -0.56), (0.56, -1.0), (0.0, -1.0))

# Profiles as (radius, z), in the order from the knob over the rim to the middle of the bottom.
LID = (
    ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),
    ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),
)
RIM = (((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),)
BODY = (
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
)
BOTTOM = (((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),)

# Handle and spout: control rows as (upper x, upper z, lower x, lower z, half width in y), seven for two segments.
HANDLE = (
    (-1.5, 2.25, -1.6, 2.025, 0.3),
    (-2.5, 2.25, -2.3, 2.025, 0.3),
    (-3.0, 2.25, -2.7, 2.025, 0.3),
    (-3.0, 1.8, -2.7, 1.8, 0.3),
    (-3.0, 1.35, -2.7, 1.575, 0.3),
    (-2.65, 0.9375, -2.5, 1.125, 0.3),
    (-1.9, 0.6, -2.0, 0.9, 0.3),
)
SPOUT = (
    (1.7, 1.425, 1.7, 0.6, 0.66),
    (2.6, 1.425, 3.1, 0.825, 0.66),
    (2.3, 2.1, 2.4, 2.025, 0.25),
    (2.7, 2.4, 3.3, 2.4, 0.25),
    (2.8, 2.475, 3.525, 2.49375, 0.25),
    (2.9, 2.475, 3.45, 2.5125, 0.15),
    (2.8, 2.4, 3.2, 2.4, 0.15),
)


def bezier(points, t):
    """Point and derivative of a cubic Bezier curve."""
    s = 1.0 - t
    weights = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
    slopes = (-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t)
    size = range(len(points[0]))
    value = tuple(sum(w * p[k] for w, p in zip(weights, points)) for k in size)
    slope = tuple(sum(w * p[k] for w, p in zip(slopes, points)) for k in size)
    return value, slope


def place(point):
    """Newell's space to the scene's: y up, turned, scaled."""
    x, y, z = point
    turn = radians(TURN)
    return mul((x * cos(turn) - y * sin(turn), z, -x * sin(turn) - y * cos(turn)), SCALE)


def place_normal(normal):
    return unit(place(normal))


def around(steps):
    """(point, derivative) of the four quarters in x and y, anticlockwise seen from above, closed."""
    ring = []
    for quarter in range(4):
        for step in range(steps):
            (x, y), (dx, dy) = bezier(QUARTER, step / steps)
            # Mirrored to run anticlockwise, then turned by whole quarters, which is exact.
            y, dy = -y, -dy
            for _ in range(quarter):
                x, y, dx, dy = -y, x, -dy, dx
            ring.append(((x, y), (dx, dy)))
    return ring + ring[:1]


def lathe(obj, name, material, segments, steps):
    """A profile carried round: S(u, v) = (r(u) A(v), z(u)), with normals from both derivatives."""
    obj.object(name, material)
    ring = around(QUARTER_STEPS)
    for segment in segments:
        points, normals = [], []
        for step in range(steps + 1):
            (r, z), (dr, dz) = bezier(segment, step / steps)
            points.append([place((r * x, r * y, z)) for (x, y), _ in ring])
            row = []
            for (x, y), (dx, dy) in ring:
                # At a pole the profile is level, and the normal is the axis.
                if r < 1e-9:
                    row.append(place_normal((0, 0, 1.0 if dr > 0 else -1.0)))
                else:
                    row.append(place_normal(cross((dr * x, dr * y, dz), (r * dx, r * dy, 0.0))))
            normals.append(row)
        obj.grid(points, normals)


def gap(obj):
    """The level ring from the lid's edge to the rim's inner edge."""
    obj.object("gap", "teapot")
    up = place_normal((0, 0, 1))
    ring = around(QUARTER_STEPS)
    points = [[place((r * x, r * y, 2.4)) for (x, y), _ in ring] for r in (1.3, 1.4)]
    obj.grid(points, [[up] * len(ring)] * 2)


def cross_section(row):
    """Half of a tube's cross-section as four control points, on the side of -y."""
    ux, uz, lx, lz, w = row
    return ((ux, 0.0, uz), (ux, -w, uz), (lx, -w, lz), (lx, 0.0, lz))


def tube_row(rows, t, steps):
    """Points and normals once round a tube at `t` of a segment: down on -y, up on +y."""
    patch = [cross_section(row) for row in rows]
    half = []
    for step in range(steps + 1):
        v = step / steps
        columns = [bezier([row[k] for row in patch], t) for k in range(4)]
        point, dv = bezier([c[0] for c in columns], v)
        du, _ = bezier([c[1] for c in columns], v)
        half.append((point, unit(cross(du, dv))))
    mirror = lambda p: (p[0], -p[1], p[2])
    return half + [(mirror(p), mirror(n)) for p, n in reversed(half[:-1])]


def tube(obj, name, control, sleeves):
    """Two patches along, two round. `sleeves` are shifts that carry the first and last ring into the body, or None."""
    obj.object(name, "teapot")
    rings = []
    for first in (0, 3):
        for step in range(0 if first == 0 else 1, TUBE_STEPS + 1):
            rings.append(tube_row(control[first : first + 4], step / TUBE_STEPS, HALF_STEPS))
    for shift, at in zip(sleeves, (0, -1)):
        if shift:
            sleeve = [(add(p, shift), n) for p, n in rings[at]]
            rings = [sleeve] + rings if at == 0 else rings + [sleeve]
    # du x dv points out or in, by the way the control rows run: out of the tube's middle is right for all rings.
    middle = mul(tuple(sum(p[k] for p, _ in rings[10][:-1]) for k in range(3)), 1 / (len(rings[10]) - 1))
    outwards = dot(sub(rings[10][4][0], middle), rings[10][4][1]) > 0
    if not outwards:
        rings = [[(p, mul(n, -1.0)) for p, n in reversed(ring)] for ring in rings]
    obj.grid([[place(p) for p, _ in ring] for ring in rings], [[place_normal(n) for _, n in ring] for ring in rings])


def teapot(obj):
    lathe(obj, "lid", "teapot", LID, PROFILE_STEPS)
    gap(obj)
    lathe(obj, "rim", "teapot", RIM, PROFILE_STEPS)
    lathe(obj, "body", "teapot", BODY, PROFILE_STEPS + 6)
    lathe(obj, "bottom", "teapot", BOTTOM, PROFILE_STEPS)
    tube(obj, "handle", HANDLE, ((0.2, 0.0, 0.0), (0.25, 0.0, 0.0)))
    tube(obj, "spout", SPOUT, (None, None))


def disc(obj, name, material, profile, steps):
    """A lathed polyline (radius, y) with flat-shaded rings, scene space."""
    obj.object(name, material)
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        n = unit((y0 - y1, r1 - r0, 0.0))
        for k in range(steps):
            a, b = 2 * pi * k / steps, 2 * pi * (k + 1) / steps
            at = lambda r, y, t: (r * cos(t), y, -r * sin(t))
            turn = lambda t: (n[0] * cos(t), n[1], -n[0] * sin(t))
            obj.face([at(r0, y0, a), at(r1, y1, a), at(r1, y1, b), at(r0, y0, b)], [turn(a), turn(a), turn(b), turn(b)])


def plinth(obj):
    """A round slab under the pot, from the floor at -0.6 to 0, its edge rounded with radius 0.12."""
    edge = [(4.28 + 0.12 * sin(t), -0.12 + 0.12 * cos(t)) for t in (pi / 2 * k / 8 for k in range(9))]
    disc(obj, "plinth", "plinth", [(0.0, 0.0)] + edge + [(4.4, -0.6)], 128)


def studio(obj):
    """A floor that rises into a wall: no horizon. It faces the camera side, +x, and up."""
    obj.object("studio", "studio")
    floor, radius, wall, half = -0.6, 16.0, -34.0, 60.0
    line = [((60.0, floor), (0.0, 1.0)), ((wall + radius, floor), (0.0, 1.0))]
    for k in range(1, 24):
        t = pi / 2 * k / 24
        line.append(((wall + radius - radius * sin(t), floor + radius - radius * cos(t)), (sin(t), cos(t))))
    line += [((wall, floor + radius), (1.0, 0.0)), ((wall, 50.0), (1.0, 0.0))]
    points = [[(x, y, z) for z in (half, -half)] for (x, y), _ in line]
    normals = [[(nx, ny, 0.0)] * 2 for _, (nx, ny) in line]
    obj.grid([list(reversed(row)) for row in points], [list(reversed(row)) for row in normals])


def panel(obj, name, material, centre, target, width, height):
    """A rectangle of light that faces `target`."""
    forward = unit(sub(target, centre))
    right = unit(cross(forward, (0.0, 1.0, 0.0)))
    up = cross(right, forward)
    corner = lambda a, b: add(centre, add(mul(right, a * width / 2), mul(up, b * height / 2)))
    obj.object(name, material)
    corners = [corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1)]
    obj.face([corners[0], corners[1], corners[2]])
    obj.face([corners[0], corners[2], corners[3]])


def main():
    obj = Obj(["Lucerna's teapot, made by make/teapot.py", "after Martin Newell, 1975", "MIT OR Apache-2.0"], "teapot.mtl")
    teapot(obj)
    plinth(obj)
    studio(obj)
    panel(obj, "key", "key_light", (14.0, 20.0, 12.0), (0.0, 2.0, 0.0), 18.0, 18.0)
    panel(obj, "back", "rim_light", (-10.0, 14.0, -17.0), (0.0, 2.5, 0.0), 8.0, 18.0)
    obj.write(Path(__file__).resolve().parent.parent / "teapot.obj")


if __name__ == "__main__":
    main()
