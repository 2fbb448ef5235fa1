"""Below and around the body: wheel wells, floor, splitter, diffuser, exhausts, mirrors, wipers."""

import numpy as np

from mesh import joined, smooth, unit
from panels import ARCHES
from shapes import disk, lathe, oriented, plate, soft_loft, sweep, tube, turned
from shell import both, pair, planar


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
    from skin import rim
    ids = {v for e in rim(skin.points, skin.faces) for v in e}
    p = skin.points[sorted(ids)]
    keep = (p[:, 1] < height) & (p[:, 2] > low) & (p[:, 2] < high)
    return p[keep]


def splitter(skin):
    """A blade of carbon under the front bumper."""
    p = lower_edge(skin, 1.72, 3, .13)
    p = p[np.argsort(p[:, 0])][:, [0, 2]]
    keep = [p[0]]
    for q in p[1:]:
        if np.hypot(*(q - keep[-1])) > .02:
            keep.append(q)
    p = np.array(keep)
    t = np.gradient(p, axis=0)
    out = unit(np.stack([-t[:, 1], t[:, 0]], 1))
    out[0] = (0, 1)
    grow = np.interp(p[:, 0], [0, .5, .88, .95], [.040, .035, .018, .006])[:, None]
    outer = p + out * grow
    inner = p - out * .05
    outline = np.concatenate([outer, inner[::-1], (inner * (-1, 1))[1:], (outer * (-1, 1))[::-1][:-1]])
    blade = plate("splitter", "carbon", outline, .100, .114)
    return [planar(blade, (0, 2), 30)]


def diffuser():
    """A ramp with fins between the lower corners of the tail."""
    parts = []
    ramp = plate("ramp", "carbon", [(.135, -1.55), (.30, -2.135), (.315, -2.13), (.15, -1.54)], -.58, .58, axes=(1, 2), up=0)
    parts.append(planar(ramp, (0, 2), 30))
    for x in (-.45, -.27, -.09, .09, .27, .45):
        fin = plate("fin", "trim_black", [(.120, -1.66), (.165, -2.06), (.205, -2.13), (.245, -2.145), (.292, -2.13), (.15, -1.60)], x - .005, x + .005, axes=(1, 2), up=0)
        parts.append(fin)
    # Above the ramp is a face, behind the exhausts.
    for x in (-.585, .585):
        parts.append(plate("fin", "trim_black", [(.150, -1.68), (.205, -2.04), (.265, -2.125), (.345, -2.10), (.345, -1.9), (.20, -1.66)], x - .008, x + .008, axes=(1, 2), up=0))
    fins = joined("diffuser_fins", parts[1:])
    wall = plate("diffuser_wall", "trim_black", [(.29, -2.09), (.43, -2.06), (.43, -2.05), (.29, -2.08)], -.66, .66, axes=(1, 2), up=0)
    return [parts[0], fins, wall]


def exhausts():
    out = []
    for x in (-.20, .20):
        pipe = lathe("exhaust", "exhaust", [(-.16, .046), (.010, .050), (.016, .0535), (.022, .054), (.025, .0525), (.024, .050), (.012, .047), (-.14, .044)], 40, 40)
        inside = lathe("exhaust_inside", "gap_black", [(-.13, .0442), (-.13, 0)], 24)
        m = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], float)
        sign = 1 if x > 0 else -1
        for part in (oriented(pipe), inside):
            out.append(part.moved(m, (x, .352, -2.155), part.name + ("_left" if x > 0 else "_right")))
    return out


def mirrors():
    """A shell on two thin legs, with a pane."""
    rings = []
    for t, (w, h) in zip((0, .25, .6, .85, 1), ((.110, .056), (.116, .062), (.108, .056), (.084, .041), (.045, .020))):
        turn = np.arange(16) * 2 * np.pi / 16
        c, s = np.cos(turn), np.sin(turn)
        u = np.sign(c) * np.abs(c) ** .42 * w
        v = np.sign(s) * np.abs(s) ** .42 * h * (1 + .18 * c)
        rings.append(np.stack([.985 + u - .035 * t, .912 + v - .012 * t, .485 + .105 * t + 0 * u], 1))
    shell = soft_loft("mirror", "paint", rings, 1)
    turn = np.arange(24) * 2 * np.pi / 24
    c, s = np.cos(turn), np.sin(turn)
    glass = np.stack([.985 + np.sign(c) * np.abs(c) ** .42 * .094, .912 + np.sign(s) * np.abs(s) ** .42 * .046 * (1 + .18 * c), np.full(24, .4795)], 1)
    pane = smooth("mirror_pane", "mirror", glass, [list(range(24))[::-1]], 30)
    edge = sweep("mirror_edge", "gloss_black", np.stack([glass[:, 0], glass[:, 1], glass[:, 2] + .004], 1), disk(.0055, 8), 60, closed=True)
    legs = [tube("leg", "gloss_black", [(.84, .79, .60), (.88, .815, .585), (.93, .872, .555), (.955, .90, .54)], .009, 10),
            tube("leg", "gloss_black", [(.84, .79, .545), (.885, .815, .54), (.945, .872, .53), (.97, .90, .52)], .008, 10)]
    out = []
    for part in (shell, pane, oriented(edge), joined("mirror_legs", legs)):
        out += pair(part)
    return out


def on_surface(skin, x, z, lift):
    """A point of the upper surface near x and z, lifted along its normal."""
    p = skin.points
    up = np.abs(skin.normals[:, 1]) > .25
    d = np.hypot(p[:, 0] - abs(x), p[:, 2] - z) + np.where(up, 0, 9)
    near = np.argsort(d)[:6]
    w = 1 / (d[near] ** 2 + 1e-6)
    w = w / w.sum()
    q, n = w @ p[near], unit(w @ skin.normals[near])
    y = q[1] - (n[0] * (abs(x) - q[0]) + n[2] * (z - q[2])) / n[1]
    out = np.array((abs(x), y, z)) + n * lift
    return out * (1 if x >= 0 else -1, 1, 1)


def wipers(skin):
    """Two arms with blades at rest along the foot of the windscreen."""
    parts = []
    for pivot, tip in (((.30, .925), (-.10, .862)), ((-.16, .945), (-.475, .765))):
        arm = [on_surface(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t, .020 + .012 * np.sin(np.pi * t)) for t in np.linspace(0, .62, 6)]
        blade = [on_surface(skin, pivot[0] + (tip[0] - pivot[0]) * t, pivot[1] + (tip[1] - pivot[1]) * t - .004, .010) for t in np.linspace(.12, 1.12, 14)]
        rubber = [b - np.array((0, .004, 0)) for b in blade]
        parts.append(sweep("wiper", "trim_black", arm, [(-.009, -.004), (.009, -.004), (.007, .004), (-.007, .004)], 30))
        parts.append(sweep("wiper", "trim_black", blade, [(-.005, -.006), (.005, -.006), (.003, .006), (-.003, .006)], 30))
        knob = lathe("wiper", "trim_black", [(-.02, .016), (.028, .016), (.034, .012), (.034, 0)], 20, 40)
        m = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], float)
        parts.append(oriented(knob).moved(m, on_surface(skin, pivot[0], pivot[1], 0)))
    return [joined("wipers", parts)]


def all_parts(skin):
    return wells() + floor() + splitter(skin) + diffuser() + exhausts() + mirrors() + wipers(skin)
