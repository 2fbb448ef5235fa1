"""Plants of bent cards, each with one leaf cut out of it: a monstera, a fig, a fern and a vase of eucalyptus."""

import numpy as np

from build import finish, turn
from noise import at_height
from room import BACK
from shapes import curve, lathe, sheet, tube
from shelf import HEIGHT as CASE, POT, vase
from sideboard import TOP as BOARD


def card(material, length, width, across=4, along=7, fold=0.25, droop=0.5, wave=0.0):
    """A leaf from its stalk at (0, 0, 0) along +z, its face up: folded along its rib, its tip sinking."""

    def place(u, v):
        side = (u - 0.5) * width
        bend = droop * v
        z = length * np.sin(bend) / droop if droop > 1e-6 else length * v
        y = -length * (1 - np.cos(bend)) / droop
        y = y + fold * np.abs(side) + wave * width * np.sin(7 * v + 3 * np.sign(u - 0.5)) * np.abs(2 * u - 1)
        return side, y, z

    return finish(material, sheet(across, along, place).flipped(), smooth=80)


def aim(at, heading, pitch, roll=0.0, scale=1.0):
    """From +z to a heading (degrees about y) and a pitch above the level."""
    return turn(y=heading, at=at) @ turn(x=-pitch) @ turn(z=roll, scale=scale)


def monstera(scene, x, z):
    random = np.random.default_rng(23)
    pot = [(0, 0), (0.135, 0), (0.142, 0.006), (0.16, 0.12), (0.178, 0.27), (0.19, 0.28), (0.192, 0.315), (0.186, 0.32), (0.176, 0.315), (0.17, 0.27), (0, 0.268)]
    scene.put("planter", finish("terracotta", lathe(pot), smooth=40), turn(at=(x, 0, z)))
    mound = lathe([(0.171, 0.27), (0.12, 0.283), (0.05, 0.292), (0, 0.294)])
    scene.put("planter", finish("soil", mound.mapped(lambda p: p + np.stack([0 * p[:, 0], 0.012 * at_height(3, p, 0.03), 0 * p[:, 0]], axis=1)), smooth=80), turn(at=(x, 0, z)))
    leaves = [card("monstera", 0.36, 0.3, 4, 7, 0.16, d, 0.035) for d in (0.45, 0.8, 1.15)]
    for k in range(22):
        heading = 137.5 * k + random.uniform(-14, 14)
        s = k / 21
        reach, rise = 0.34 - 0.24 * s + random.uniform(-0.04, 0.04), 0.26 + 0.62 * s + random.uniform(-0.05, 0.05)
        a = np.radians(heading)
        out = np.array([np.sin(a), 0, np.cos(a)])
        foot = np.array([x, 0.28, z]) + out * 0.04
        top = np.array([x, 0.28 + rise, z]) + out * reach
        knee = foot * 0.4 + top * 0.6 + np.array([0, 0.1, 0]) - out * 0.03
        line = curve([foot, knee, top], 4)
        scene.put("monstera", finish("stem", tube(line, np.linspace(0.006, 0.0035, len(line)), 6), smooth=80))
        size = random.uniform(0.78, 1.1) * (1 - 0.2 * s)
        scene.put("monstera", leaves[k % 3], aim(tuple(top), heading + random.uniform(-22, 22), random.uniform(-24, 8) + 30 * s, random.uniform(-16, 16), size))


