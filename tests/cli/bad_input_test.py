"""Bad input: exit code 2, one line that names the argument or file, the reason and what is allowed; no file written,
none touched."""
import json
import os
import stat
import unittest

from command import Case

RENDER = ["render", "--scene", "flat", "--size", "8x8"]
SIMULATE = ["simulate", "--scene", "flat", "--ticks", "1"]
WITHOUT_DRIVER = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent",
                  "VK_ICD_FILENAMES": "/nonexistent"}


class BadArguments(Case):
    def test_commands_and_options(self):
        self.refuse([], "subcommand", "--help")
        for option in ("--camera", "--stats", "--out"):
            self.refuse(["render", "--scene", "flat", "--out", "x.png", option, ""], option, "empty")
        self.refuse(["water", "--tier", ""], "--tier", "empty")
        self.refuse(["dig"], "dig", "play, render, simulate, water, light, bench, tradeoff, scenes, settings, doctor")
        self.refuse(["render", "--scene", "flat"], "--out", "required")
        self.refuse(["simulate", "--scene", "flat"], "--ticks", "required")
        self.refuse(["simulate", "--ticks", "1"], "--scene", "required")
        self.refuse([*SIMULATE, "--paint", "red"], "--paint")
        self.refuse([*RENDER, "--out", "a.png", "--out", "b.png"], "--out")
        self.refuse([*RENDER, "--out", "a.png", "--spp", "3"], "--spp", "--exact")
        self.refuse([*RENDER, "--out", "a.png", "--exact", "--frames", "3"], "--exact", "--frames")
        for view in ("x-ray", "Depth", "3", "depth,normal"):
            self.refuse([*RENDER, "--out", "a.png", f"--view={view}"], "--view", "picture, albedo, normal, depth")
        self.refuse([*RENDER, "--out", "a.png", "--view="], "--view", "missing")
        self.refuse([*SIMULATE, "--view", "depth"], "--view")
        self.refuse([*RENDER, "--out", "a.png", "--exact", "--quality", "fast"], "--quality fast", "exact")

    def test_numbers(self):
        for ticks in ("-1", "nan", "1.5", "1e9", "99999999999999999999", ""):
            self.refuse(["simulate", "--scene", "flat", f"--ticks={ticks}", "--cells", "a.npy"], "--ticks")
        for seed in ("-1", "4294967296", "nan"):
            self.refuse([*SIMULATE, f"--seed={seed}"], "--seed")
        for frames in ("0", "-1", "inf"):
            self.refuse([*RENDER, "--out", "a.png", f"--frames={frames}"], "--frames")
        for spp in ("0", "-5"):
            self.refuse([*RENDER, "--out", "a.png", "--exact", f"--spp={spp}"], "--spp")
        self.refuse([*RENDER, "--out", "a.png", "--exact", "--spp", "3", "--set", "samples_per_pixel=2"], "--spp 3",
                    "samples_per_pixel=2", "multiple")
        for camera in ("1,2,3", "1,2,3,4,5,6,7", "1,2,nan,4,5", "1,2,3,4,91", "1,2,3,4,5,180", "1,2,3,4,", "a,b,c,d,e",
                       "1,2,3,4,5,0"):
            self.refuse([*RENDER, "--out", "a.png", f"--camera={camera}"], "--camera", "allowed")

    def test_picture_sizes(self):
        for size in ("16384x16384", "0x0", "0x8", "8x0", "-1x8", "16385x8", "8x16385", "5000", "8", "8x", "x8", "8x8x8", "8X8",
                     "nanx8", "99999999999x8", "8.5x8"):
            self.refuse(["render", "--scene", "flat", "--out", "a.png", f"--size={size}"], f"--size {size}",
                        "1 to 16384")

    def test_settings(self):
        for key, values, allowed in (
                ("max_bounces", ("nan", "-1", "1.5", "1025", "", "many", "0x10"), "0 to 1024"),
                ("max_distance_vox", ("nan", "NaN", "-nan", "inf", "-inf", "-1", "0", "1e30", "1e400"),
                 "1 to 10000000"),
                ("ticks_per_frame", ("-1", "nan", "1001"), "0 to 1000"),
                ("water_tier", ("nan", "-1", "fastest", ""), "block"),
                ("quality", ("best", "1"), "baseline, fast, balanced, quality, exact"),
                ("jitter", ("perhaps", "nan"), "true"),
                ("camera_fov_deg", ("0", "-5", "180", "nan"), "1 to 179"),
                ("water_color", ("0,0,0", "1,1", "1,1,nan", "-1,1,1", "1,1,1,1"), "0.0001 to 1"),
                ("sun_irradiance", ("-1,0,0", "nan,0,0"), "0 to 1000000")):
            for value in values:
                self.refuse([*SIMULATE, "--set", f"{key}={value}"], f"{key}=", "allowed", allowed)
        self.refuse([*SIMULATE, "--set", "max_bouncs=3"], "max_bouncs", "tarn settings")
        self.refuse([*SIMULATE, "--set", "max_bounces"], "max_bounces", "key=value")
        self.refuse([*SIMULATE, "--set", "=3"], "tarn settings")
        self.refuse([*RENDER, "--out", "a.png", "--quality", "best"], "best",
                    "baseline, fast, balanced, quality, exact")
        # A later mistake counts after an earlier good value.
        self.refuse([*SIMULATE, "--set", "max_bounces=3", "--set", "max_bounces=-3"], "max_bounces=-3")


