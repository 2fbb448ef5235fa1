"""The Wavefront MTL writer of models: a row a material. Python 3 standard library only."""


def colour(value):
    """Three numbers, or one for all."""
    values = value if isinstance(value, tuple) else (value,) * 3
    return " ".join("%g" % v for v in values)


def statement(folder, name, kd, ks, *more):
    """A material: its colours, further statements, and the model of illumination that these colours mean, if none is said. Files
    of maps, named last on their line, lie in `folder`."""
    lines = ["newmtl " + name, "Kd " + colour(kd), "Ks " + colour(ks)]
    if not any(line.startswith("illum") for line in more):
        lines.append("illum %d" % (2 if ks else 1))
    for line in more:
        if line.startswith("map_"):
            *words, file = line.split()
            line = " ".join([*words, folder + "/" + file])
        lines.append(line)
    return "\n".join(lines) + "\n"


def write(path, comment, folder, rows):
    out = ["".join("# %s\n" % line for line in comment)] + [statement(folder, *row) for row in rows]
    path.write_text("\n".join(out), encoding="ascii", newline="\n")
