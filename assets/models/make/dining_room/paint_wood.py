"""Pictures of wood: planks of the floor with gloss and heights, boards for the furniture."""

import numpy as np

from noise import cloud, lattice, save, scale

OAK = [(92, 58, 33), (140, 94, 55), (176, 126, 78), (198, 150, 99)]
WALNUT = [(52, 30, 19), (86, 52, 33), (116, 74, 47), (142, 96, 63)]
BEECH = [(150, 103, 62), (182, 134, 86), (205, 160, 110), (222, 182, 134)]


def grain(height, width, seed):
    """From 0 (dark) to 1: years' rings, cut along, and pores; fibres run across the picture, left to right."""
    y = np.arange(height)[:, None] / height
    bend = cloud(height, width, 3, 2, seed, 4)
    rings = np.sin(2 * np.pi * (9 * y + 3.2 * bend + 1.1 * cloud(height, width, 2, 1, seed + 3, 2)))
    fibres = cloud(height, width, height // 6, 5, seed + 1, 3)
    pores = lattice(height, width, height // 2, 24, seed + 2)
    return np.clip(0.52 + 0.2 * rings * (0.5 + bend) + 0.55 * (fibres - 0.5) - 0.35 * (pores > 0.86), 0, 1)


def board(folder, name, colours, seed, size=(512, 1024)):
    save(folder, name, scale(grain(*size, seed), colours), 86)


def floor(folder, planks=18, size=1536):
    """2.4 m of floor each way: planks run down the picture, and the picture repeats."""
    wood = [grain(512, size, 40 + k).T for k in range(3)]
    random = np.random.default_rng(7)
    edges = np.round(np.arange(planks + 1) * size / planks).astype(int)
    tone = np.zeros((size, size))
    heights = np.full((size, size), 200.0)
    gloss = np.zeros((size, size))
    warm = np.zeros((size, size))
    start = 0
    for k in range(planks):
        left, right = edges[k], edges[k + 1]
        start = (start + int(size * random.uniform(0.27, 0.45))) % size
        length = int(size * random.uniform(0.42, 0.58))
        for first, count in ((start, length), (start + length, size - length)):
            rows = np.arange(first, first + count) % size
            source = wood[random.integers(3)]
            column = random.integers(0, 512 - (right - left))
            part = np.roll(source, random.integers(size), axis=0)[:count, column : column + right - left]
            part = part[:, ::-1] if random.random() < 0.5 else part
            tone[rows, left:right] = np.clip(0.5 + (part - 0.5) * 0.95 + random.normal(0, 0.11), 0, 1)
            warm[rows, left:right] = random.normal(0, 0.04)
            gloss[rows, left:right] = random.normal(0, 0.05) + (part - 0.5) * 0.18
            heights[rows, left:right] += (part - 0.5) * 26 + random.normal(0, 4)
            for edge in (0, 1, count - 2, count - 1):
                heights[rows[edge], left:right] = 70
                tone[rows[edge], left:right] *= 0.35
        for edge, depth in ((left, 40), (left + 1, 110), (right - 1, 40), (right - 2, 110)):
            heights[:, edge] = np.minimum(heights[:, edge], depth)
            tone[:, edge] *= 0.3 if depth == 40 else 0.75
    colour = scale(tone, OAK) * (1 + warm[..., None] * np.array([1, 0.1, -1.2]))
    worn = cloud(size, size, 4, 4, 90, 5)
    gloss = 0.72 + gloss + 0.5 * (worn - 0.5)
    save(folder, "floor.jpg", colour, 84)
    save(folder, "floor_gloss.jpg", (gloss * 255)[::2, ::2], 80)
    save(folder, "floor_rough.jpg", ((1.28 - gloss) * 255)[::2, ::2], 80)
    save(folder, "floor_bump.jpg", heights, 78)


def paint(folder):
    floor(folder)
    board(folder, "walnut.jpg", WALNUT, 11)
    board(folder, "beech.jpg", BEECH, 21)