class BadScenes(Case):
    def refuse_scene(self, text, *words):
        self.write("s.json", text if isinstance(text, str) else json.dumps(text))
        self.refuse(["simulate", "--scene", "s.json", "--ticks", "1", "--cells", "a.npy", "--stats", "a.json"],
                    "s.json", *words)

    def test_unknown_scene(self):
        self.refuse(["simulate", "--scene", "atlantis", "--ticks", "1"], "atlantis", "dam-break", "lake", ".json")
        self.refuse(["render", "--scene", "atlantis", "--out", "a.png"], "atlantis", "dam-break", "lake", ".json")
        self.refuse(["play", "--scene", "atlantis"], "atlantis", "dam-break")
        self.refuse(["simulate", "--scene", "none.json", "--ticks", "1"], "none.json", "No such file")
        os.mkdir(self.path("folder.json"))
        self.refuse(["simulate", "--scene", "folder.json", "--ticks", "1"], "folder.json", "directory")

    def test_broken_json(self):
        self.refuse_scene("", "1")
        self.refuse_scene('{"size": [8, 8, 8],\n "seed": }', "2")
        self.refuse_scene('{"size": [8, 8, 8]', "s.json")
        self.refuse_scene('{"size": [8, 8, 8]} {}')
        self.refuse_scene("[1, 2]", "object")
        self.refuse_scene('{"size": [8, 8, 8], "seed": NaN}')
        self.refuse_scene("\x00\x01\x02")

    def test_unknown_keys(self):
        self.refuse_scene({"size": [8, 8, 8], "colour": 1}, "colour")
        self.refuse_scene({"size": [8, 8, 8], "camera": {"roll_deg": 1}}, "camera", "roll_deg")
        self.refuse_scene({"size": [8, 8, 8], "build": [{"cone": {}}]}, "build", "cone")
        self.refuse_scene({"size": [8, 8, 8], "materials": {"stone": {"shine": 1}}}, "stone", "shine")
        self.refuse_scene({"size": [8, 8, 8], "materials": {"cheese": {}}}, "cheese")

    def test_world_sizes(self):
        for size in ([0, 8, 8], [8, 5000, 8], [8, 8, 1025], [-8, 8, 8], [8, 8], [8, 8, 8, 8], [8, 8, 8.5], [8, 8, 1e30],
                     "8x8x8", 8, [8, 8, None]):
            self.refuse_scene({"size": size}, "size")
        self.refuse_scene({"size": [0, 0, 0]}, "size", "1", "1024")
        self.refuse_scene({"size": [5000, 5000, 5000]}, "size", "5000", "1024")

    def test_values(self):
        self.refuse_scene({"size": [8, 8, 8], "metres_per_voxel": 0}, "metres_per_voxel")
        self.refuse_scene({"size": [8, 8, 8], "metres_per_voxel": -1}, "metres_per_voxel")
        self.refuse_scene({"size": [8, 8, 8], "seed": -1}, "seed")
        self.refuse_scene({"size": [8, 8, 8], "materials": {"stone": {"roughness": 2}}}, "roughness")
        self.refuse_scene({"size": [8, 8, 8], "sun": {"irradiance": [-1, 0, 0]}}, "irradiance")
        self.refuse_scene({"size": [8, 8, 8],
                           "build": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1], "material": "cheese"}}]}, "cheese")


