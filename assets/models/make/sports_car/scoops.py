"""Vanes in the outlets of the bonnet: two blades across each, that fall towards the rear as the air leaves."""

import numpy as np

from mesh import joined
from panels import OUTLET_AHEAD, OUTLET_BEHIND
from shapes import oriented, sweep
from shell import pair
from surface import on_top

# Where between the front and the rear edge the vanes stand, and how far below the bonnet.
PLACES, SUNK = (.30, .66), .012
SECTION = [(-.012, -.0022), (.012, -.0022), (.014, 0), (.012, .0022), (-.012, .0022)]


def vane(skin, share):
    ahead, behind = np.array(OUTLET_AHEAD), np.array(OUTLET_BEHIND)[::-1]
    line = ahead + (behind - ahead) * share
    even = np.linspace(0, 1, 10)
    way = np.linspace(0, 1, len(line))
    path = np.array([on_top(skin, np.interp(t, way, line[:, 0]), np.interp(t, way, line[:, 1]), -SUNK) for t in even])
    return oriented(sweep("bonnet_vanes", "gloss_black", path, SECTION, 40))


def all_parts(skin):
    return pair(joined("bonnet_vanes", [vane(skin, share) for share in PLACES]))
