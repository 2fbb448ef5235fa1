"""Below and around the body: wheel wells, floor, splitter, diffuser, exhausts, mirrors, wipers."""

import numpy as np

from edges import rim
from mesh import joined, smooth, unit
from panels import ARCHES
from shapes import disk, lathe, oriented, plate, soft_loft, sweep
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
    p = lower_edge(skin, 1.80, 3, .13)
    p = p[np.argsort(p[:, 0])][:, [0, 2]]
    keep = [p[0]]
    for q in p[1:]:
        if np.hypot(*(q - keep[-1])) > .02:
            keep.append(q)
    p = np.array(keep)
    t = np.gradient(p, axis=0)
    out = unit(np.stack([-t[:, 1], t[:, 0]], 1))
    out[0] = (0, 1)
    grow = np.interp(p[:, 0], [0, .5, .80, .90], [.022, .020, .014, .004])[:, None]
    outer = p + out * grow
    inner = p - out * .05
    outline = np.concatenate([outer, inner[::-1], (inner * (-1, 1))[1:], (outer * (-1, 1))[::-1][:-1]])
    blade = plate("splitter", "trim_black", outline, .100, .116)
    return [planar(blade, (0, 2), 30)]


def diffuser():
    """A ramp with fins between the lower corners of the tail."""
    parts = []
    ramp = plate("ramp", "carbon", [(.135, -1.55), (.30, -2.135), (.315, -2.13), (.15, -1.54)], -.53, .53, axes=(1, 2), up=0)
    parts.append(planar(ramp, (0, 2), 30))
    for x in (-.45, -.27, -.09, .09, .27, .45):
        fin = plate("fin", "trim_black", [(.120, -1.66), (.165, -2.06), (.205, -2.13), (.245, -2.145), (.292, -2.13), (.15, -1.60)], x - .005, x + .005, axes=(1, 2), up=0)
        parts.append(fin)
    # Above the ramp is a face, behind the exhausts.
    for x in (-.535, .535):
        parts.append(plate("fin", "trim_black", [(.150, -1.68), (.205, -2.00), (.265, -2.085), (.345, -2.06), (.345, -1.9), (.20, -1.66)], x - .008, x + .008, axes=(1, 2), up=0))
    fins = joined("diffuser_fins", parts[1:])
    wall = plate("diffuser_wall", "trim_black", [(.29, -2.09), (.43, -2.06), (.43, -2.05), (.29, -2.08)], -.55, .55, axes=(1, 2), up=0)
    return [parts[0], fins, wall]


def exhausts():
    out = []
    for x in (-.20, .20):
        pipe = lathe("exhaust", "exhaust", [(-.16, .046), (.010, .050), (.016, .0535), (.022, .054), (.025, .0525), (.024, .050), (.012, .047), (-.14, .044)], 40, 40)
        inside = lathe("exhaust_inside", "gap_black", [(-.13, .0442), (-.13, 0)], 24)
        m = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], float)
        collar = lathe("exhaust_collar", "gloss_black", [(-.10, .058), (.016, .060), (.024, .064), (.028, .069), (.024, .074), (-.02, .078), (-.10, .078)], 40, 40)
        for part in (oriented(pipe), inside, oriented(collar)):
            out.append(part.moved(m, (x, .352, -2.155), part.name + ("_left" if x > 0 else "_right")))
    return out


def squared(half, height, power, steps=16, lean=0.0):
    """A rounded rectangle, a little higher on its outer side by `lean`."""
    turn = np.arange(steps) * 2 * np.pi / steps
    c, s = np.cos(turn), np.sin(turn)
    return np.sign(c) * np.abs(c) ** power * half, np.sign(s) * np.abs(s) ** power * height * (1 + lean * c)


def mirror_arm():
    """A blade that grows out of a broad foot at the corner of the side window and bears the shell."""
    rings = []
    for centre, along, thick in (((.735, .782, .615), .125, .040), ((.790, .795, .600), .100, .030), ((.850, .815, .580), .062, .017),
                                 ((.910, .848, .558), .044, .012), ((.955, .885, .545), .042, .012)):
        u, v = squared(along, thick, .8, 10)
        rings.append(np.stack([centre[0] - .5 * v, centre[1] + v, centre[2] + u], 1))
    return soft_loft("leg", "gloss_black", rings, 1)


def mirrors():
    """A shell that tapers ahead, painted above and black below, on two thin legs, with a pane."""
    x, y, z = .975, .905, .465
    rings = []
    for t, half, height in ((0, .100, .047), (.10, .107, .053), (.38, .106, .053), (.68, .092, .043), (.88, .062, .027), (1, .022, .009)):
        u, v = squared(half, height, .5, lean=.20)
        rings.append(np.stack([x + u - .050 * t ** 1.5, y + v - .016 * t, z + .150 * t + .055 * (-u / .1) * (1 - .5 * t)], 1))
    shell = soft_loft("mirror", "paint", rings, 1)
    below = [shell.points[f].mean(0)[1] < y - .019 - .014 * (shell.points[f].mean(0)[2] - z) / .15 for f in shell.faces]
    upper, lower = shell.only(lambda k: not below[k]), shell.moved(name="mirror_foot").only(lambda k: below[k], "gloss_black")
    u, v = squared(.089, .040, .5, 28, .20)
    glass = np.stack([x + u, y + v, z - .004 - .55 * u], 1)
    pane = smooth("mirror_pane", "mirror", glass, [list(range(len(u)))[::-1]], 30)
    edge = sweep("mirror_edge", "gloss_black", glass + (0, 0, .004), disk(.0055, 8), 60, closed=True)
    legs = [mirror_arm()]
    out = []
    for part in (upper, lower, pane, oriented(edge), joined("mirror_legs", legs)):
        out += pair(part)
    return out


def wipers(skin):
    """Two arms with blades at rest along the foot of the windscreen."""
    parts = []
    for pivot, tip in (((.30, .925), (-.10, .862)), ((-.16, .945), (-.475, .765))):
        arm = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t, .020 + .012 * np.sin(np.pi * t)) for t in np.linspace(0, .62, 6)]
        blade = [on_top(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t - .004, .010) for t in np.linspace(.12, 1.12, 14)]
        rubber = [b - np.array((0, .004, 0)) for b in blade]
        parts.append(sweep("wiper", "trim_black", arm, [(-.009, -.004), (.009, -.004), (.007, .004), (-.007, .004)], 30))
        parts.append(sweep("wiper", "trim_black", blade, [(-.005, -.006), (.005, -.006), (.003, .006), (-.003, .006)], 30))
        knob = lathe("wiper", "trim_black", [(-.02, .016), (.028, .016), (.034, .012), (.034, 0)], 20, 40)
        m = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
        parts.append(oriented(knob).moved(m, on_top(skin, pivot[0], pivot[1], 0)))
    return [joined("wipers", parts)]


def all_parts(skin):
    return wells() + floor() + splitter(skin) + diffuser() + exhausts() + mirrors() + wipers(skin)
