"""A small Wavefront OBJ writer: groups of polygons with shared positions and normals. Python 3 standard library only."""


def number(value):
    """Six significant digits, without a negative zero."""
    text = "%.6g" % value
    return "0" if text == "-0" else text


class Obj:
    """Collects objects; positions and normals that print alike are written once."""

    def __init__(self, comment, library):
        self.lines = ["# " + line for line in comment] + ["mtllib " + library]
        self.known = {"v": {}, "vn": {}}
        self.triangles = 0

    def object(self, name, material):
        """Begins an object; the faces that follow have `material`."""
        self.lines += ["o " + name, "usemtl " + material]

    def _index(self, kind, vector):
        text = " ".join(number(c) for c in vector)
        table = self.known[kind]
        if text not in table:
            table[text] = len(table) + 1
            self.lines.append(kind + " " + text)
        return table[text]

    def face(self, positions, normals=None):
        """One polygon, counter-clockwise seen from its front. Corners that print alike are merged, and what is then no
        polygon is left out."""
        corners = []
        for k, position in enumerate(positions):
            v = self._index("v", position)
            vn = self._index("vn", normals[k]) if normals else None
            if all(v != other[0] for other in corners):
                corners.append((v, vn))
        if len(corners) < 3:
            return
        self.triangles += len(corners) - 2
        self.lines.append("f " + " ".join(str(v) if vn is None else "%d//%d" % (v, vn) for v, vn in corners))

    def grid(self, points, normals):
        """Quads between neighbouring rows and columns; triangles where a row has shrunk to a point."""
        for i in range(len(points) - 1):
            for j in range(len(points[i]) - 1):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                self.face([points[a][b] for a, b in corners], [normals[a][b] for a, b in corners])

    def write(self, path):
        with open(path, "w", encoding="ascii", newline="\n") as out:
            out.write("\n".join(self.lines) + "\n")
        print("%s: %d triangles" % (path.name, self.triangles))
