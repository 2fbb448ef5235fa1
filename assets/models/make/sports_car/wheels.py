"""Wheels: tyres and rims that roll, discs and calipers that stand still. The outside is at +x, the hub at 0."""

import numpy as np

import rims
import tyres
from mesh import smooth
from shapes import lathe, oriented, turned

# Half of the width, radius of the tyre, radius of the rim's edge.
FRONT_WHEEL = (.1225, .340, .2595)
REAR_WHEEL = (.1525, .357, .271)


def brake(half, rim, big):
    """A vented disc, whose holes are drawn, its bell, and a caliper."""
    x = half - .105
    r = rim - .060
    disc = lathe("disc", "disc", [(x - .016, .105), (x - .016, r), (x - .006, r), (x - .006, r - .012), (x + .006, r - .012), (x + .006, r), (x + .016, r), (x + .016, .105)], 40, 30,
                 uv=(1, 1), closed=True)
    # A coordinate plane across the disc carries its drilled pattern.
    disc.uvs = disc.points[:, 1:] / (2 * r) + .5
    disc.uv_corners = disc.faces
    bell = lathe("bell", "trim_black", [(x + .004, .104), (x + .030, .100), (x + .034, .090), (x + .036, 0)], 32, 35)
    out = [oriented(disc), oriented(bell)]
    arc = np.linspace(-26, 26, 9) if big else np.linspace(-22, 22, 8)
    body = []
    for a in np.radians(arc):
        f = 1 - .10 * (abs(a) / np.radians(26)) ** 4
        mid, deep, w = r - .022, .044 * f, .038 * f
        ring = [(-w, -deep), (w, -deep), (w + .006, -deep * .3), (w + .002, deep * .62), (w * .5, deep * .8), (-w * .5, deep * .8), (-w - .004, deep * .6), (-w - .004, -deep * .3)]
        body.append([(x + u, (mid + v) * np.cos(a), (mid + v) * np.sin(a)) for u, v in ring])
    n, m = len(body), len(body[0])
    faces = [[i * m + j, (i + 1) * m + j, (i + 1) * m + (j + 1) % m, i * m + (j + 1) % m] for i in range(n - 1) for j in range(m)]
    faces += [list(range(m)), [(n - 1) * m + j for j in range(m)][::-1]]
    caliper = oriented(smooth("caliper", "caliper", np.array(body).reshape(-1, 3), faces, 30))
    return out, caliper


def wheel(kind, name, at, side, steer=0.0):
    """All parts of a wheel; `side` 1 is the left."""
    half, radius, rim = kind
    still, caliper = brake(half, rim, kind is FRONT_WHEEL)
    caliper = caliper.moved(turned(0, -62 if kind is FRONT_WHEEL else 62))
    turn = turned(0, 11.0 * (1 + at[2]))
    rolling = [tyres.tyre(*kind), tyres.lettering(*kind, side)] + rims.parts(half, rim, side)
    parts = [p.moved(turn) for p in rolling] + still + [caliper]
    out = []
    for part in parts:
        part = part if side > 0 else part.mirrored()
        part = part.moved(turned(1, steer), at, name + "_" + part.name)
        out.append(tyres.settled(part) if part.material == "tyre" else part)
    return out


def wheels():
    out = []
    for side, word in ((1, "left"), (-1, "right")):
        out += wheel(FRONT_WHEEL, "front_" + word, (side * .844, .329, 1.325), side)
        out += wheel(REAR_WHEEL, "rear_" + word, (side * .822, .346, -1.325), side)
    return out
