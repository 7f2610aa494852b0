#!/usr/bin/python3
"""Plays Tarn in a real window under Xvfb, driven by xdotool: flies, looks, places water, removes stone, opens both
panels; then asserts the counts of cells. Arguments: the program, and a folder for the pictures taken on the way.

No fixed sleeps: what the app has seen is read from the .json that F12 writes beside its pictures."""
import ctypes
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

SIZE = (480, 300)
PATIENCE_S = 90  # llvmpipe on a loaded machine takes a second a frame


def fail(why):
    sys.exit(f"play_test: {why}")


def check(condition, why):
    if not condition:
        fail(why)


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    fail(f"waited {PATIENCE_S} s for {what}")


class Display:
    """An X server of its own. Its number is guarded by the server's lock file, which -displayfd would forgo:
    servers that start at the same moment then take each other's sockets."""

    def __enter__(self):
        for _ in range(20):
            name = f":{random.randrange(100, 30000)}"
            self.environment = dict(os.environ, DISPLAY=name, LIBGL_ALWAYS_SOFTWARE="1")
            self.environment.pop("WAYLAND_DISPLAY", None)
            self.server = subprocess.Popen(["Xvfb", name, "-screen", "0", "640x480x24", "-nolisten", "tcp",
                                            "-noreset"],
                                           stderr=subprocess.DEVNULL)
            wait_for("Xvfb", lambda: self.server.poll() is not None or self.answers())
            if self.server.poll() is None:
                return self
        fail("Xvfb does not start")

    def answers(self):
        return self.run("xdotool", "getdisplaygeometry").returncode == 0

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()

    def run(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)

    def do(self, *xdotool):
        result = self.run("xdotool", *[str(word) for word in xdotool])
        check(result.returncode == 0, f"xdotool {xdotool}: {result.stderr}")

    def set_wm_state(self, window, state):
        """What a window manager would do, which Xvfb has none of; state: 1 normal, 3 iconic (ICCCM 4.1.3.1)."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XInternAtom.restype = ctypes.c_ulong
        server = ctypes.c_void_p(x11.XOpenDisplay(self.environment["DISPLAY"].encode()))
        atom = ctypes.c_ulong(x11.XInternAtom(server, b"WM_STATE", 0))
        x11.XChangeProperty(server, ctypes.c_ulong(int(window)), atom, atom, 32, 0, (ctypes.c_long * 2)(state, 0), 2)
        x11.XCloseDisplay(server)

    def photograph(self, path):
        crop = f"{SIZE[0]}x{SIZE[1]}+0+0"
        result = self.run("import", "-window", "root", "-crop", crop, "+repage", str(path))
        check(result.returncode == 0, f"import {path}: {result.stderr}")
        return path


def colors(path):
    return int(subprocess.check_output(["identify", "-format", "%k", str(path)]))


def differing_pixels(a, b):
    result = subprocess.run(["compare", "-metric", "AE", "-fuzz", "5%", str(a), str(b), "null:"],
                            capture_output=True, text=True, check=False)
    return float(result.stderr.split()[0])


class Game:
    def __init__(self, display, program, folder, pictures):
        self.display, self.folder, self.pictures = display, folder, pictures
        self.stats_path = folder / "stats.json"
        self.shots = 0
        self.process = subprocess.Popen(
            [program, "play", "--scene", "flat", "--size", f"{SIZE[0]}x{SIZE[1]}", "--quality", "fast",
             "--stats", str(self.stats_path)], cwd=folder, env=display.environment)
        self.window = wait_for("the window", self.find_window)
        display.do("windowmove", self.window, 0, 0)
        display.do("windowfocus", self.window)
        wait_for("a picture that is not blank", lambda: colors(self.photograph("start")) > 50)

    def find_window(self):
        check(self.process.poll() is None, f"tarn ended early with code {self.process.returncode}")
        return self.display.run("xdotool", "search", "--name", "^Tarn - flat$").stdout.strip()

    def photograph(self, name):
        return self.display.photograph(self.pictures / f"{name}.png")

    def state(self):
        """What the app knows in a frame that has seen all input so far."""
        self.shots += 1
        path = self.folder / f"tarn-{self.shots:04}.json"
        self.display.do("key", "F12")
        wait_for(path.name, path.exists)
        check(path.with_suffix(".png").exists(), "F12 wrote no picture")
        return json.loads(path.read_text())

    def press(self, *keys):
        """One key a frame or so: presses of one frame may act in any order."""
        for key in keys:
            self.display.do("key", key)
            self.state()

    def point(self, x, y):
        self.display.do("mousemove", x, y)

    def hold_button(self, button, ticks=0):
        """Holds a mouse button for a frame and as many ticks of the world."""
        begin = self.state()["tick"]
        self.display.do("mousedown", button)
        wait_for("ticks", lambda: self.state()["tick"] >= begin + ticks)
        self.display.do("mouseup", button)
        self.state()

    def cpu_s(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def is_idle(self):
        """True where a second of time took next to none of the processor's: no frame is drawn."""
        before = self.cpu_s()
        time.sleep(1)
        return self.cpu_s() - before < 0.05

    def quit(self):
        self.display.do("key", "ctrl+q")
        check(self.process.wait(PATIENCE_S) == 0, f"tarn ended with code {self.process.returncode}")
        return json.loads(self.stats_path.read_text())


def turn_right(game):
    game.display.do("mousemove_relative", 8, 0)
    return game.state()["settings"]["camera_yaw_deg"]