def fig(scene, x, z):
    """A small tree in a basket: a twisted trunk, branches, leaves round them."""
    random = np.random.default_rng(31)
    basket = [(0, 0), (0.15, 0), (0.16, 0.01), (0.185, 0.14), (0.182, 0.25), (0.17, 0.3), (0.174, 0.315), (0.166, 0.318), (0.16, 0.3), (0.165, 0.25), (0, 0.245)]
    shape = lathe(basket)
    shape.uvs = [[(6 * u, 2.2 * v) for u, v in face] for face in shape.uvs]
    scene.put("basket", finish("basket", shape, smooth=40), turn(at=(x, 0, z)))
    scene.put("basket", finish("soil", lathe([(0.162, 0.255), (0.08, 0.272), (0, 0.275)]), smooth=80), turn(at=(x, 0, z)))
    trunk = curve([(x, 0.25, z), (x + 0.03, 0.55, z + 0.02), (x - 0.015, 0.9, z), (x + 0.02, 1.3, z + 0.01), (x, 1.72, z)], 5)
    scene.put("fig", finish("bark", tube(trunk, np.linspace(0.017, 0.005, len(trunk)), 9), smooth=60))
    leaves = [card("ficus", 0.155, 0.088, 2, 3, 0.3, d) for d in (0.5, 0.9, 1.3)]
    for k in range(19):
        s = 0.42 + 0.56 * k / 18
        foot = trunk[int(s * (len(trunk) - 1))]
        heading = 137.5 * k + random.uniform(-20, 20)
        a = np.radians(heading)
        long = 0.3 * (1.08 - 0.62 * k / 18) * random.uniform(0.8, 1.15)
        out = np.array([np.sin(a), 0.0, np.cos(a)])
        tip = foot + out * long + np.array([0, 0.2 * random.uniform(0.5, 1.1), 0])
        line = curve([foot, foot * 0.5 + tip * 0.5 + np.array([0, 0.05, 0]), tip], 5)
        scene.put("fig", finish("bark", tube(line[::2], np.linspace(0.005, 0.002, 6), 5), smooth=80))
        for j in range(14):
            p = line[min(int((0.25 + 0.75 * j / 13) * (len(line) - 1) + 0.5), len(line) - 1)]
            turned = heading + (75 if j % 2 else -75) * (1 - 0.7 * j / 13) + random.uniform(-30, 30)
            scene.put("fig", leaves[random.integers(3)], aim(tuple(p), turned, random.uniform(-35, 35), random.uniform(-30, 30), random.uniform(0.75, 1.2)))


def fern(scene, x, y, z):
    random = np.random.default_rng(41)
    scene.put("fern_pot", vase(POT, "glaze_white"), turn(at=(x, y, z)))
    scene.put("fern_pot", finish("soil", lathe([(0.07, 0.095), (0, 0.105)]), smooth=80), turn(at=(x, y, z)))
    fronds = [card("fern", 0.36, 0.1, 2, 8, 0.12, d) for d in (1.3, 1.8, 2.3)]
    for k in range(30):
        heading = 137.5 * k + random.uniform(-10, 10)
        at = (x + 0.02 * np.sin(heading), y + 0.1, z + 0.02 * np.cos(heading))
        scene.put("fern", fronds[k % 3], aim(at, heading, 78 - 46 * (k / 29) + random.uniform(-8, 8), random.uniform(-12, 12), random.uniform(0.62, 1.0)))


def eucalyptus(scene, x, y, z):
    """Twigs in a vase, leaves in pairs."""
    random = np.random.default_rng(53)
    leaf = [card("eucalyptus", 0.062, 0.05, 2, 2, 0.2, d) for d in (0.3, 0.8)]
    for k in range(9):
        heading = 40 * k + random.uniform(-12, 12)
        a = np.radians(heading)
        out = np.array([np.sin(a), 0, np.cos(a)])
        foot = np.array([x, y + 0.2, z]) + out * 0.012
        long = random.uniform(0.27, 0.42)
        tip = foot + out * random.uniform(0.1, 0.26) + np.array([0, long, 0])
        line = curve([foot, foot * 0.5 + tip * 0.5 - out * 0.02 + np.array([0, 0.05, 0]), tip], 8)
        scene.put("eucalyptus", finish("stem", tube(line[::4], np.linspace(0.0026, 0.0012, 5), 5), smooth=80))
        for j in range(4, len(line)):
            for side in (0, 180):
                turned = heading + 90 * (j % 2) + side + random.uniform(-25, 25)
                size = random.uniform(0.7, 1.1) * (1.1 - 0.4 * j / len(line))
                scene.put("eucalyptus", leaf[j % 2], aim(tuple(line[j]), turned, random.uniform(0, 45), random.uniform(-25, 25), size))


def build(scene):
    fig(scene, -1.9, -1.52)
    monstera(scene, 2.16, -0.02)
    fern(scene, 1.3, CASE + 0.0225, BACK + 0.17)
    eucalyptus(scene, -0.14, BOARD + 0.0012, BACK + 0.22)
