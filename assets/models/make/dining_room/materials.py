"""The materials of the room, as the MTL file has them."""

import mtl
from paint_covers import BOOKS

HEAD = [
    "The dining room. Textured materials have Kd 0.5, and some glossy ones reflect more than they receive (Kd + Ks above 1):",
    "dining-room-original.ron takes them as they are, dining-room.ron tunes them.",
]

# Name, Kd, Ks, and further statements.
PLAIN = [
    ("plaster", (0.44, 0.53, 0.46), 0, "Ns 1"),
    ("panelling", (0.78, 0.76, 0.71), 0, "Ns 1"),
    ("woodwork", (0.78, 0.76, 0.71), 0.08, "Ns 60"),
    ("door_paint", (0.1, 0.17, 0.18), 0.2, "Ns 60"),
    ("ceiling", (0.82, 0.81, 0.78), 0, "Ns 1"),
    ("linen", (0.76, 0.71, 0.62), 0, "Ns 1"),
    ("brass", (0.36, 0.25, 0.1), (0.6, 0.44, 0.2), "Ns 120", "Pr 0.28", "Pm 1"),
    ("silver", (0.5, 0.5, 0.48), (0.5, 0.5, 0.48), "Ns 400", "Pr 0.16", "Pm 1"),
    ("iron", (0.03, 0.03, 0.032), 0.1, "Ns 60"),
    ("gilt", (0.42, 0.29, 0.11), (0.4, 0.3, 0.14), "Ns 60", "Pr 0.42", "Pm 1"),
    ("glaze_blue", (0.1, 0.19, 0.27), 0.5, "Ns 300", "Pc 1", "Pcr 0.08"),
    ("glaze_white", (0.74, 0.71, 0.64), 0.4, "Ns 200", "Pc 1", "Pcr 0.12"),
    ("terracotta", (0.55, 0.26, 0.15), 0.03, "Ns 10"),
    ("enamel", (0.035, 0.12, 0.095), 0.5, "Ns 400", "Pc 1", "Pcr 0.05"),
    ("enamel_white", (0.85, 0.83, 0.78), 0.05, "Ns 40"),
    ("curtain_cord", (0.5, 0.33, 0.12), 0.04, "Ns 20"),
    ("wax", (0.82, 0.77, 0.65), 0.06, "Ns 30"),
    ("stalk", (0.16, 0.1, 0.05), 0, "Ns 1"),
    ("grape", (0.14, 0.03, 0.09), 0.3, "Ns 60"),
    ("paper", (0.8, 0.74, 0.62), 0, "Ns 1"),
    ("mat", (0.85, 0.83, 0.78), 0, "Ns 1"),
    ("soil", (0.06, 0.042, 0.03), 0, "Ns 1"),
    ("stem", (0.2, 0.3, 0.1), 0.04, "Ns 20"),
    ("bark", (0.24, 0.17, 0.11), 0, "Ns 1"),
    ("lawn", (0.11, 0.18, 0.05), 0, "Ns 1"),
]

# Name, picture of Kd, Ks, and further statements.
TEXTURED = [
    ("floor", "floor.jpg", 0.6, "Ns 200", "map_Ks floor_gloss.jpg", "map_Ns floor_gloss.jpg", "map_Bump -bm 0.06 floor_bump.jpg"),
    ("walnut", "walnut.jpg", 0.55, "Ns 120"),
    ("oak", "beech.jpg", 0.08, "Ns 30"),
    ("beech", "beech.jpg", 0.3, "Ns 80"),
    ("rug", "rug.jpg", 0, "Ns 1", "map_Bump -s 62 42 -bm 3 rug_bump.jpg"),
    ("cushion", "cushion.jpg", 0, "Ns 1"),
    ("curtain", "curtain.jpg", 0, "Ns 1"),
    ("runner", "runner.jpg", 0, "Ns 1"),
    ("basket", "basket.jpg", 0.05, "Ns 15", "map_Bump -bm 2 basket_bump.jpg"),
    ("plate", "plate.png", 0.6, "Ns 500", "Pc 1", "Pcr 0.06"),
    ("apple", "apple.jpg", 0.25, "Ns 90"),
    ("orange", "orange.jpg", 0.15, "Ns 40", "map_Bump -bm 0.4 orange_bump.jpg"),
    ("pear", "pear.jpg", 0.1, "Ns 40"),
    ("landscape", "landscape.jpg", 0.06, "Ns 30"),
    ("botanical", "botanical.jpg", 0, "Ns 1"),
    ("monstera", "monstera.jpg", 0.12, "Ns 40", "map_d monstera_mask.png"),
    ("ficus", "ficus.jpg", 0.1, "Ns 40", "map_d ficus_mask.png"),
    ("fern", "fern.jpg", 0.03, "Ns 20", "map_d fern_mask.png"),
    ("hedge", "hedge.jpg", 0, "Ns 1"),
    ("eucalyptus", "eucalyptus.jpg", 0.05, "Ns 20", "map_d eucalyptus_mask.png"),
]

# Name, Ke, and further statements.
LIGHTS = [
    ("pendant_light", (7.4, 4.8, 2.5)),
    ("shade_light", (0.34, 0.21, 0.1), "map_Ke shade.jpg"),
    ("shade_bulb", (34, 23, 12.5)),
    ("flame", (0.4, 0.2, 0.05)),
    ("globe_light", (4, 2.9, 1.75)),
    ("window_light", (2.9, 3.4, 4.0)),
]

GLASS = ("glass", 0, 0, "Ns 1000", "Ni 1.5", "Tf 0.985 0.99 0.985", "illum 7")


def textured():
    """The materials that have pictures."""
    return {row[0] for row in rows() if any(line.startswith("map_") for line in row[3:])}


def rows():
    books = [("book_%02d" % (k + 1), "book_%02d.jpg" % (k + 1), 0.12, "Ns 40") for k in range(len(BOOKS))]
    out = PLAIN + [(name, 0.5, ks, ns, "map_Kd " + picture, *more) for name, picture, ks, ns, *more in TEXTURED + books]
    return out + [(name, 0, 0, "Ns 1", "Ke " + mtl.colour(ke), *more) for name, ke, *more in LIGHTS] + [GLASS]


def write(path, folder):
    mtl.write(path, HEAD, folder, rows())
