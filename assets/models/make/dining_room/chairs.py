"""A chair with a bent rail and spindles at its back and a cushion on its seat, and where five of it stand."""

import numpy as np

from build import finish, grain, turn
from shapes import Shape, curve, outline, slab, sweep, tube
from table import RUG

SEAT = 0.445


def wood(name, shape, **how):
    """Bars have their grain along u already; it is put to scale here."""
    if shape.uvs:
        shape.uvs = [[(u * 0.9 + len(name) * 0.17, v * 0.12 + len(name) * 0.31) for u, v in face] for face in shape.uvs]
    return finish("beech", shape, smooth=65, **how)


def turned(name, foot, head, profile, around=8):
    """A bar between two points, its radius by (where from 0 to 1, radius)."""
    foot, head = np.array(foot, float), np.array(head, float)
    path = [foot + (head - foot) * t for t, _ in profile]
    return wood(name, tube(path, [r for _, r in profile], around, (0, 0, 1)))


LEG = [(0, 0.012), (0.08, 0.0135), (0.3, 0.0165), (0.42, 0.0195), (0.45, 0.0165), (0.47, 0.0205), (0.5, 0.0165), (0.7, 0.022), (0.86, 0.019), (1, 0.015)]
STRETCHER = [(0, 0.0075), (0.2, 0.009), (0.42, 0.0125), (0.47, 0.0105), (0.5, 0.0135), (0.53, 0.0105), (0.58, 0.0125), (0.8, 0.009), (1, 0.0075)]


def chair():
    """Its sitter looks towards +z; the seat's middle is above (0, 0)."""
    seat = slab(outline(0.45, 0.43, 0.1, 5), SEAT - 0.034, SEAT)
    seat = seat.mapped(lambda p: p * np.stack([1 + 0.28 * p[:, 2], np.ones(len(p)), np.ones(len(p))], axis=1))
    parts = [finish("beech", seat, bevel=0.011, uv=grain("seat", 2, 0.9))]
    feet = {"fl": (-0.205, 0, 0.195), "fr": (0.205, 0, 0.195), "bl": (-0.185, 0, -0.23), "br": (0.185, 0, -0.23)}
    heads = {"fl": (-0.165, SEAT - 0.02, 0.15), "fr": (0.165, SEAT - 0.02, 0.15), "bl": (-0.14, SEAT - 0.02, -0.15), "br": (0.14, SEAT - 0.02, -0.15)}
    for key in feet:
        parts.append(turned("leg" + key, feet[key], heads[key], LEG))
    at = lambda key, t: tuple(np.array(feet[key]) * (1 - t) + np.array(heads[key]) * t)
    middle = lambda a, b: tuple((np.array(a) + np.array(b)) / 2)
    left, right = (at("fl", 0.45), at("bl", 0.45)), (at("fr", 0.45), at("br", 0.45))
    parts.append(turned("sl", *left, STRETCHER, 6))
    parts.append(turned("sr", *right, STRETCHER, 6))
    parts.append(turned("sm", middle(*left), middle(*right), STRETCHER, 6))
    parts += back()
    return parts + [cushion()]


def bow(t):
    """The line of the upper rail, t from -1 to 1: bent round the sitter's back, highest in its middle."""
    return np.array([0.222 * t, 0.885 + 0.022 * (1 - t * t), -0.292 + 0.075 * t * t])


def back():
    parts = []
    spread = np.linspace(-1, 1, 13)
    path = [bow(t) for t in spread]
    sections = []
    for t in spread:
        slim = np.sqrt(max(1 - abs(t) ** 7, 0)) * 0.86 + 0.14
        h, d = 0.042 * slim, 0.0105 * slim
        angles = np.arange(8) * 2 * np.pi / 8
        p = lambda a: np.sign(a) * np.abs(a) ** 0.55
        sections.append([(d * p(np.cos(a)), h * p(np.sin(a))) for a in angles])
    parts.append(wood("rail", sweep(path, sections)))
    for k, t in enumerate((-0.86, -0.6, -0.36, -0.12, 0.12, 0.36, 0.6, 0.86)):
        post = abs(t) > 0.8
        foot = np.array([0.19 * t * (1.0 if post else 0.9), SEAT - 0.01, -0.165 + 0.05 * t * t])
        head = bow(t)
        knee = foot * 0.45 + head * 0.55 + np.array([0.012 * t, 0, -0.012])
        line = curve([foot, knee, head], 3)
        s = np.linspace(0, 1, len(line))
        radius = (0.0125 if post else 0.0062) + (0.003 if post else 0.003) * np.exp(-(((s - 0.35) / 0.22) ** 2))
        parts.append(wood("spindle%d" % k, tube(line, radius, 8 if post else 6, (0, 0, 1))))
    return parts


def cushion():
    """A soft pad: its edge is thin, its middle is high, and it is buttoned at four places."""
    points, faces = [], []
    edge = np.array(outline(0.395, 0.375, 0.1, 5))
    edge[:, 0] *= 1 + 0.28 * edge[:, 1]
    n = len(edge)
    buttons = [(-0.075, -0.065), (0.075, -0.065), (-0.075, 0.07), (0.075, 0.07)]

    def height(x, z, r):
        puff = 0.042 * (1 - r**4) + 0.006
        dent = sum(np.exp(-((x - a) ** 2 + (z - b) ** 2) / 0.0011) for a, b in buttons)
        return puff - 0.02 * dent

    rs = [0.12, 0.3, 0.48, 0.64, 0.78, 0.88, 0.95, 0.99, 1.0]
    for r in rs:
        points += [(x * r, SEAT + height(x * r, z * r, r), z * r) for x, z in edge]
    points += [(x * 0.965, SEAT + 0.001, z * 0.965) for x, z in edge]
    count = len(rs) + 1
    for i in range(count - 1):
        faces += [[(i + 1) * n + k, (i + 1) * n + (k + 1) % n, i * n + (k + 1) % n, i * n + k] for k in range(n)]
    faces += [list(range(n)), [(count - 1) * n + k for k in range(n)][::-1]]
    uv = lambda p, normal: np.stack([p[:, 0] * 2.6 + 0.5, p[:, 2] * 2.6 + 0.5 + p[:, 1]], axis=1)
    return finish("cushion", Shape(points, faces), smooth=70, uv=uv)


def build(scene):
    one = chair()
    # x, z, and where the sitter looks, in degrees from +z towards +x.
    places = [(-0.43, -0.66, 4), (0.46, -0.68, -7), (-1.17, 0.02, 84), (1.22, 0.1, -68), (-0.62, 0.83, 146)]
    for k, (x, z, angle) in enumerate(places):
        scene.put("chair_%d" % (k + 1), one, turn(y=angle, at=(x, RUG, z)))