def fly_and_look(game):
    start = game.state()["settings"]
    game.display.do("keydown", "w")
    wait_for("flight", lambda: game.state()["settings"]["camera_position_vox"][2]
             < start["camera_position_vox"][2] - 4)
    game.display.do("keyup", "w")
    game.press("Tab")
    wait_for("the mouse to turn the view", lambda: turn_right(game) > start["camera_yaw_deg"])
    turned = game.state()["settings"]
    check(turned["camera_pitch_deg"] == start["camera_pitch_deg"], "a level movement changed the pitch")
    game.press("Escape")
    before = game.state()["settings"]["camera_yaw_deg"]
    game.point(350, 220)
    check(game.state()["settings"]["camera_yaw_deg"] == before, "a released mouse turned the view")


def build(game):
    empty = game.photograph("1-meadow")
    game.point(330, 170)
    game.press("p", "b", "7")
    game.hold_button(1)  # a cube of lamps, half of it in the ground; undo takes it back
    game.press("z", "p", "b", "9")
    game.point(330, 230)
    game.hold_button(1, 20)
    check(differing_pixels(empty, game.photograph("2-water")) > 200, "the water is not to be seen")
    game.display.do("click", "--repeat", 4, "4")  # the wheel: radius 2 to 6, deep enough for the stone
    game.press("1")
    game.point(150, 260)
    game.hold_button(3, 2)
    game.photograph("3-hole")


def look_at_views(game):
    """V shows one view after another, Shift+V the one before."""
    game.press("p")
    seen = [game.photograph("3-picture")]
    for view in ("albedo", "normal", "depth", "material", "bounces", "steps", "history", "variance"):
        game.press("v")
        check(game.state()["settings"]["view"] == view, f"V does not show {view}")
        photo = game.photograph(f"3-{view}")
        for other in seen[:1] + seen[-1:]:
            check(differing_pixels(photo, other) > 3000, f"{view} looks like {other.stem}")
        seen.append(photo)
    game.press("shift+v")
    check(game.state()["settings"]["view"] == "history", "Shift+V does not go back")
    game.press("v", "v")
    check(game.state()["settings"]["view"] == "picture", "V does not come round")
    game.press("p")


def open_panels(game):
    plain = game.photograph("4-plain")
    game.press("F1")
    wait_for("Help", lambda: differing_pixels(plain, game.photograph("5-help")) > 20000)
    game.press("F1", "F3", "F2")
    wait_for("Settings", lambda: differing_pixels(plain, game.photograph("6-settings")) > 20000)
    # Its first button, Pause, stops the world; the panel lies right, its size follows the window's.
    left = SIZE[0] * 0.99 - min(13 * 30, SIZE[0] * 0.55)
    game.point(round(left + 25), 44)
    game.hold_button(1)
    paused = game.state()["tick"]
    check(game.state()["tick"] == paused, "the button Pause does not pause")
    game.press("Escape")
    # Panels are gone: the middle button takes the meadow's grass into the brush.
    game.point(240, 140)
    game.display.do("click", 2)
    game.state()


def minimise(game):
    """A window that nobody sees draws nothing, and owes no time when it comes back."""
    before = game.state()
    wait_for("the window to draw", lambda: not game.is_idle())
    game.display.set_wm_state(game.window, 3)
    game.display.do("windowunmap", game.window)
    wait_for("the minimised window to rest", game.is_idle)
    game.display.set_wm_state(game.window, 1)
    game.display.do("windowmap", game.window)
    game.display.do("windowmove", game.window, 0, 0)
    game.display.do("windowfocus", game.window)
    wait_for("the picture", lambda: colors(game.photograph("7-restored")) > 50)
    check(game.state()["settings"] == before["settings"], "a minimised window changed settings")


def resize(game):
    for size in ((1, 1), SIZE):
        game.display.do("windowsize", game.window, *size)
        game.state()
    wait_for("a picture in the resized window", lambda: colors(game.photograph("7-resized")) > 50)


def main():
    program, pictures = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as name, Display() as display:
        folder = pathlib.Path(name)
        first_path = folder / "first.json"
        subprocess.run([program, "simulate", "--scene", "flat", "--ticks", "0", "--stats", str(first_path)],
                       env=display.environment, check=True)
        first = json.loads(first_path.read_text())
        game = Game(display, program, folder, pictures)
        try:
            fly_and_look(game)
            build(game)
            look_at_views(game)
            open_panels(game)
            minimise(game)
            resize(game)
            last = game.quit()
        finally:
            game.process.kill()
            game.process.wait()
    assert_counts(first, last)
    print(f"play_test: {last['frames']} frames, {last['ticks']} ticks, {last['water_quanta']} quanta of water")


def assert_counts(first, last):
    placed, removed = last["edits"]["placed"], last["edits"]["removed"]
    for material, count in last["counts"].items():
        if material in ("air", "water"):
            continue  # water's voxels change as it spreads
        books = first["counts"][material] + placed["counts"][material] - removed["counts"][material]
        check(count == books, f"{count} voxels of {material}, the books say {books}")
    check(last["water_quanta"] == placed["water_quanta"] - removed["water_quanta"], "water lost or made")
    check(last["water_quanta"] >= 16 * 33, f"only {last['water_quanta']} quanta of water were placed")
    check(removed["counts"]["stone"] > 0 and last["counts"]["stone"] < first["counts"]["stone"],
          "no stone was removed")
    check(placed["counts"]["lamp"] >= 75 and last["counts"]["lamp"] == 0, "lamps were not placed and undone")
    check(last["panels_shown"] == {"help": True, "settings": True}, f"panels: {last['panels_shown']}")
    check(last["brush"] == {"material": "grass", "shape": "sphere", "radius_vox": 6, "overwrite": False},
          f"brush: {last['brush']}")
    check(last["gl_errors"] == [], f"GL: {last['gl_errors']}")
    check(last["rejected_samples"] == 0, f"{last['rejected_samples']} samples were not finite")


if __name__ == "__main__":
    main()