class BadRecordings(Case):
    def refuse_recording(self, text, *words):
        self.write("r.json", text if isinstance(text, str) else json.dumps(text))
        self.refuse([*RENDER, "--out", "a.png", "--path", "r.json"], "r.json", *words)

    def test_options(self):
        self.refuse([*RENDER, "--out", "a.png", "--path", "walking"], "walking", "flying, moving-water, still", ".json")
        self.refuse([*RENDER, "--out", "a.png", "--path", "none.json"], "none.json", "No such file")
        self.refuse([*RENDER, "--out", "a.png", "--path", "still", "--frames", "3"], "--path", "--frames")
        self.refuse([*RENDER, "--out", "a.png", "--strip"], "--strip", "--path")
        self.refuse([*RENDER, "--out", "a.exr", "--strip", "--path", "still"], "--strip", ".png")
        self.refuse(["render", "--scene", "flat", "--out", "a.png", "--size", "4000x4000", "--strip", "--path", "still"],
                    "--strip", "pixels")
        self.refuse([*RENDER, "--out", "missing/a.png", "--path", "still"], "missing", "cannot write")

    def test_files(self):
        good = {"camera": "relative", "frames": 2, "keys": [{"frame": 0}]}
        self.refuse_recording("", "1")
        self.refuse_recording({**good, "frames": -1}, "frames", "1 to")
        self.refuse_recording({**good, "roll": 1}, "roll", "unknown key")
        self.refuse_recording({**good, "keys": [{"frame": 1}]}, "keys[0].frame")
        self.refuse_recording({**good, "ticks_per_frame": 1001}, "ticks_per_frame", "0 to 1000")
        self.refuse_recording({**good, "edits": [{"frame": 0, "center_vox": [0, 0, 0], "material": "cheese"}]},
                              "edits[0].material", "water")


class BadOutputs(Case):
    def test_pictures(self):
        self.refuse([*RENDER, "--out", "missing/a.png"], "missing", "cannot write")
        self.refuse([*RENDER, "--out", "/proc/a.png"], "/proc/a.png", "cannot write")
        self.refuse([*RENDER, "--out", "a.jpg"], "a.jpg", ".png", ".exr")
        self.refuse([*RENDER, "--out", "a"], ".png", ".exr")
        self.refuse([*RENDER, "--out", ""], "--out")
        os.mkdir(self.path("folder.png"))
        self.refuse([*RENDER, "--out", "folder.png"], "folder.png", "directory")
        self.write("file", "")
        self.refuse([*RENDER, "--out", "file/a.exr"], "file", "cannot write")

    def test_cells_and_stats(self):
        self.refuse([*SIMULATE, "--cells", "missing/a.npy"], "missing", "cannot write")
        self.refuse([*SIMULATE, "--cells", "a.txt"], "a.txt", ".npy")
        self.refuse([*SIMULATE, "--stats", "missing/a.json"], "missing", "cannot write")
        # One bad output leaves the good one unwritten, and an older file as it was.
        self.write("a.npy", "older")
        self.refuse([*SIMULATE, "--cells", "a.npy", "--stats", "missing/a.json"], "missing")
        self.write("a.png", "older")
        self.refuse([*RENDER, "--out", "a.png", "--stats", "missing/a.json"], "missing")

    def test_a_full_disk(self):
        os.symlink("/dev/full", self.path("full.json"))
        self.refuse([*SIMULATE, "--stats", "full.json"], "full.json", "cannot write", "No space")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))


class BadDrivers(Case):
    def test_no_driver(self):
        self.write("a.png", "older")
        for arguments in ([*RENDER, "--out", "a.png"], [*RENDER, "--out", "b.exr"], [*SIMULATE, "--cells", "a.npy"]):
            self.refuse(arguments, "EGL", "4.5", **WITHOUT_DRIVER)
            self.refuse(arguments, "EGL", "4.5", LIBGL_DRIVERS_PATH="/nonexistent")

    def test_doctor_without_a_driver_fails_a_check(self):
        result = self.run_tarn("doctor", **WITHOUT_DRIVER)
        self.assertEqual(result.returncode, 1)
        self.assertIn("FAIL", result.stdout)

    def test_old_driver(self):
        self.write("a.png", "older")
        for version in ("3.3", "4.1", "4.4"):
            self.refuse([*RENDER, "--out", "a.png"], version, "4.5", MESA_GL_VERSION_OVERRIDE=version)
            self.refuse([*SIMULATE, "--cells", "a.npy"], version, "4.5", MESA_GL_VERSION_OVERRIDE=version)


if __name__ == "__main__":
    unittest.main()
