"""What is laid on the table: plates, glasses, cutlery, napkins, candles and a carafe."""

import numpy as np

from build import finish, turn
from shapes import curve, lathe, sheet, sweep, tube
from table import TOP


def plate(radius=0.132):
    """Glaze with a painted rim: the picture lies on it from above."""
    r = radius
    profile = [
        (0, 0.0015), (0.5 * r, 0.0015), (0.52 * r, 0.0), (0.57 * r, 0.0), (0.6 * r, 0.003), (0.7 * r, 0.0085), (0.97 * r, 0.0165), (r, 0.0185),
        (0.995 * r, 0.0205), (0.96 * r, 0.0205), (0.72 * r, 0.0135), (0.64 * r, 0.008), (0.55 * r, 0.0062), (0, 0.0058),
    ]
    uv = lambda p, n: np.stack([0.5 + p[:, 0] / r / 2.06, 0.5 - p[:, 2] / r / 2.06], axis=1)
    return finish("plate", lathe(profile), smooth=50, uv=uv)


def bowl(radius=0.072):
    r = radius
    profile = [
        (0, 0.004), (0.4 * r, 0.004), (0.42 * r, 0), (0.5 * r, 0), (0.52 * r, 0.006), (0.8 * r, 0.025), (0.96 * r, 0.048), (r, 0.06),
        (0.985 * r, 0.0615), (0.965 * r, 0.06), (0.92 * r, 0.048), (0.76 * r, 0.027), (0.5 * r, 0.012), (0, 0.0095),
    ]
    return finish("glaze_blue", lathe(profile), smooth=60)


def wineglass():
    """One closed surface of glass: foot, stem, and a bowl with an inside."""
    outside = [
        (0, 0.0), (0.034, 0.0), (0.0355, 0.0012), (0.034, 0.0026), (0.02, 0.005), (0.008, 0.009), (0.0045, 0.018), (0.004, 0.05), (0.0045, 0.078),
        (0.009, 0.087), (0.02, 0.095), (0.031, 0.11), (0.0365, 0.13), (0.0375, 0.15), (0.0355, 0.175), (0.032, 0.2),
    ]
    inside = [(0.0312, 0.2008), (0.0305, 0.2), (0.034, 0.175), (0.036, 0.15), (0.035, 0.13), (0.0295, 0.1115), (0.019, 0.097), (0.009, 0.0905), (0, 0.089)]
    return finish("glass", lathe(outside + inside), smooth=70)


def carafe():
    outside = [(0, 0.0), (0.048, 0.0), (0.054, 0.004), (0.062, 0.03), (0.063, 0.06), (0.054, 0.1), (0.036, 0.14), (0.025, 0.17), (0.024, 0.19), (0.031, 0.22), (0.037, 0.238)]
    inside = [(0.0362, 0.239), (0.035, 0.2375), (0.029, 0.22), (0.022, 0.19), (0.023, 0.17), (0.0335, 0.14), (0.0515, 0.1), (0.0605, 0.06), (0.0595, 0.03), (0.052, 0.0085), (0, 0.0075)]
    return finish("glass", lathe(outside + inside), smooth=70)


def candle(height, stick):
    """A burning taper in a turned stick of brass."""
    foot = [
        (0, 0), (0.046, 0), (0.048, 0.003), (0.045, 0.007), (0.026, 0.012), (0.012, 0.02), (0.009, 0.032), (0.016, 0.04), (0.016, 0.046),
        (0.0085, 0.054), (0.0075, stick * 0.6), (0.0085, stick - 0.045), (0.015, stick - 0.036), (0.015, stick - 0.03), (0.009, stick - 0.022),
        (0.019, stick - 0.01), (0.021, stick - 0.004), (0.019, stick), (0.011, stick - 0.001), (0, stick - 0.002),
    ]
    wax = [(0, stick - 0.006), (0.0105, stick - 0.006), (0.0095, stick + height - 0.006), (0.0085, stick + height), (0.006, stick + height - 0.001), (0, stick + height - 0.003)]
    wick = tube(curve([(0, stick + height - 0.005, 0), (0.0005, stick + height + 0.005, 0), (0.003, stick + height + 0.011, 0.001)], 3), 0.0011, 6)
    tip = stick + height
    flame = [(0, tip + 0.004), (0.0032, tip + 0.007), (0.0048, tip + 0.012), (0.0046, tip + 0.017), (0.0024, tip + 0.026), (0, tip + 0.036)]
    return [finish("brass", lathe(foot), smooth=50), finish("wax", lathe(wax), smooth=60), finish("iron", wick), finish("flame", lathe(flame), smooth=80)]


