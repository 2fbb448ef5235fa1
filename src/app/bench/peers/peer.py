"""Mitsuba 3 as a peer of `lucerna bench peers`: renders one scene when it is told to, and says how long that took.

    python peer.py VARIANT SCENE.xml

A line of standard input is a command, and each is answered by one line of JSON on standard output:
    render SPP SEED FILE.exr    renders, and writes the picture as linear floats
It ends with its standard input, whatever it is at: so nothing is left when the program that started it is gone.
"""

import json
import os
import queue
import signal
import sys
import threading

# Whoever started this decides when it ends.
signal.signal(signal.SIGINT, signal.SIG_IGN)

# What libraries print goes to standard error: standard output is for answers alone.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def answer(**what):
    print(json.dumps(what), file=answers, flush=True)


commands = queue.Queue()


def listen():
    for line in sys.stdin:
        commands.put(line.split(" ", 3))
    os._exit(0)


def main():
    threading.Thread(target=listen, daemon=True).start()
    import time

    import mitsuba as mi

    variant, scene_file = sys.argv[1:3]
    if variant not in mi.variants():
        return answer(error=f"it has no variant {variant}", known=mi.variants())
    mi.set_variant(variant)
    mi.set_log_level(mi.LogLevel.Warn)
    compiled = not variant.startswith("scalar")
    if compiled:
        import drjit as dr
    scene = mi.load_file(scene_file)
    answer(version=mi.__version__)

    while True:
        _, spp, seed, file = commands.get()
        if compiled:
            dr.sync_thread()
        begin = time.perf_counter()
        image = mi.render(scene, spp=int(spp), seed=int(seed))
        if compiled:
            dr.eval(image)
            dr.sync_thread()
        seconds = time.perf_counter() - begin
        bitmap = mi.Bitmap(image).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        bitmap.write(file.strip())
        answer(seconds=seconds)


try:
    main()
except Exception as error:
    answer(error=f"{type(error).__name__}: {error}")
