"""The wipers: two thin dark arms that leave the cowl and lie along the foot of the windscreen, each with a blade on the glass."""

import numpy as np

from fields import curve
from mesh import joined
from shapes import disk, oriented, sweep
from surface import on_top

# Of each wiper, seen from above as x and z: where its arm begins, and its blade's course.
WIPERS = (((.330, 1.105), ((.300, 1.046), (.130, 1.072), (-.060, 1.072), (-.220, 1.060))),
          ((-.130, 1.138), ((-.140, 1.068), (-.260, 1.050), (-.370, 1.014), (-.455, .952))))
# How high arm and blade lie above the glass, and how thick they are.
ARM, BLADE, ARM_SIZE, BLADE_SIZE = .012, .005, .0055, .0045


def line(whole, points, low, high, size, name):
    """A rod through points of the surface, which rises from `low` to `high`."""
    way = curve(points, 6)
    lifts = np.interp(np.arange(len(way)), (0, 3, len(way) - 1), (low, high, high))
    return oriented(sweep(name, "gloss_black", np.array([on_top(whole, x, z, lift) for (x, z), lift in zip(way, lifts)]), disk(size, 8), 60))


def all_parts(whole):
    rods = []
    for foot, blade in WIPERS:
        middle = tuple(np.mean(blade[1:3], 0))
        rods += [line(whole, (foot, tuple(np.mean([foot, middle], 0)), middle), 0, ARM, ARM_SIZE, "wipers"), line(whole, blade, BLADE, BLADE, BLADE_SIZE, "wipers")]
    return [joined("wipers", rods)]
