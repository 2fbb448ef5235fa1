"""The dark lower edge ahead of the rear wheels: a splitter at the nose and a blade along each sill, below an even gap; where these meet an arch they turn up into it."""

import numpy as np

from mesh import smooth, unit
from panels import ARCHES, FOOT, ROUND, corner
from sculpt import step
from shell import pair
from skirt import border
from surface import nearest

# Across the blade, from inside of the body over the gap and round its edge to below the floor: how far in, and how far below the body's edge. Of the sill, and
# of the splitter.
HIGH = .042
SILL = ((.024, -.020), (.024, .012), (.011, .013), (.009, .0155), (.009, .036), (.0115, .040), (.016, HIGH), (.12, HIGH))
SPLITTER = ((.020, -.020), (.020, .013), (-.019, .019), (-.0235, .022), (-.0245, .034), (-.022, .039), (-.016, HIGH), (.12, HIGH))
# Between these z the splitter becomes as the sill is.
NARROWS = (2.18, 1.86)
# Where it turns up: over what way ahead of the corner it has become how low, how far in it stands then, how many degrees it follows the arch, and its end.
LOWERS, LOW, DEEPER, FOLLOWS, END = .10, .020, .018, 30, .008
# How many sections the corner and the arch have.
BEND, RISE = 6, 9


def turn_up(whole, k, way):
    """The course from the corner's foot round it and up the arch: points, and how high the blade is at each."""
    z, y, radius = ARCHES[k]
    centre, _ = corner(z, y, radius, way)
    middle = np.array((z, y))
    first = np.arctan2(*(centre - middle)[::-1])
    toward = np.arctan2(*(middle - centre)[::-1])
    below = -np.pi / 2
    toward += 2 * np.pi * np.round((below - toward) / (2 * np.pi))
    course = [centre + ROUND * np.array((np.cos(a), np.sin(a))) for a in np.linspace(below, toward, BEND)]
    course += [middle + radius * np.array((np.cos(a), np.sin(a))) for a in first + way * np.radians(np.linspace(0, FOLLOWS, RISE))[1:]]
    x = [nearest(whole, (max(b, FOOT + .01), a), (1, 2), 0, 1, .3)[0] for a, b in course]
    high = np.concatenate([np.full(BEND, LOW), np.linspace(LOW, END, RISE)[1:]])
    return np.array([(u, b, a) for u, (a, b) in zip(x, course)]), high


def stretch(whole, path, begin, end):
    """The lower edge between two corners (or from the middle line on), with what turns up: points, heights, and how much of it stands deeper in."""
    before, after = (turn_up(whole, *c) if c else None for c in (begin, end))
    low = np.zeros(len(path))
    for up in (before, after):
        if up:
            low = np.maximum(low, 1 - step(np.abs(path[:, 2] - up[0][0, 2]) / LOWERS))
    rows = [(path, HIGH + (LOW - HIGH) * low, low)]
    if before:
        rows.insert(0, (before[0][::-1], before[1][::-1], np.ones(len(before[1]))))
    if after:
        rows.append((*after, np.ones(len(after[1]))))
    return [np.concatenate(column) for column in zip(*rows)]


def blade(points, heights, deep, open_first):
    along = unit(np.gradient(points, axis=0))
    for _ in range(2):
        along[1:-1] = unit(along[:-2] + 2 * along[1:-1] + along[2:])
    out = np.stack([-along[:, 2], 0 * deep, along[:, 0]], 1)
    # Up an arch it goes on looking as it did at the corner.
    flat = np.hypot(along[:, 0], along[:, 2]) > .96
    out[~flat] = (1, 0, 0)
    out = unit(out)
    down = unit(np.cross(along, out))
    share = step((points[:, 2] - NARROWS[1]) / (NARROWS[0] - NARROWS[1]))[:, None, None]
    section = np.array(SILL) * (1 - share) + np.array(SPLITTER) * share
    rows = np.array([p - o * (s[:, :1] + DEEPER * w) + d * np.where(s[:, 1:] > 0, s[:, 1:] * h / HIGH, s[:, 1:])
                     for p, o, d, s, h, w in zip(points, out, down, section, heights, deep)])
    n, m = rows.shape[:2]
    faces = [[i * m + k, i * m + k + 1, (i + 1) * m + k + 1, (i + 1) * m + k] for i in range(n - 1) for k in range(m - 1)]
    ends = [list(range(m))[::-1], [(n - 1) * m + k for k in range(m)]]
    part = smooth("sill", "trim_black", rows.reshape(-1, 3), faces + ends[open_first:], 50)
    side = next(k for k, f in enumerate(faces) if f[0] == (n // 2) * m + 3)
    return part if part.normals[part.corners[side][0]] @ out[n // 2] > 0 else part.flipped()


def all_parts(whole):
    path = border(whole)
    parts = []
    for name, begin, end in (("splitter", None, (0, 1)), ("sill", (0, -1), (1, 1))):
        reach = [np.inf if c is None else corner(*ARCHES[c[0]], c[1])[0][0] for c in (begin, end)]
        own = path[(path[:, 2] < reach[0] - .01) & (path[:, 2] > reach[1] + .01)]
        parts += pair(blade(*stretch(whole, own, begin, end), begin is None).moved(name=name))
    return parts
