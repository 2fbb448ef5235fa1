"""The tail: one slim band of lights behind a red lens, the name below it, and reflectors in the bumper's corners."""

import numpy as np

from letters import text
from mesh import joined, unit
from panels import LAMP_DEPTH, LIP
from shapes import oriented, sweep
from shell import both, pair
from surface import on_face

# Which way the band's walls go.
INTO = (0, 0, 1)
# The lights: how deep they lie behind the lens, their height, how far they reach to the side, half of one's height, and how thick it is.
BEHIND, LEVEL, REACH, TALL, THICK = .026, .747, .758, .013, .005
# How many there are, and what part of the way to the next one is lit.
LIGHTS, LIT = 44, .72
# The height of the name.
NAME = .654
# A reflector: its height, from where to where it goes, half as high, and how far it stands out.
REFLECTOR, REFLECTOR_RUN, REFLECTOR_SIZE = .462, (.585, .700), (.0085, .004)


def lights(whole):
    """A row of small flat lights, as the tail runs."""
    xs = np.linspace(-REACH, REACH, 2 * LIGHTS + 1)
    path = np.array([on_face(whole, x, LEVEL - .008 * (x / REACH) ** 2, 0, -1)[0] + (0, 0, BEHIND) for x in xs])
    path[1:-1] = (path[:-2] + 2 * path[1:-1] + path[2:]) / 4
    section = [(-THICK, -TALL), (THICK, -TALL), (THICK, TALL), (-THICK, TALL)]
    row = []
    for a, b, c in zip(path[:-2:2], path[1:-1:2], path[2::2]):
        row.append(oriented(sweep("tail_strip", "tail_light", b + np.stack([(a - c), 0 * a, (c - a)]) * LIT / 2, section, 30)))
    return joined("tail_strip", row)


def lamp(skin, whole):
    lens = skin.part("tail_lens", "tail_lens", {"tail_lamp"}, offset=-.001, fold=.010, lip=LIP)
    walls = skin.part("tail_lamp_walls", "gloss_black", {"tail_lamp"}, offset=-.012, fold=LAMP_DEPTH, lip=LIP, walls=True, into=INTO)
    back = skin.part("tail_lamp_back", "gloss_black", {"tail_lamp"}, shift=lambda p, n: p + np.array(INTO) * LAMP_DEPTH)
    return [both(lens), both(walls), both(back), lights(whole)]


def name(whole):
    """Letters of chrome below the band, which stand on the tail as it runs across, and lean as it does in the middle."""
    across = np.linspace(-.32, .32, 33)
    line = np.array([on_face(whole, x, NAME, 0, -1)[0] for x in across])
    up = unit(on_face(whole, 0, NAME + .03, 0, -1)[0] - on_face(whole, 0, NAME - .03, 0, -1)[0])
    normal = np.array((0, up[2], -up[1]))
    place = lambda right, high, out: np.array((-right, NAME, np.interp(-right, across, line[:, 2]))) + high * up + out * normal
    return text("name", "badge", "LUCERNA", .050, .006, place, .16, .44)


def reflectors(whole):
    """A slim red bar on the bumper at each corner of the tail."""
    path = np.array([on_face(whole, x, REFLECTOR, 0, -1)[0] for x in np.linspace(*REFLECTOR_RUN, 13)])
    u, v = REFLECTOR_SIZE
    section = [(-v, -u), (v * .4, -u), (v, -u * .6), (v, u * .6), (v * .4, u), (-v, u)]
    width = np.interp(np.arange(13), (0, 1, 11, 12), (.45, 1, 1, .45))
    sections = np.array(section)[None] * np.stack([np.ones(13), width], 1)[:, None]
    bezel = sections * (.4, 1) + np.sign(sections) * (.0015, .004)
    longer = path + (path - path.mean(0)) * .06
    return pair(oriented(sweep("reflector", "tail_reflector", path, sections, 30))) + pair(oriented(sweep("reflector_bezel", "gloss_black", longer, bezel, 30)))


def all_parts(skin, whole):
    return lamp(skin, whole) + [name(whole)] + reflectors(whole)
