"""Below and around the body: wheel wells, floor, splitter, diffuser, mirrors, wipers."""

import numpy as np

from edges import rim
from mesh import joined, smooth, unit
from panels import ARCHES
from shapes import disk, lathe, oriented, plate, soft_loft, squared, sweep
from shell import pair, planar
from surface import on_top


def wells():
    out = []
    for k, (z, y, r) in enumerate(ARCHES):
        a = np.radians(np.linspace(-33, 213, 32))
        ring = [(y + (r + .003) * np.sin(t), z + (r + .003) * np.cos(t)) for t in a]
        points, faces = [], []
        for x in (.945, .58):
            points += [(x, yy, zz) for yy, zz in ring]
        n = len(ring)
        faces = [[j, n + j, n + j + 1, j + 1] for j in range(n - 1)]
        back = list(range(n, 2 * n))
        liner = smooth("well", "liner", points, faces + [back], 40)
        # Seen from inside: normals towards the axle.
        inward = liner.points[liner.faces[5]].mean(0) - (0, y, z)
        n0 = liner.normals[liner.corners[5][0]]
        if n0[1] * inward[1] + n0[2] * inward[2] > 0:
            liner = liner.flipped()
        out += pair(liner.moved(name="well_front" if k == 0 else "well_rear"))
    return out


def floor_width(z):
    w = np.interp(z, [-1.60, -.92, -.88, .90, .94, 1.72, 1.74, 1.95, 2.2, 2.30], [.56, .56, .90, .90, .56, .56, .86, .80, .45, .15])
    return w


def floor():
    z = np.array([-1.60, -.92, -.88, 0, .90, .94, 1.72, 1.74, 1.95, 2.2, 2.30])
    w = floor_width(z)
    outline = [(a, b) for a, b in zip(w, z)] + [(-a, b) for a, b in zip(w[::-1], z[::-1])]
    return [plate("floor", "underbody", outline, .112, .122)]


def lower_edge(skin, low, high, height):
    """Corners of the body's open lower edge, between two z."""
    ids = {v for e in rim(skin.points, skin.faces) for v in e}
    p = skin.points[sorted(ids)]
    keep = (p[:, 1] < height) & (p[:, 2] > low) & (p[:, 2] < high)
    return p[keep]


def splitter(skin):
    """A blade of carbon under the front bumper."""
    p = lower_edge(skin, 1.69, 3, .16)
    p = p[np.argsort(p[:, 0])][:, [0, 2]]
    keep = [p[0]]
    for q in p[1:]:
        if np.hypot(*(q - keep[-1])) > .02:
            keep.append(q)
    p = np.array(keep)
    t = np.gradient(p, axis=0)
    out = unit(np.stack([-t[:, 1], t[:, 0]], 1))
    out[0] = (0, 1)
    grow = np.interp(p[:, 0], [0, .5, .80, .90], [.046, .044, .036, .010])[:, None]
    outer = p + out * grow
    inner = p - out * .05
    outline = np.concatenate([outer, inner[::-1], (inner * (-1, 1))[1:], (outer * (-1, 1))[::-1][:-1]])
    blade = plate("splitter", "trim_black", outline, .100, .116)
    edge = np.concatenate([outer[::-1], (outer * (-1, 1))[1:]])
    rolled = sweep("splitter_edge", "gloss_black", np.stack([edge[:, 0], 0 * edge[:, 0] + .108, edge[:, 1]], 1), disk(.0105, 10), 60)
    return [planar(blade, (0, 2), 30), oriented(rolled)]


def side_blades():
    """A blade along the foot of each sill, thinner outwards, that turns up into a fin before the rear wheel."""
    z = np.array([.915, .86, .74, .5, .2, -.1, -.4, -.64, -.78, -.86, -.90])
    x = .930 + .046 * np.array([0, .45, .85, 1, 1, 1, 1, 1, 1, .9, .7])
    path = np.stack([x, np.full(len(z), .106), z], 1)
    section = [(-.055, -.008), (.008, -.008), (.014, -.004), (.014, .000), (.008, .004), (-.055, .010)]
    points = np.array([(p[0] + u, p[1] + v, p[2]) for p in path for u, v in section])
    n, m = len(path), len(section)
    faces = [[i * m + j, (i + 1) * m + j, (i + 1) * m + (j + 1) % m, i * m + (j + 1) % m] for i in range(n - 1) for j in range(m)]
    faces += [list(range(m)), [(n - 1) * m + j for j in range(m)][::-1]]
    blade = oriented(smooth("side_blade", "gloss_black", points, faces, 25))
    fin = plate("side_blade_fin", "gloss_black", [(.104, -.60), (.128, -.74), (.190, -.845), (.196, -.872), (.104, -.885)], .978, .986, axes=(1, 2), up=0)
    return pair(blade) + pair(fin)


