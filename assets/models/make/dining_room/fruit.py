"""A bowl of fruit in the middle of the table."""

import numpy as np

from build import finish, turn
from shapes import curve, lathe, tube
from table import TOP


def body(material, profile, dent=0.0, seed=0):
    shape = lathe(profile)
    if dent:
        lobes = lambda p: 1 + dent * np.cos(5 * np.arctan2(p[:, 0], p[:, 2]) + seed) * np.clip(-p[:, 1] / 0.03, -0.4, 1)
        shape = shape.mapped(lambda p: p * np.stack([lobes(p), np.ones(len(p)), lobes(p)], axis=1))
    return finish(material, shape, smooth=80)


def apple(r=0.039):
    t = np.linspace(0.06, np.pi - 0.04, 13)
    round_ = [(r * np.sin(a) * (1 + 0.06 * np.cos(a - 2.4)), -r * 0.92 * np.cos(a) + r * 0.08 * np.sin(2 * a)) for a in t]
    foot = [(0, -0.72 * r), (0.1 * r, -0.76 * r), (0.24 * r, -0.89 * r)]
    head = [(0.3 * r, 0.86 * r), (0.16 * r, 0.74 * r), (0.06 * r, 0.62 * r), (0, 0.58 * r)]
    profile = foot + [p for p in round_ if p[0] > 0.34 * r] + head
    stalk = tube(curve([(0, 0.6 * r, 0), (0.05 * r, 0.95 * r, 0), (0.16 * r, 1.28 * r, 0)], 3), 0.0014, 6)
    return [body("apple", profile, 0.02), finish("stalk", stalk)]


def orange(r=0.04):
    t = np.linspace(0, np.pi, 11)
    return [body("orange", [(r * np.sin(a) if 0 < k < 10 else 0, -r * 0.95 * np.cos(a)) for k, a in enumerate(t)])]


def pear(r=0.036):
    t = np.linspace(0, 1, 14)
    profile = []
    for k, s in enumerate(t):
        a = np.pi * s
        neck = 1 / (1 + np.exp((s - 0.62) * 12))
        radius = r * np.sin(a) ** 0.75 * (0.5 + 0.52 * neck)
        profile.append((radius if 0 < k < 13 else 0, -r + 2.75 * r * (1 - np.cos(a)) / 2))
    stalk = tube(curve([(0, 1.7 * r, 0), (0.03 * r, 2.0 * r, 0), (0.18 * r, 2.2 * r, 0)], 3), 0.0015, 6)
    return [body("pear", profile), finish("stalk", stalk)]


def grapes(seed=4):
    """A bunch that lies over the rim of the bowl."""
    random = np.random.default_rng(seed)
    t = np.linspace(0, np.pi, 6)
    r = 0.0105
    grape = body("grape", [(r * np.sin(a) if 0 < k < 5 else 0, -1.08 * r * np.cos(a)) for k, a in enumerate(t)])
    spine = curve([(0.03, 0.088, 0.05), (0.085, 0.1, 0.075), (0.14, 0.085, 0.1), (0.165, 0.05, 0.112)], 8)
    out = []
    for k in range(40):
        s = random.random() ** 0.8
        p = spine[int(s * (len(spine) - 1))]
        spread = 0.028 * (1 - 0.6 * s)
        off = random.normal(0, 1, 3)
        off /= np.linalg.norm(off)
        off[1] = abs(off[1]) * 0.7
        out.append((grape, turn(x=random.uniform(0, 360), z=random.uniform(0, 360), at=tuple(p + off * spread))))
    return out


def dish(r=0.165):
    profile = [
        (0, 0.006), (0.4 * r, 0.006), (0.41 * r, 0.0), (0.46 * r, 0.0), (0.47 * r, 0.012), (0.66 * r, 0.03), (0.88 * r, 0.056), (0.98 * r, 0.079), (r, 0.085),
        (0.99 * r, 0.088), (0.965 * r, 0.086), (0.94 * r, 0.076), (0.84 * r, 0.056), (0.62 * r, 0.034), (0.4 * r, 0.021), (0, 0.017),
    ]
    return finish("glaze_blue", lathe(profile), smooth=60)


def build(scene):
    middle = turn(y=20, at=(0.04, TOP + 0.0055, -0.01))
    scene.put("bowl", dish(), middle)
    kinds = {"apple": apple(), "orange": orange(), "pear": pear()}
    places = [
        ("apple", (0.088, 0.088, -0.03), (12, 40, -14)), ("orange", (0.012, 0.086, -0.092), (50, 0, 20)), ("apple", (-0.072, 0.087, -0.058), (10, 200, 16)),
        ("orange", (-0.09, 0.09, 0.03), (20, 90, 60)), ("apple", (-0.01, 0.085, 0.086), (-24, 300, 6)), ("orange", (0.0, 0.066, 0.0), (0, 30, 0)),
        ("pear", (0.03, 0.148, -0.025), (0, 0, -62)), ("apple", (-0.045, 0.15, 0.012), (8, 120, 20)), ("orange", (0.06, 0.072, 0.045), (0, 0, 30)),
    ]
    for name, at, (x, y, z) in places:
        scene.put("fruit", kinds[name], middle @ turn(x, y, z, at))
    for grape, at in grapes():
        scene.put("grapes", grape, middle @ at)
