"""Films an edit of a shader in the window: `python3 edit.py [LUCERNA [GIF]]`, on Linux with Xvfb, python-xlib and Pillow.

A line is changed in a copy of the shaders while the window runs on a display of its own; the lint tells what is wrong, and J judges the edit.
What changes in the window becomes frames, with the line below. Long waits are cut to a second each, and the first frame says so.
"""

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from PIL import Image, ImageChops, ImageDraw, ImageFont
from Xlib import XK, X, display
from Xlib.ext import xtest

ROOT = Path(__file__).resolve().parents[2]
SIZE = (560, 560)
STRIP = 74
MODULE = "lib/bsdf/lambert.wgsl"
RIGHT = "return kd * (INV_PI * cos_theta);"
WRONG = "return kd * (INV_PI * cos_theta * cos_theta);"
# Milliseconds: what a frame is shown at least and at most.
LEAST, MOST = 250, 1000


class Window:
    """Lucerna on a display of its own."""

    def __init__(self, lucerna, shaders):
        self.x = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "%dx%dx24" % SIZE], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        name = ":" + self.x.stdout.readline().decode().strip()
        self.display = display.Display(name)
        command = [lucerna, "view", "cornell-box", "--shaders", str(shaders), "--size", "%dx%d" % SIZE]
        self.app = subprocess.Popen(command, cwd=ROOT, env=environment(name), stderr=subprocess.PIPE, text=True)

    def picture(self):
        raw = self.display.screen().root.get_image(0, 0, *SIZE, X.ZPixmap, 0xFFFFFFFF)
        return Image.frombytes("RGB", SIZE, raw.data, "raw", "BGRX")

    def press(self, key):
        code = self.display.keysym_to_keycode(XK.string_to_keysym(key))
        for event in (X.KeyPress, X.KeyRelease):
            xtest.fake_input(self.display, event, code)
        self.display.sync()

    def close(self):
        self.app.kill()
        self.x.kill()


def environment(name):
    import os

    kept = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
    return {**kept, "DISPLAY": name}


class Film:
    """Frames with a strip of text below, each as long as it was seen, within limits."""

    def __init__(self, window):
        self.window, self.frames, self.times = window, [], []
        self.font = ImageFont.load_default(15)
        self.last = None

    def watch(self, seconds, lines):
        """Takes what is seen for so long, four times a second."""
        end = time.time() + seconds
        while time.time() < end:
            picture = self.window.picture()
            if self.last is None or ImageChops.difference(picture, self.last).getbbox() or lines != self.lines:
                self.frames.append(self.with_strip(picture, lines))
                self.times.append(LEAST)
                self.last, self.lines = picture, lines
            else:
                self.times[-1] = min(self.times[-1] + LEAST, MOST)
            time.sleep(LEAST / 1000)

    def with_strip(self, picture, lines):
        whole = Image.new("RGB", (SIZE[0], SIZE[1] + STRIP), (24, 26, 30))
        whole.paste(picture)
        draw = ImageDraw.Draw(whole)
        for row, (text, colour) in enumerate(lines):
            draw.text((10, SIZE[1] + 6 + 21 * row), text, colour, self.font)
        return whole

    def write(self, path, most_frames=26):
        """The first and last frames of every stage matter most: of the rest, every nth is left out until there are few enough."""
        while len(self.frames) > most_frames:
            shortest = min(range(1, len(self.frames) - 1), key=lambda i: (self.times[i], i % 3))
            self.times[shortest - 1] = min(self.times[shortest - 1] + self.times[shortest], MOST)
            del self.frames[shortest], self.times[shortest]
        self.times[-1] = 2500
        small = [frame.quantize(96, dither=Image.Dither.NONE) for frame in self.frames]
        small[0].save(path, save_all=True, append_images=small[1:], duration=self.times, loop=0, optimize=True)
        print("%s: %d frames, %.1f s, %.2f MB" % (path, len(small), sum(self.times) / 1e3, path.stat().st_size / 1e6))


def main():
    lucerna = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target/release/lucerna")
    path = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "result/gallery/edit.gif"
    grey, red, green, white = (150, 155, 165), (240, 120, 110), (120, 210, 130), (235, 235, 235)
    with tempfile.TemporaryDirectory() as folder:
        shaders = Path(folder) / "shaders"
        shutil.copytree(ROOT / "shaders", shaders)
        file = shaders / MODULE
        text = file.read_text()
        assert text.count(RIGHT) == 1, "the line that is edited has changed"
        window = Window(lucerna, shaders)
        try:
            time.sleep(45)
            film = Film(window)
            film.watch(1.0, [("shaders/" + MODULE, white), ("  " + RIGHT, grey), ("no graphics card; long waits are cut", grey)])
            edit = [("shaders/" + MODULE + " is saved", white), ("- " + RIGHT, red), ("+ " + WRONG, green)]
            file.write_text(text.replace(RIGHT, WRONG))
            film.watch(12.0, edit)
            window.press("j")
            film.watch(32.0, [("J: judge the edit by what was there before", white)] + edit[1:])
            film.write(path)
        finally:
            window.close()


if __name__ == "__main__":
    main()
