"""A Wavefront OBJ writer: objects of polygons that share positions, texture coordinates and normals. Python 3 standard library only."""

from vector import add, cross, dot, sub

# Area below which a polygon is none, in squared units of the model.
NOTHING = 1e-12


def number(value, form):
    """A number without the zeros that say nothing."""
    text = form % value
    if "." in text and "e" not in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def printed(vector, form):
    return " ".join(number(c, form) for c in vector)


class Obj:
    """Collects objects; what prints alike is written once. `position`, `uv` and `normal` are formats of numbers: six significant
    digits, where nothing else is said. A polygon without normals, or whose normals are nearly its own, gets its own to five digits: where some
    have normals, programs smooth those that have none. Not so with `smooth=False`, where none has any."""

    def __init__(self, comment, library, position="%.6g", uv="%.6g", normal="%.6g", smooth=True):
        self.lines = ["# " + line for line in comment] + ["mtllib " + library]
        self.smooth = smooth
        self.forms = {"v": position, "vt": uv, "vn": normal}
        self.known = {kind: {} for kind in self.forms}
        self.triangles = 0

    def object(self, name, material):
        """Begins an object; the faces that follow have `material`."""
        self.lines.append("o " + name)
        self.written = set()
        self.material(material)

    def material(self, name):
        """The faces that follow have another material."""
        self.lines.append("usemtl " + name)

    def face(self, positions, normals=None, uvs=None, normal=None, place=None):
        """One polygon, counter-clockwise seen from its front. Corners that print alike are merged, and what is then no
        polygon, or is there already, is left out. One of more than four corners is cut where a fan would not cover it.
        `normal` and `place` are the formats of these normals and positions."""
        form, corners = normal or self.forms["vn"], {}
        if self.smooth and (normals is None or is_flat(positions, normals, form)):
            normals, form = own_normals(positions), "%.5g"
        for k, position in enumerate(positions):
            v = self._index("v", position, place or self.forms["v"])
            vt = self._index("vt", uvs[k], self.forms["vt"]) if uvs is not None else ""
            vn = self._index("vn", normals[k], form) if normals is not None else ""
            corners.setdefault(v, (k, "/".join(str(i) for i in (v, vt, vn)).rstrip("/")))
        points = [positions[k] for k, _ in corners.values()]
        if len(points) < 3 or area(points) < NOTHING:
            return
        names = [name for _, name in corners.values()]
        for fan in fans(points):
            row = [names[c] for c in fan]
            if frozenset(row) not in self.written:
                self.written.add(frozenset(row))
                self.triangles += len(row) - 2
                self.lines.append("f " + " ".join(row))

    def grid(self, points, normals):
        """Quads between neighbouring rows and columns; triangles where a row has shrunk to a point."""
        for i in range(len(points) - 1):
            for j in range(len(points[i]) - 1):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                self.face([points[a][b] for a, b in corners], [normals[a][b] for a, b in corners])

    def write(self, path):
        path.write_text("\n".join(self.lines) + "\n", encoding="ascii", newline="\n")
        print("%s: %d triangles, %.2f MB" % (path.name, self.triangles, path.stat().st_size / 1e6))

    def _index(self, kind, vector, form):
        text = printed(vector, form)
        table = self.known[kind]
        if text not in table:
            table[text] = len(table) + 1
            self.lines.append(kind + " " + text)
        return table[text]


def normal_of(points):
    """A polygon's normal, twice as long as its area."""
    out = (0.0, 0.0, 0.0)
    for a, b in zip(points[1:-1], points[2:]):
        out = add(out, cross(sub(a, points[0]), sub(b, points[0])))
    return out


def own_normals(points):
    """A polygon's unit normal at each of its corners."""
    n = normal_of(points)
    size = dot(n, n) ** 0.5 or 1.0
    return [tuple(round(c / size, 9) for c in n)] * len(points)


def is_flat(points, normals, form):
    """Whether all normals print alike, and are the polygon's own by half a degree."""
    own = normal_of(points)
    return len({printed(n, form) for n in normals}) == 1 and dot(own, normals[0]) > 0.99996 * dot(own, own) ** 0.5


def area(points):
    n = normal_of(points)
    return dot(n, n) ** 0.5 / 2


def fans(points):
    """Corners of a polygon as one polygon, begun where a fan of triangles covers it, or as triangles where none does."""
    n = len(points)
    if n < 5:
        return [range(n)]
    normal = normal_of(points)
    drop = max(range(3), key=lambda k: abs(normal[k]))
    u, v = [(drop + 1) % 3, (drop + 2) % 3] if normal[drop] > 0 else [(drop + 2) % 3, (drop + 1) % 3]
    p = [(q[u], q[v]) for q in points]

    def size(a, b, c):
        (x, y), (s, t), (q, r) = p[a], p[b], p[c]
        return (s - x) * (r - y) - (t - y) * (q - x)

    for start in range(n if n < 12 else 1):
        if all(size(start, (start + k) % n, (start + k + 1) % n) > 2e-8 for k in range(1, n - 1)):
            return [[(k + start) % n for k in range(n)]]
    left, out = list(range(n)), []
    while len(left) > 3:
        ears = []
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            if size(a, b, c) > 1e-10 and not any(min(size(a, b, q), size(b, c, q), size(c, a, q)) > -1e-10 for q in left if q not in (a, b, c)):
                long = sum((p[j][0] - p[k][0]) ** 2 + (p[j][1] - p[k][1]) ** 2 for j, k in ((a, b), (b, c), (c, a)))
                ears.append((size(a, b, c) / long, -i))
        i = -max(ears)[1] if ears else 0
        out.append([left[i - 1], left[i], left[(i + 1) % len(left)]])
        del left[i]
    return out + [left]