def diffuser():
    """A ramp that begins below the engine, with fins that reach out behind it."""
    ramp = plate("ramp", "carbon", [(.130, -1.50), (.285, -2.105), (.300, -2.100), (.145, -1.49)], -.665, .665, axes=(1, 2), up=0)
    parts = []
    for x in (-.50, -.30, -.10, .10, .30, .50):
        shape = [(.120, -1.60), (.142, -1.85), (.178, -2.05), (.196, -2.105), (.222, -2.126), (.290, -2.118), (.150, -1.55)]
        parts.append(plate("fin", "trim_black", shape, x - .005, x + .005, axes=(1, 2), up=0))
    for x in (-.665, .665):
        shape = [(.150, -1.60), (.180, -1.90), (.225, -2.03), (.30, -2.07), (.40, -2.05), (.40, -1.9), (.20, -1.60)]
        parts.append(plate("fin", "trim_black", shape, x - .009, x + .009, axes=(1, 2), up=0))
    edge = plate("diffuser_edge", "trim_black", [(.283, -2.095), (.300, -2.118), (.312, -2.118), (.312, -2.03), (.295, -2.03)], -.66, .66, axes=(1, 2), up=0)
    return [planar(ramp, (0, 2), 30), joined("diffuser_fins", parts), edge]


def mirror_arm():
    """A short wing from a foot at the door's upper corner to the shell."""
    rings = []
    for centre, along, thick in (((.800, .778, .742), .066, .012), ((.832, .786, .738), .060, .010), ((.866, .793, .730), .052, .009),
                                 ((.905, .803, .722), .050, .009), ((.950, .818, .714), .058, .012)):
        u, v = squared(along, thick, .8, 12)
        rings.append(np.stack([centre[0] - .4 * v, centre[1] + v, centre[2] + u], 1))
    return soft_loft("leg", "gloss_black", rings, 1)


def mirrors():
    """A shell that tapers ahead, on a short wing, with a pane."""
    x, y, z = .968, .850, .640
    rings = []
    for t, half, height in ((0, .100, .043), (.08, .108, .049), (.30, .107, .048), (.60, .098, .040), (.85, .078, .027), (1, .046, .012)):
        u, v = squared(half, height, .5, lean=.20)
        rings.append(np.stack([x + u - .050 * t ** 1.5, y + v - .022 * t, z + .190 * t + .018 * (-u / .1) * (1 - .5 * t)], 1))
    shell = soft_loft("mirror", "paint", rings, 2)
    u, v = squared(.089, .036, .5, 28, .20)
    glass = np.stack([x + u, y + v, z - .004 - .18 * u], 1)
    below = [k for k, f in enumerate(shell.faces) if shell.points[f, 1].mean() < y - .012 - .02 * (shell.points[f, 2].mean() - z) / .19]
    foot = shell.only(lambda k: k in set(below), "gloss_black").moved(name="mirror_foot")
    shell = shell.only(lambda k: k not in set(below))
    pane = smooth("mirror_pane", "mirror", glass, [list(range(len(u)))[::-1]], 30)
    edge = sweep("mirror_edge", "gloss_black", glass + (0, 0, .004), disk(.0055, 8), 60, closed=True)
    legs = [mirror_arm()]
    out = []
    for part in (shell, foot, pane, oriented(edge), joined("mirror_legs", legs)):
        out += pair(part)
    return out


def wipers(skin):
    """Two arms with blades at rest along the foot of the windscreen."""
    parts = []
    for pivot, tip in (((.30, 1.112), (-.10, 1.055)), ((-.16, 1.132), (-.475, .955))):
        arm = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t, .012 + .012 * np.sin(np.pi * t)) for t in np.linspace(0, .62, 6)]
        blade = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t - .004, .010) for t in np.linspace(.12, 1.12, 14)]
        rubber = [b - np.array((0, .004, 0)) for b in blade]
        parts.append(sweep("wiper", "trim_black", arm, [(-.009, -.004), (.009, -.004), (.007, .004), (-.007, .004)], 30))
        parts.append(sweep("wiper", "trim_black", blade, [(-.005, -.006), (.005, -.006), (.003, .006), (-.003, .006)], 30))
        knob = lathe("wiper", "trim_black", [(-.02, .015), (.010, .015), (.015, .011), (.015, 0)], 20, 40)
        m = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
        parts.append(oriented(knob).moved(m, on_top(skin, pivot[0], pivot[1], 0)))
    return [joined("wipers", parts)]


def all_parts(skin):
    return wells() + floor() + splitter(skin) + side_blades() + diffuser() + mirrors() + wipers(skin)
