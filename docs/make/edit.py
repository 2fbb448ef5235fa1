"""Films an edit of a shader in the window: the saved line, the first new pixels, the lint, the verdict.

    python docs/make/edit.py LUCERNA OUTPUT.gif

Needs Xvfb, and of PyPI python-xlib and Pillow. The window draws on a display without a screen, at its own pace. Of that, what happens
in the first moments is played as it was, and waiting faster: the seconds since the save stand above the picture. Nothing that the
window shows is made up; the strip above it shows the line of the file that is saved.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from PIL import Image, ImageDraw, ImageFont
from Xlib import X, display

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# The picture is a square, and the panel stands beside it.
SCENE, PICTURE, WINDOW = "teapot", 440, (740, 440)
STRIP = 76
FILE, OLD, NEW = "lib/bsdf/lambert.wgsl", "return INV_PI * cos_theta;", "return 0.97 * INV_PI * cos_theta;"
# Of the animation: seconds, and bytes.
SECONDS, LARGEST = 10.0, 3_000_000
# Of what is filmed: seconds before the save, and after the verdict.
BEFORE, AFTER = 1.5, 2.5
PATIENCE = 180.0


class Film:
    """A display of its own, and frames of it whenever it changes."""

    def __init__(self, number):
        size = f"{WINDOW[0]}x{WINDOW[1]}x24"
        self.server = subprocess.Popen(["Xvfb", f":{number}", "-screen", "0", size, "-nolisten", "tcp"])
        self.name, self.frames = f":{number}", []
        for _ in range(100):
            try:
                self.display = display.Display(self.name)
                break
            except Exception:
                time.sleep(0.1)
        self.root = self.display.screen().root

    def look(self):
        """Keeps what is on the display, if it is other than before."""
        image = self.root.get_image(0, 0, *WINDOW, X.ZPixmap, 0xFFFFFFFF)
        if not self.frames or self.frames[-1][1] != image.data:
            self.frames.append((time.monotonic(), image.data))

    def close(self):
        self.display.close()
        self.server.terminate()
        self.server.wait()


class Window:
    """The window, and when it said what."""

    def __init__(self, program, shaders, name):
        command = [program, "view", SCENE, "--shaders", shaders, "--size", f"{PICTURE}x{PICTURE}"]
        environment = {**os.environ, "DISPLAY": name}
        environment.pop("WAYLAND_DISPLAY", None)
        self.process = subprocess.Popen(command, cwd=ROOT, env=environment, stderr=subprocess.PIPE, text=True)
        self.said = []
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        for line in self.process.stderr:
            self.said.append((time.monotonic(), line.strip()))

    def when(self, words, since=0.0):
        """When it first said something with these words."""
        return next((at for at, line in self.said if at >= since and words in line), None)


def film(program):
    """The frames, with the times of the save and of the verdict."""
    with tempfile.TemporaryDirectory() as folder:
        shaders = pathlib.Path(folder) / "shaders"
        shutil.copytree(ROOT / "shaders", shaders)
        path = shaders / FILE
        screen = Film(87)
        window = Window(program, shaders, screen.name)
        try:
            settle(screen, 25.0)
            screen.frames.clear()
            settle(screen, BEFORE)
            text = path.read_text()
            assert text.count(OLD) == 1
            path.write_text(text.replace(OLD, NEW))
            saved, verdict = time.monotonic(), None
            while verdict is None:
                screen.look()
                verdict = window.when("judged:", saved)
                if time.monotonic() - saved > PATIENCE:
                    raise SystemExit("no verdict came: " + "\n".join(line for _, line in window.said))
                time.sleep(0.05)
            settle(screen, AFTER)
            return screen.frames, saved, verdict
        finally:
            window.process.terminate()
            window.process.wait()
            screen.close()


def settle(screen, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        screen.look()
        time.sleep(0.05)


def font(size):
    for name in ("DejaVuSansMono.ttf", "LiberationMono-Regular.ttf", "Menlo.ttc", "consola.ttf"):
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            pass
    return ImageFont.load_default(size)


def strip(since):
    """The line of the file, and the time since the save; negative before it."""
    image = Image.new("RGB", (WINDOW[0], STRIP), (30, 30, 30))
    draw, small, code = ImageDraw.Draw(image), font(15), font(19)
    when = "" if since < 0 else f"{since:4.1f} s after the save"
    draw.text((14, 9), "shaders/" + FILE, (150, 150, 150), small)
    draw.text((WINDOW[0] - 14, 9), when, (150, 150, 150), small, anchor="ra")
    before, after = OLD.split("INV_PI", 1)
    x = 14
    parts = [(before, (220, 220, 220)), ("INV_PI" + after, (220, 220, 220))]
    if since >= 0:
        parts.insert(1, (NEW[len(before) : NEW.index("INV_PI")], (255, 190, 90)))
    for text, colour in parts:
        draw.text((x, 38), text, colour, code)
        x += draw.textlength(text, code)
    return image


def paced(frames, saved, verdict):
    """(milliseconds, seconds since the save, picture) of a film of some seconds; the two behind the save are as they were."""
    end = verdict + AFTER
    live = saved + 2.0
    faster = max(1.0, (verdict - live) / (SECONDS - BEFORE - 2.0 - AFTER))
    played = lambda at: at if at < live else live + (min(at, verdict) - live) / faster + max(0.0, at - verdict)
    told, last = [], None
    for (at, data), later in zip(frames, [at for at, _ in frames[1:]] + [end]):
        # Frames that are too short to be seen are left out.
        if last is None or played(at) - last >= 0.15 or at >= verdict:
            last = played(at)
            told.append((last, at - saved, data))
    ends = [at for at, _, _ in told[1:]] + [played(end)]
    return [(round(1000 * (later - at)), since, data) for (at, since, data), later in zip(told, ends)]


def write(shots, path, colours):
    pictures = []
    for _, since, data in shots:
        whole = Image.new("RGB", (WINDOW[0], STRIP + WINDOW[1]))
        whole.paste(strip(since), (0, 0))
        whole.paste(Image.frombytes("RGB", WINDOW, data, "raw", "BGRX"), (0, STRIP))
        pictures.append(whole)
    palette = pictures[-1].quantize(colours, Image.Quantize.MEDIANCUT)
    pictures = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    times = [max(20, milliseconds) for milliseconds, _, _ in shots]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=times, loop=0, optimize=True)


def main():
    program, path = sys.argv[1:]
    frames, saved, verdict = film(pathlib.Path(program).resolve())
    shots = paced(frames, saved, verdict)
    for colours in (256, 192, 128, 96, 64):
        write(shots, path, colours)
        size = pathlib.Path(path).stat().st_size
        if size <= LARGEST:
            break
    print(f"{path}: {len(shots)} frames, {sum(shot[0] for shot in shots) / 1000:.1f} s, {size / 1e6:.2f} MB, {colours} colours")


if __name__ == "__main__":
    main()
