"""Catmull-Clark subdivision with semi-sharp creases, which remembers which face each face came from."""

import numpy as np


def step(points, faces, creases):
    """One level. `creases`: (low, high) vertex pair -> sharpness. Child k of a face is its corner k."""
    n = len(points)
    centres = np.array([points[f].mean(0) for f in faces])
    edges, sides = {}, []
    for k, f in enumerate(faces):
        for a, b in zip(f, f[1:] + f[:1]):
            key = (a, b) if a < b else (b, a)
            if key not in edges:
                edges[key] = len(edges)
                sides.append([])
            sides[edges[key]].append(k)
    keys = np.array(list(edges))
    middle = (points[keys[:, 0]] + points[keys[:, 1]]) / 2
    sharp = np.array([creases.get(tuple(key), 0.0) for key in keys])
    open_edge = np.array([len(s) == 1 for s in sides])
    sharp[open_edge] = 9.0
    face_mean = np.array([centres[s].mean(0) for s in sides])
    weight = np.clip(sharp, 0, 1)[:, None]
    new_edges = (middle + face_mean) / 2 * (1 - weight) + middle * weight

    q, r, valence = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n)
    count = np.zeros(n)
    for k, f in enumerate(faces):
        for v in f:
            q[v] += centres[k]
            count[v] += 1
    lines, amount = [[] for _ in range(n)], np.zeros(n)
    for e, (a, b) in enumerate(keys):
        for v, other in ((a, b), (b, a)):
            r[v] += middle[e]
            valence[v] += 1
            if sharp[e] > 0:
                lines[v].append((sharp[e], other))
    q /= np.maximum(count, 1)[:, None]
    r /= np.maximum(valence, 1)[:, None]
    m = np.maximum(valence, 1)[:, None]
    new_points = (q + 2 * r + (m - 3) * points) / m
    for v in range(n):
        if len(lines[v]) == 2:
            (s, a), (t, b) = lines[v]
            w = min(1.0, (s + t) / 2)
            new_points[v] = new_points[v] * (1 - w) + w * (points[a] + 6 * points[v] + points[b]) / 8
        elif len(lines[v]) > 2:
            w = min(1.0, sum(s for s, _ in lines[v]) / len(lines[v]))
            new_points[v] = new_points[v] * (1 - w) + w * points[v]

    out = np.concatenate([new_points, new_edges, centres])
    children, parents = [], []
    at = lambda a, b: n + edges[(a, b) if a < b else (b, a)]
    for k, f in enumerate(faces):
        for c, v in enumerate(f):
            children.append([v, at(v, f[(c + 1) % len(f)]), n + len(edges) + k, at(f[c - 1], v)])
            parents.append(k)
    finer = {}
    for (a, b), s in creases.items():
        if s > 1:
            for v in (a, b):
                finer[(v, at(a, b))] = s - 1
    return out, children, finer, parents


def subdivide(points, faces, creases=None, levels=2):
    """Points, faces, and of each face the faces of every level that it came from, the cage's first."""
    points = np.asarray(points, float)
    faces = [list(f) for f in faces]
    creases = {(min(k), max(k)): s for k, s in (creases or {}).items()}
    history = [list(range(len(faces)))]
    for _ in range(levels):
        points, faces, creases, parents = step(points, faces, creases)
        history = [[row[p] for p in parents] for row in history] + [list(range(len(faces)))]
    return points, faces, history
