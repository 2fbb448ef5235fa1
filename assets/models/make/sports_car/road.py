"""The road: asphalt with markings and repairs, a kerb with joints, paving, a low stone wall."""

import numpy as np

from mesh import joined, smooth, unit
from shapes import box

KERB, WALL = -1.72, -3.35
# How far ahead and behind the wall is laid block by block.
WALL_ENDS = 52.0


def boxed_uv(part, scale, seed=None):
    """Texture coordinates by the axis that a face looks along; with a seed, moved at random for the whole part."""
    shift = np.random.default_rng(seed).random(2) * 7 if seed is not None else np.zeros(2)
    uvs, corners = [], []
    for k, f in enumerate(part.faces):
        n = np.abs(part.normals[part.corners[k]].mean(0))
        axes = ((2, 1), (0, 2), (0, 1))[int(np.argmax(n))]
        corners.append(list(range(len(uvs), len(uvs) + len(f))))
        uvs += [part.points[v][list(axes)] * scale + shift for v in f]
    part.uvs, part.uv_corners = np.array(uvs), corners
    return part


def soft_uv(part, scale):
    """As above, but by the normal at each position, so that coordinates are shared."""
    n = np.zeros_like(part.points)
    for f, c in zip(part.faces, part.corners):
        n[f] = part.normals[c]
    axis = np.abs(n).argmax(1)
    p = part.points
    part.uvs = np.where((axis == 0)[:, None], p[:, [2, 1]], np.where((axis == 1)[:, None], p[:, [0, 2]], p[:, [0, 1]])) * scale
    part.uv_corners = part.faces
    return part


def block(name, material, centre, size, bevel, out=1):
    """A box whose edges are cut at `out`, an axis along which it is seen; the opposite side, which nobody sees, is open."""
    half = np.asarray(size, float) / 2
    u, v = (out + 1) % 3, (out + 2) % 3
    points = []
    for depth, inset in ((-half[out], 0), (half[out] - bevel, 0), (half[out], bevel)):
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            p = np.array(centre, float)
            p[out], p[u], p[v] = p[out] + depth, p[u] + a * (half[u] - inset), p[v] + b * (half[v] - inset)
            points.append(p)
    faces = [[4 * i + k, 4 * i + (k + 1) % 4, 4 * i + 4 + (k + 1) % 4, 4 * i + 4 + k] for i in range(2) for k in range(4)]
    return smooth(name, material, points, faces + [[8, 9, 10, 11]], 20)


def sheet(name, material, xs, zs, height, scale):
    """A field of quads over x and z, facing up."""
    points = np.array([(x, height(x, z) if callable(height) else height, z) for x in xs for z in zs])
    m = len(zs)
    faces = [[i * m + j, i * m + j + 1, (i + 1) * m + j + 1, (i + 1) * m + j] for i in range(len(xs) - 1) for j in range(m - 1)]
    part = smooth(name, material, points, faces, 60)
    part.uvs = points[:, [0, 2]] * scale
    part.uv_corners = faces
    return part


def surface():
    far = np.array((-220, -60, -25, -10, 0, 10, 25, 60, 220.0))
    out = [sheet("asphalt", "asphalt", (KERB + .02, 0, 3, 9), far, lambda x, z: 0.0, .5)]
    line = sheet("edge_line", "marking", (-1.46, -1.34), (-90, 90), .003, .9)
    dashes = [sheet("dashes", "marking", (2.34, 2.46), (z, z + 3.0), .003, .9) for z in np.arange(-76.6, 80, 7.2)]
    other = sheet("far_line", "marking", (6.2, 6.32), (-90, 90), .003, .9)
    out += [line, joined("dashes", dashes), other]
    out += repairs()
    near = [k * 1.0 for k in range(-18, 18)]
    stones = []
    for k, z in enumerate(near):
        rng = np.random.default_rng(100 + k)
        stone = block("kerb", "kerb", (KERB - .075 + rng.normal(0, .002), .035 + rng.normal(0, .002), z + .5), (.15, .17, .992), .012)
        stones.append(boxed_uv(stone, 1.3, 200 + k))
    for z in ((-220, -18), (18, 220)):
        stones.append(boxed_uv(block("kerb", "kerb", (KERB - .075, .035, sum(z) / 2), (.15, .17, z[1] - z[0]), .012), 1.3, 7))
    out.append(joined("kerb", stones))
    out.append(sheet("pavement", "pavement", (WALL + .1, KERB - .15), far, .108, .62))
    return out


def ribbon(name, material, points, widths, height):
    """A flat strip along points (x, z)."""
    p = np.asarray(points, float)
    t = unit(np.gradient(p, axis=0))
    side = np.stack([t[:, 1], -t[:, 0]], 1) * np.reshape(widths, (-1, 1)) / 2
    a, b = p + side, p - side
    n = len(p)
    out = np.array([(x, height, z) for x, z in np.concatenate([a, b])])
    faces = [[k, k + 1, n + k + 1, n + k] for k in range(n - 1)]
    part = smooth(name, material, out, faces, 60)
    if part.normals[0][1] < 0:
        part = smooth(name, material, out, [f[::-1] for f in faces], 60)
    part.uvs, part.uv_corners = out[:, [0, 2]] * 1.0, part.faces
    return part


def crack(rng, start, heading, count, wide):
    """A crack that wanders in short steps, here and there nearly closed: its points and its ribbon."""
    p, a, line = np.array(start), heading, []
    for _ in range(count):
        line.append(p)
        a += rng.normal(0, .42) + .16 * (heading - a)
        p = p + np.array((np.cos(a), np.sin(a))) * .045
    taper = np.interp(np.arange(count), [0, 3, count - 4, count - 1], [.2, 1, 1, .1])
    return line, ribbon("seals", "bitumen", line, wide * taper * rng.uniform(.25, 1.6, count), .002)


