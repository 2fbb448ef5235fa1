"""Books by their covers' sizes: two boards and a spine round a block of pages."""

import numpy as np

from build import finish, turn
from paint_covers import BOOKS
from shapes import Shape, box


def book(index):
    """Upright, its spine to +z and in the middle of the front below it (0, 0, 0); its front cover is at +x."""
    _, _, width, height, thick, *_ = BOOKS[index]
    w, h, t = width / 1000, height / 1000, thick / 1000
    board, edge = 0.0026, 0.003
    total = 2 * w + t

    def uv(p, n):
        side = int(np.argmax(np.abs(n)))
        v = p[:, 1] / h
        if side == 0:
            u = (w + t - p[:, 2]) if n[0] > 0 else (w + p[:, 2])
        elif side == 2:
            u = w + t / 2 + p[:, 0]
        else:
            u, v = np.full(len(p), w * 0.5), np.full(len(p), 0.97)
        return np.stack([u / total, v], axis=1)

    material = "book_%02d" % (index + 1)
    bulge = t * 0.12
    xs = np.linspace(-t / 2, t / 2, 7)
    outer = [(x, -bulge * (2 * x / t) ** 2) for x in xs]
    profile = outer + [(t / 2, -w), (t / 2 - board, -w)] + [(x * (1 - 2 * board / t), z - board) for x, z in outer[::-1]] + [(-t / 2 + board, -w), (-t / 2, -w)]
    n = len(profile)
    points = [(x, 0, z) for x, z in profile] + [(x, h, z) for x, z in profile]
    sides = [(k, n + k, n + (k + 1) % n, (k + 1) % n) for k in range(n)]
    m = len(outer)
    caps = []
    for k in range(m - 1):
        a, b, c, d = k, k + 1, 2 * m - k, 2 * m + 1 - k
        caps.append((a, b, c, d))
    caps.append((m - 1, m, m + 1, m + 2))
    caps.append((0, 2 * m + 1, 2 * m + 2, 2 * m + 3))
    faces = [f for f in sides] + caps + [tuple(n + i for i in f)[::-1] for f in caps]
    cover = finish(material, Shape(points, faces).flipped(), smooth=30, uv=uv)
    pages = box((-t / 2 + board * 0.9, edge, -w + edge), (t / 2 - board * 0.9, h - edge, -bulge - board * 1.4))
    return [cover, finish("paper", pages, smooth=None)]


def size(index):
    _, _, width, height, thick, *_ = BOOKS[index]
    return width / 1000, height / 1000, thick / 1000


class Books:
    """Each made once, put wherever it is asked for."""

    def __init__(self, scene):
        self.scene, self.made, self.count = scene, {}, 0

    def put(self, index, matrix):
        if index not in self.made:
            self.made[index] = book(index)
        self.count += 1
        self.scene.put("book_%02d_%d" % (index + 1, self.count), self.made[index], matrix)

    def row(self, indices, x, y, z, seed=0, lean=0.0, at=np.eye(4)):
        """Standing side by side from x on to the right, their spines near z; the last leans to the left by `lean` degrees."""
        random = np.random.default_rng(seed)
        for k, index in enumerate(indices):
            w, h, t = size(index)
            depth = z + random.uniform(-0.012, 0.004)
            if lean and k == len(indices) - 1:
                a = np.radians(lean)
                x += h * np.sin(a) + t / 2 * np.cos(a) + 0.001
                self.put(index, at @ turn(z=lean, at=(x, y + t / 2 * np.sin(a), depth)))
                x += t * np.cos(a) / 2 + 0.004
            else:
                self.put(index, at @ turn(y=random.uniform(-1, 1), at=(x + t / 2, y, depth)))
                x += t + 0.0025
        return x

    def pile(self, indices, x, y, z, seed=0, at=np.eye(4), facing=0):
        """Lying one on the other, their spines towards +z, front covers up."""
        random = np.random.default_rng(seed)
        for index in indices:
            w, h, t = size(index)
            angle = facing + random.uniform(-9, 9)
            lay = turn(z=90, at=(h / 2, t / 2, w / 2))
            self.put(index, at @ turn(y=angle, at=(x, y, z)) @ lay)
            y += t + 0.0008
        return y
