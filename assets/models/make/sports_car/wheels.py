"""Wheels: tyres with grooves, ten-spoke rims in five pairs, discs, calipers, hubs. The outside is at +x, the hub at 0."""

import numpy as np

from letters import text
from mesh import joined, smooth
from shapes import lathe, oriented, turned

# Half of the width, radius of the tyre, radius of the rim's edge.
FRONT_WHEEL = (.1225, .340, .2595)
REAR_WHEEL = (.1575, .357, .271)


def tyre(half, radius, rim):
    """Outer sidewall to inner sidewall over the tread. Two grooves round its outer half, and slots across the shoulders."""
    h, r = half, radius
    side = [(h - .018, rim - .008), (h - .006, rim - .002), (h + .001, rim + .003), (h + .0045, rim + .006), (h + .0045, rim + .011), (h + .0005, rim + .014),
            (h + .006, rim + .026), (h + .0088, rim + .042), (h + .0075, r - .033), (h + .0085, r - .031), (h + .0080, r - .027), (h + .0045, r - .024),
            (h - .003, r - .014), (h - .012, r - .0065), (h - .024, r - .0025)]
    tread = []
    for k, g in enumerate((.42, .14)):
        x = h * g * 1.25
        w, deep = .0048, .0075
        tread += [(x + w, r - .0008 * (1 - k)), (x + w - .001, r - deep), (x - w + .001, r - deep), (x - w, r)]
    outer = side + tread
    profile = outer + [(-x, y) for x, y in [(h * .5, r - .0015)] + side[14:10:-1] + side[7::-2]]
    pitch = 24

    def slots(x, rr, turn):
        phase = (turn * pitch / (2 * np.pi) + np.abs(x) * 9) % 1
        shoulder = (np.abs(x) > h * .60) & (np.abs(x) < h - .004) & (rr > r - .02)
        rib = (np.abs(np.abs(x) - h * .34) < h * .14) & (rr > r - .003)
        return x, rr - np.where(shoulder & (phase < .24), .0085, 0) - np.where(rib & (phase < .24), .0055, 0)

    return oriented(lathe("tyre", "tyre", profile, pitch * 4, 32, bend=slots))


def lettering(half, radius, rim, side):
    """The maker's name, twice round the outer sidewall; `side` -1 writes it backwards, for a wheel that is mirrored."""
    middle, height = (rim + radius - .020) / 2, .021
    words = []
    for start in (.5 * np.pi, 1.5 * np.pi):
        def place(across, up, out):
            turn = start + side * across / middle
            return half + .0066 + out, (middle + up) * np.sin(turn), (middle + up) * np.cos(turn)
        words.append(text("tyre_letters", "tyre_letters", "LUCERNA", height, .0022, place, .2, .5))
    return joined("tyre_letters", words)


def barrel(half, rim):
    """The dish: lip, step and bed of the rim, outside and inside, one closed turn."""
    h, r = half, rim
    profile = [(h - .004, r + .001), (h - .001, r - .002), (h - .002, r - .007), (h - .008, r - .010), (h - .020, r - .012), (h - .030, r - .020), (h - .055, r - .026),
               (-h + .03, r - .030), (-h + .006, r - .012), (-h + .001, r - .006), (-h + .002, r), (-h + .010, r - .001), (-h + .022, r - .014), (-h + .05, r - .022),
               (h - .05, r - .018), (h - .022, r - .006), (h - .012, r)]
    steps = 44
    dish = oriented(lathe("rim", "rim", profile, steps, 40, closed=True))
    lip = lambda k: k < 4 * steps
    return [dish.only(lambda k: not lip(k)), dish.moved(name="rim_lip").only(lip, "rim_cut")]