def patch(rng):
    """A mended place whose edges are worn, with a seal that has come off in places."""
    corners = np.array(((.25, 4.9), (1.45, 5.0), (1.38, 7.6), (.32, 7.5), (.25, 4.9)))
    rim = np.concatenate([a + (b - a) * np.linspace(0, 1, 24)[:-1, None] for a, b in zip(corners, corners[1:])])
    rim = rim + rng.normal(0, .012, rim.shape)
    points = np.array([(x, .001, z) for x, z in rim])
    middle = len(points)
    points = np.concatenate([points, [(rim[:, 0].mean(), .001, rim[:, 1].mean())]])
    faces = [[middle, (k + 1) % middle, k] for k in range(middle)]
    part = smooth("patch", "asphalt_new", points, faces, 60)
    if part.normals[0][1] < 0:
        part = smooth("patch", "asphalt_new", points, [f[::-1] for f in faces], 60)
    part.uvs, part.uv_corners = points[:, [0, 2]] * .5, part.faces
    edge = ribbon("patch_edge", "bitumen", np.concatenate([rim, rim[:1]]), np.clip(rng.normal(.010, .010, middle + 1), .001, .03), .002)
    return [part, edge]


def repairs():
    """Sealed cracks, a mended patch, a manhole cover and a gully by the kerb."""
    rng = np.random.default_rng(41)
    seals = []
    for start, heading, count in (((4.6, -2.2), 2.5, 70), ((5.6, 5), 3.6, 80), ((3.2, -16), 1.7, 90), ((2.0, -7.5), .5, 50)):
        line = crack(rng, start, heading, count, .009)
        seals.append(line[1])
        for k in range(9, count - 8, 14):
            seals.append(crack(rng, line[0][k], heading + rng.choice((-1, 1)) * rng.uniform(.5, 1.2), int(rng.uniform(6, 18)), .005)[1])
    out = [joined("seals", seals)]
    out += patch(rng)
    turn = np.arange(40) * 2 * np.pi / 40
    ring = lambda r, h: [(3.35 + r * np.cos(a), h, -3.6 + r * np.sin(a)) for a in turn]
    radii = ((.36, .002), (.33, .006), (.318, .006), (.314, -.004), (.306, -.004), (.302, .004), (0, .004))
    points = [q for r, h in radii for q in ring(max(r, .002), h)]
    faces = [[i * 40 + j, i * 40 + (j + 1) % 40, (i + 1) * 40 + (j + 1) % 40, (i + 1) * 40 + j] for i in range(len(radii) - 1) for j in range(40)]
    cover = smooth("manhole", "iron", points, faces, 30)
    cover = cover if cover.normals[cover.corners[0][0]][1] > 0 else smooth("manhole", "iron", points, [f[::-1] for f in faces], 30)
    knobs = [block("manhole_knobs", "iron", (3.35 + x * .052, .005, -3.6 + z * .052), (.028, .008, .028), .003) for x in range(-5, 6) for z in range(-5, 6) if np.hypot(x, z) < 5.2]
    out += [cover, joined("manhole_knobs", knobs)]
    bars = [block("gully", "iron", (KERB + .22, .002, 2.3 + k * .05), (.36, .010, .024), .003) for k in range(11)]
    bars += [block("gully", "iron", (KERB + .22 + s * .195, .002, 2.55), (.03, .012, .57), .003) for s in (-1, 1)]
    return out + [joined("gully", bars), sheet("gully_hole", "gap", (KERB + .04, KERB + .40), (2.28, 2.82), .001, 1)]


def wall():
    """Three courses of blocks, each a little different, here and there two low ones for one; a plain run far beyond; cap stones on top."""
    blocks = []
    rng = np.random.default_rng(9)
    foot = .108
    for course, high in enumerate((.243, .198, .225)):
        z = -WALL_ENDS - .23 * course
        while z < WALL_ENDS:
            long = rng.uniform(.26, .50) if rng.random() < .4 else rng.uniform(.45, .82)
            parts = [(0, high)]
            if rng.random() < .16:
                parts, long = [(0, high * .5), (high * .5, high * .5)], min(long, .5)
            for low, tall in parts:
                centre = (WALL - .17 + rng.normal(0, .009), foot + low + tall / 2, z + long / 2)
                blocks.append(boxed_uv(block("wall_blocks", "wall", centre, (.34, tall - .009, long - rng.uniform(.010, .018)), rng.uniform(.012, .024), 0), .9, int(rng.integers(1e6))))
            z += long
        foot += high
    out = [joined("wall_blocks", blocks)]
    out.append(box("wall_core", "mortar", (WALL - .17, .40, 0), (.24, .64, 2 * WALL_ENDS - .4), .01, 1))
    runs = [boxed_uv(block("wall_far", "wall", (WALL - .17, .10 + .333, sum(z) / 2), (.33, .70, z[1] - z[0]), .01, 0), .9, 5) for z in ((-200, .1 - WALL_ENDS), (WALL_ENDS - .1, 200))]
    out.append(joined("wall_far", runs))
    caps = []
    z = -36.0
    while z < 36:
        caps.append(boxed_uv(block("wall_caps", "wall_cap", (WALL - .17 + rng.normal(0, .004), .812 + rng.normal(0, .002), z + .45), (.42, .075, .892), .014), 1.0, int(rng.integers(1e6))))
        z += .9
    for span in ((-200, -36), (z, 200)):
        caps.append(boxed_uv(block("wall_caps", "wall_cap", (WALL - .17, .812, sum(span) / 2), (.42, .075, span[1] - span[0]), .014), 1.0, 3))
    out.append(joined("wall_caps", caps))
    return out


def all_parts():
    return surface() + wall()
