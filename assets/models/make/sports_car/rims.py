"""Rims: a deep barrel with a bright lip, ten spokes in five pairs whose faces are cut bright, a hub with nuts in seats, and a cap with the maker's letter."""

import numpy as np

from letters import text
from mesh import joined, smooth
from shapes import lathe, oriented, tube, turned

# How far within the rim's edge the hub's face lies.
SET_BACK = .018
# Radius of the circle of nuts.
NUTS = .0585


def barrel(half, rim):
    """The dish: lip, step and bed of the rim, outside and inside, one closed turn."""
    h, r = half, rim
    profile = [(h - .005, r + .002), (h - .001, r + .0005), (h, r - .003), (h - .0015, r - .008), (h - .006, r - .0125), (h - .016, r - .015), (h - .024, r - .021), (h - .055, r - .027),
               (-h + .03, r - .032), (-h + .006, r - .012), (-h + .001, r - .006), (-h + .002, r), (-h + .010, r - .001), (-h + .022, r - .014), (-h + .05, r - .022),
               (h - .05, r - .018), (h - .022, r - .006), (h - .012, r)]
    steps = 52
    dish = oriented(lathe("rim", "rim", profile, steps, 40, closed=True))
    lip = lambda k: k < 5 * steps
    return [dish.only(lambda k: not lip(k)), dish.moved(name="rim_lip").only(lip, "rim_cut")]


def spokes(half, rim):
    """Each a bar that is narrowest half-way, with bevelled edges, deep at the hub, and spreads where it meets the lip."""
    out = []
    edge, reach = half - SET_BACK, rim - .0135
    steps = (0, .12, .28, .46, .64, .80, .91, 1)
    for k in range(5):
        for s in (-1, 1):
            path, sections = [], []
            for t in steps:
                r = .052 + (reach - .052) * t
                spread = s * (.019 + .041 * t ** 1.1)
                x = edge - .036 + .034 * t ** .9 - .010 * np.sin(np.pi * t)
                w = .0205 - .0050 * np.sin(np.pi * t ** .9) + .010 * t ** 7
                d = .030 - .010 * t + .010 * t ** 7
                path.append((x, r, spread))
                sections.append([(-w, -.004), (-w * .74, .0045), (w * .74, .0045), (w, -.004), (w * .72, -d), (-w * .72, -d)])
            out.append(bar(path, sections).moved(turned(0, 72 * k)))
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
    """The hub's face, nuts in dark seats round it."""
    x = half - SET_BACK
    centre = lathe("hub", "rim", [(x - .080, .072), (x - .046, .084), (x - .034, .084), (x - .026, .077), (x - .0235, .068), (x - .0235, .043), (x - .020, .040), (x - .020, 0)], 40, 32)
    nuts, seats = [], []
    for k in range(5):
        turn = turned(0, 72 * k + 36)
        at = turn @ (0, NUTS, 0)
        seats.append(lathe("nut_seats", "gap_black", [(x - .0240, .0145), (x - .0228, .0145), (x - .0228, 0)], 14, 30).moved(turn, at))
        nut = lathe("nuts", "chrome", [(x - .026, .0108), (x - .013, .0108), (x - .010, .0082), (x - .0095, 0)], 6, 30)
        nuts.append(nut.moved(turn, at))
    return [oriented(centre), oriented(joined("nut_seats", seats)), oriented(joined("nuts", nuts))]


def cap(half, side):
    """A black dome in a ring of chrome, with the letter; `side` as of the tyres' names."""
    x = half - SET_BACK - .020
    dome = lathe("cap", "gloss_black", [(x, .0345), (x + .0052, .0335), (x + .0072, .027), (x + .0078, 0)], 30, 35)
    turn = np.arange(30) * 2 * np.pi / 30
    ring = oriented(tube("cap_ring", "chrome", np.stack([0 * turn + x + .0055, .0335 * np.cos(turn), .0335 * np.sin(turn)], 1), .0028, 8, closed=True))
    letter = text("cap_letter", "badge", "L", .030, .0016, lambda across, up, out: (x + .0072 + out, up, -side * across), .20)
    return [oriented(dome), ring, letter]


def parts(half, rim, side):
    return barrel(half, rim) + spokes(half, rim) + hub(half) + cap(half, side)