def spokes(half, rim):
    """Five pairs of spokes, each a bent bar of trapezoid section, from the hub out to the barrel."""
    out = []
    edge = half - .018
    reach = rim - .014
    for k in range(5):
        for s in (-1, 1):
            path, sections = [], []
            for t in (0, .1, .25, .45, .65, .8, .91, 1):
                r = .045 + (reach - .045) * t
                spread = s * (.015 + .039 * t ** 1.15)
                x = edge - .040 + .034 * t ** .8 - .008 * np.sin(np.pi * t)
                w = .0150 - .0045 * np.sin(np.pi * t * .8) + .011 * (1 - t) ** 3 + .013 * t ** 6
                d = .020 - .004 * t + .010 * t ** 6 + .006 * (1 - t) ** 3
                path.append((x, r, spread))
                sections.append([(-w, 0), (-w * .55, d * .42), (w * .55, d * .42), (w, 0), (w * .8, -d * 1.3), (-w * .8, -d * 1.3)])
            out.append(bar(path, sections).moved(turned(0, 72 * k)))
    # Their fronts are cut bright, the rest is painted.
    m = len(sections[0])
    front = lambda k: k < m * (len(path) - 1) and k % m == 1
    return [joined("spokes", [part.only(lambda k: not front(k)) for part in out]),
            joined("spoke_fronts", [part.only(front, "rim_cut") for part in out])]


def bar(path, sections):
    """A bar along +y: sections as (across z, along x), whose face between the second and third corner looks ahead."""
    m = len(sections[0])
    points = [(p[0] + s[1], p[1], p[2] + s[0]) for p, section in zip(path, sections) for s in section]
    n = len(path)
    faces = [[i * m + j, (i + 1) * m + j, (i + 1) * m + (j + 1) % m, i * m + (j + 1) % m] for i in range(n - 1) for j in range(m)]
    faces += [list(range(m)), [(n - 1) * m + j for j in range(m)][::-1]]
    return oriented(smooth("spoke", "rim", points, faces, 40))


def hub(half):
    x = half - .018
    centre = lathe("hub", "rim", [(x - .075, .062), (x - .040, .068), (x - .026, .066), (x - .020, .058), (x - .019, .036), (x - .022, .034), (x - .022, 0)], 32, 35)
    cap = lathe("cap", "gloss_black", [(x - .022, .0325), (x - .017, .031), (x - .0155, .026), (x - .0145, 0)], 32, 30)
    nuts = []
    for k in range(5):
        nut = lathe("nut", "chrome", [(x - .026, .0095), (x - .014, .0095), (x - .012, .007), (x - .012, 0)], 6, 30)
        nuts.append(nut.moved(turned(0, 72 * k + 36) , turned(0, 72 * k + 36) @ (0, .050, 0)))
    return [oriented(centre), oriented(cap), oriented(joined("nuts", nuts))]


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


def settled(part):
    """A tyre that the car's weight presses flat on the road, and out at its sides."""
    part = part.copy()
    x, y = part.points[:, 0], part.points[:, 1]
    middle = (x.min() + x.max()) / 2
    low = np.clip((.095 - y) / .095, 0, 1) ** 2
    part.points[:, 0] += np.sign(x - middle) * .012 * low * (np.abs(x - middle) > .09)
    part.points[:, 1] = np.maximum(y, .0004 + .012 * np.maximum(y + .008, 0))
    return part


def wheel(kind, name, at, side, steer=0.0):
    """All parts of a wheel; `side` 1 is the left."""
    half, radius, rim = kind
    still, caliper = brake(half, rim, kind is FRONT_WHEEL)
    caliper = caliper.moved(turned(0, -62 if kind is FRONT_WHEEL else 62))
    turn = turned(0, 11.0 * (1 + at[2]))
    rolling = [tyre(*kind), lettering(*kind, side)] + barrel(half, rim) + spokes(half, rim) + hub(half)
    parts = [p.moved(turn) for p in rolling] + still + [caliper]
    out = []
    for part in parts:
        part = part if side > 0 else part.mirrored()
        part = part.moved(turned(1, steer), at, name + "_" + part.name)
        out.append(settled(part) if part.material == "tyre" else part)
    return out


def wheels():
    out = []
    for side, word in ((1, "left"), (-1, "right")):
        out += wheel(FRONT_WHEEL, "front_" + word, (side * .864, .329, 1.325), side)
        out += wheel(REAR_WHEEL, "rear_" + word, (side * .842, .346, -1.325), side)
    return out
