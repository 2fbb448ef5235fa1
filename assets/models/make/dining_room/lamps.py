"""The three lights of the room: a pendant over the table, a lamp on the sideboard, a globe on the wall."""

import numpy as np

from build import finish, turn
from room import BACK, HEIGHT
from shapes import curve, lathe, tube
from sideboard import TOP

PENDANT = (0.02, 1.5, 0.0)


def ball(radius, rows=12):
    return lathe([(radius * np.sin(a) if 0 < k < rows else 0, -radius * np.cos(a)) for k, a in enumerate(np.linspace(0, np.pi, rows + 1))])


def pendant(scene):
    """A shade of enamel, green without and white within, closed at its rim by a bowl of opal glass that shines."""
    x, y, z = PENDANT
    outside = [(0.205, 0.0), (0.203, 0.02), (0.19, 0.06), (0.16, 0.105), (0.115, 0.145), (0.07, 0.17), (0.045, 0.182), (0.034, 0.2), (0.03, 0.235)]
    inside = [(0.029, 0.233), (0.033, 0.198), (0.044, 0.178), (0.068, 0.166), (0.112, 0.141), (0.156, 0.102), (0.186, 0.058), (0.199, 0.02), (0.201, 0.0)]
    at = turn(at=PENDANT)
    scene.put("pendant", finish("enamel", lathe(outside), smooth=50), at)
    scene.put("pendant", finish("enamel_white", lathe(inside), smooth=50), at)
    rim = [(0.203 + 0.0032 * np.cos(a), 0.0032 * np.sin(a)) for a in np.linspace(-np.pi, np.pi, 7)]
    scene.put("pendant", finish("brass", lathe(rim), smooth=80), at)
    cap = [(0.0, 0.225), (0.032, 0.225), (0.034, 0.235), (0.03, 0.255), (0.012, 0.27), (0.008, 0.3), (0, 0.3)]
    scene.put("pendant", finish("brass", lathe(cap), smooth=50), at)
    scene.put("pendant", finish("iron", tube([(x, y + 0.29, z), (x, HEIGHT - 0.01, z)], 0.0035, 8, (0, 0, 1)), smooth=60))
    rose = [(0, -0.03), (0.02, -0.028), (0.05, -0.016), (0.055, 0.0), (0.0, 0.001)]
    scene.put("pendant", finish("brass", lathe(rose), smooth=50), turn(at=(x, HEIGHT, z)))
    bowl = [(0.1985 * np.sin(a), 0.008 - 0.03 * np.cos(a)) for a in np.linspace(0, np.pi / 2, 7)]
    scene.put("pendant_bowl", finish("pendant_light", lathe([(0.0, bowl[0][1])] + bowl[1:]), smooth=80), at)


def table_lamp(scene):
    at = turn(at=(-1.33, TOP + 0.0012, BACK + 0.25))
    base = [
        (0, 0), (0.06, 0), (0.062, 0.008), (0.05, 0.016), (0.045, 0.03), (0.075, 0.07), (0.088, 0.115), (0.078, 0.165), (0.045, 0.205), (0.024, 0.225),
        (0.022, 0.235), (0, 0.236),
    ]
    scene.put("table_lamp", finish("glaze_blue", lathe(base), smooth=60), at)
    scene.put("table_lamp", finish("brass", lathe([(0, 0.23), (0.014, 0.23), (0.012, 0.25), (0.006, 0.255), (0.006, 0.36), (0, 0.36)]), smooth=50), at)
    shade = lathe([(0.165, 0.275), (0.115, 0.505)])
    scene.put("table_lamp_shade", finish("shade_light", shade, smooth=60), at)
    scene.put("table_lamp_bulb", finish("shade_bulb", ball(0.03, 8).moved(0, 0.39, 0), smooth=80), at)
    for radius, y in ((0.165, 0.275), (0.115, 0.505)):
        loop = [(radius * np.cos(t), y, radius * np.sin(t)) for t in np.linspace(0, 2 * np.pi, 37)]
        scene.put("table_lamp", finish("linen", tube(loop, 0.0035, 6), smooth=80), at)
    for k in range(3):
        a = 2 * np.pi * k / 3
        scene.put("table_lamp", finish("brass", tube([(0, 0.352, 0), (0.13 * np.cos(a), 0.43, 0.13 * np.sin(a))], 0.002, 6), smooth=60), at)


def wall_lamp(scene):
    at = turn(at=(0.56, 1.84, BACK))
    plate = lathe([(0.042, -0.004), (0.042, 0.006), (0.036, 0.013), (0.014, 0.017), (0, 0.018)])
    plate = plate.mapped(lambda p: np.stack([p[:, 0], -p[:, 2], p[:, 1]], axis=1))
    scene.put("wall_lamp", finish("brass", plate, smooth=45), at)
    arm = curve([(0, 0, 0.01), (0, -0.03, 0.07), (0, -0.02, 0.14), (0, 0.03, 0.15)], 5)
    scene.put("wall_lamp", finish("brass", tube(arm, 0.006, 8, (1, 0, 0)), smooth=60), at)
    cup = lathe([(0, 0.02), (0.012, 0.022), (0.03, 0.034), (0.033, 0.048), (0.03, 0.05), (0, 0.05)]).moved(0, 0, 0.15)
    scene.put("wall_lamp", finish("brass", cup, smooth=50), at)
    scene.put("wall_globe", finish("globe_light", ball(0.075).moved(0, 0.112, 0.15), smooth=80), at)


def build(scene):
    pendant(scene)
    table_lamp(scene)
    wall_lamp(scene)