def blade(widths, thickness, rise=None):
    """A flat bar along z; (z, half a width) pairs; rise(z) lifts it."""
    path = np.array([(0, rise(z) if rise else 0, z) for z, _ in widths])
    t = thickness
    sections = [[(w, 0), (0.8 * w, t), (-0.8 * w, t), (-w, 0), (-0.8 * w, -0.3 * t), (0.8 * w, -0.3 * t)] for _, w in widths]
    return sweep(path, sections)


def cutlery():
    """A knife and a fork, along z, their handles towards +z."""
    knife = blade([(-0.105, 0.002), (-0.1, 0.006), (-0.06, 0.009), (0.0, 0.008), (0.008, 0.0045), (0.03, 0.005), (0.095, 0.0075), (0.1, 0.004)], 0.0016)
    lift = lambda z: 0.006 * np.exp(-(((z + 0.07) / 0.035) ** 2)) + 0.0025 * np.exp(-(((z - 0.05) / 0.05) ** 2))
    handle = blade([(-0.055, 0.009), (-0.045, 0.011), (-0.03, 0.008), (-0.015, 0.003), (0.03, 0.0035), (0.085, 0.0075), (0.095, 0.006), (0.099, 0.002)], 0.0014, lift)
    tines = handle
    for x in (-0.0075, -0.0025, 0.0025, 0.0075):
        tine = blade([(-0.1, 0.0007), (-0.09, 0.0013), (-0.06, 0.0014), (-0.05, 0.0014)], 0.0014, lift)
        tines = tines + tine.moved(x=x)
    return finish("silver", knife.moved(y=0.001), smooth=35), finish("silver", tines.moved(y=0.001), smooth=35)


def napkin():
    """Folded to a third, its layers a little apart."""
    parts = []
    for k, (w, d) in enumerate(((0.09, 0.17), (0.088, 0.167))):
        place = lambda u, v, w=w, d=d, k=k: ((u - 0.5) * w + 0.002 * k, 0.003 + 0.0042 * k + 0.0012 * np.sin(9 * v + k) * u, (0.5 - v) * d)
        parts.append(finish("linen", sheet(4, 8, place), thickness=0.003, smooth=50))
    return parts


def build(scene):
    dish, small, glass = plate(), bowl(), wineglass()
    knife, fork = cutlery()
    cloth = napkin()
    # x, z and where the guest looks, as for the chairs; whether a bowl stands on the plate.
    places = [(-0.43, -0.3, 0, True), (0.45, -0.3, 0, False), (-0.7, 0.0, 90, False), (0.7, 0.0, -90, True), (-0.2, 0.3, 180, False)]
    for k, (x, z, angle, with_bowl) in enumerate(places):
        lift = TOP + (0.0055 if abs(z) < 0.2 else 0.0006)
        group = "setting_%d" % (k + 1)
        at = lambda a, b, c=0.0, spin=0: turn(y=angle, at=(x, lift, z)) @ turn(y=spin, at=(a, c, b))
        scene.put(group, dish, at(0, 0))
        if with_bowl:
            scene.put(group, small, at(0, 0, 0.006))
        scene.put(group, knife, at(-0.165, 0, spin=180))
        scene.put(group, fork, at(0.163, 0, 0.0085 if abs(z) > 0.2 else 0.0, spin=180))
        if abs(z) > 0.2:
            scene.put(group, cloth, at(0.165, 0))
        if abs(z) > 0.2:
            scene.put(group, glass, at(-0.15 if z < 0 else -0.2, 0.165 if z < 0 else 0.14))
        else:
            scene.put(group, glass, turn(at=(x * 0.78, TOP + 0.0006, z + 0.235)))
    for x, z, height, stick in ((-0.27, 0.035, 0.2, 0.16), (-0.2, -0.075, 0.15, 0.11)):
        scene.put("candles", candle(height, stick), turn(at=(x, TOP + 0.0055, z)))
    scene.put("carafe", carafe(), turn(at=(0.34, TOP + 0.0055, 0.03)))
