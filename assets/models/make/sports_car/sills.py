"""The blade along the foot of each sill: it leaves the front arch flush, stands out under the door, and curls up before the rear wheel."""

from sculpt import step
from shapes import soft_loft
from shell import pair

# Across the blade, from its root under the body to its lip and back below: how far from the root (0 to 1), and how high.
SECTION = ((0, .020), (.45, .022), (.78, .019), (.94, .013), (1, .006), (.96, .000), (.78, -.004), (.40, -.003), (0, .000))
# Where the root stands, and the height of the blade's foot.
ROOT, FOOT = .845, .098


def lip(z):
    """How far out the blade reaches, and how high its outer edge is lifted."""
    out = .030 * step((1.03 - z) / .24) * step((z + 1.02) / .12)
    up = .088 * step((-.60 - z) / .40) ** 1.3 + .020 * step((z - .86) / .16)
    return .940 + out, up


def blade():
    rings = []
    for z in (1.02, 1.00, .95, .89, .82, .70, .40, 0, -.35, -.55, -.66, -.74, -.81, -.87, -.92, -.955, -.965):
        edge, up = lip(z)
        thin = .6 if z in (1.02, -.965) else 1
        rings.append([(ROOT + (edge - ROOT) * t, FOOT + up * t ** 3 + (v - .008) * thin + .008, z) for t, v in SECTION])
    return soft_loft("sill_blade", "trim_black", rings, 1)


def all_parts():
    return pair(blade())
