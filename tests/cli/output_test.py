"""What good commands print and write: formats, the keys of --stats, the same bytes for the same command."""
import json
import struct
import unittest

from command import Case, exr_attributes, read_npy, read_png

SCENES = ("baths", "cave", "dam-break", "flat", "fountain", "furnace", "gallery", "islands", "lake", "locks", "u-tube", "waterfall")
MATERIAL_IDS = {"air": 0, "stone": 1, "dirt": 2, "grass": 3, "sand": 4, "glass": 5, "metal": 6, "lamp": 7, "wall": 8,
                "water": 64}
SMALL = {"size": [9, 7, 5], "seed": 3,
         "build": [{"box": {"min": [0, 0, 0], "max": [9, 1, 5], "material": "stone"}},
                   {"box": {"min": [2, 4, 1], "max": [4, 6, 3], "material": "water"}},
                   {"box": {"min": [6, 4, 4], "max": [7, 5, 5], "material": "sand"}}]}
TERRAIN = {"size": [32, 24, 32], "seed": 3, "build": [{"terrain": {"base_height_vox": 12, "amplitude_vox": 8}}]}


def without_times(stats):
    return {key: value for key, value in stats.items() if not key.endswith("_ms")}


class Texts(Case):
    def test_help_and_version(self):
        overview = self.succeed("--help")
        for command in ("play", "render", "simulate", "scenes", "settings", "doctor"):
            self.assertIn(command, overview)
            self.assertIn("--help", self.succeed(command, "--help"))
        self.assertRegex(self.succeed("--version"), r"\A\d+\.\d+\.\d+\n\Z")

    def test_scenes(self):
        lines = self.succeed("scenes").splitlines()
        self.assertEqual(tuple(line.split()[0] for line in lines), SCENES)
        for line in lines:
            self.assertGreater(len(line.split()), 3, line)

    def test_settings(self):
        text = self.succeed("settings")
        self.write("s.json", json.dumps(SMALL))
        self.succeed("simulate", "--scene", "s.json", "--ticks", "0", "--stats", "a.json")
        settings = json.loads(self.read("a.json"))["settings"]
        self.assertLess({"max_bounces", "max_distance_vox", "water_tier", "ticks_per_frame"}, set(settings))
        for key in settings:
            self.assertRegex(text, rf"(?m)^{key} +.*\(default .+\)$")

    def test_doctor(self):
        text = self.succeed("doctor")
        self.assertIn("driver", text)
        self.assertNotIn("FAIL", text)


class Recordings(Case):
    RECORDING = {"camera": "relative", "frames": 3, "lead_frames": 2, "ticks_per_frame": [0, 2, 1],
                 "keys": [{"frame": 0}, {"frame": 1, "yaw_deg": 40}],
                 "edits": [{"frame": 2, "center_vox": [0, 0, 3], "radius_vox": 1, "material": "wall"}]}

    def setUp(self):
        super().setUp()
        scene = {**SMALL, "camera": {"position_vox": [4.5, 3.5, 12], "fov_deg": 50}}
        self.write("s.json", json.dumps(scene))
        self.write("r.json", json.dumps(self.RECORDING))

    def test_numbered_pictures_and_strip(self):
        play = ("render", "--scene", "s.json", "--path", "r.json", "--size", "20x10")
        self.succeed(*play, "--out", "a.png", "--stats", "a.json")
        self.succeed(*play, "--out", "b.png", "--strip")
        self.assertEqual(self.files(), ["a-0000.png", "a-0001.png", "a-0002.png", "a.json", "b.png", "r.json", "s.json"])
        self.assertEqual(json.loads(self.read("a.json"))["ticks"], 3)
        width, height, channels, strip = read_png(self.read("b.png"))
        self.assertEqual((width, height), (60, 10))
        frames = [read_png(self.read(f"a-000{i}.png"))[3] for i in range(3)]
        for y in range(height):
            self.assertEqual(bytes(strip[y]), b"".join(bytes(frame[y]) for frame in frames))
        self.assertNotEqual(frames[0], frames[1])  # turned
        self.assertNotEqual(frames[1], frames[2])  # built

    def test_exact_frames(self):
        play = ("render", "--scene", "s.json", "--path", "r.json", "--size", "8x4", "--exact", "--spp", "4", "--out")
        self.succeed(*play, "a.exr")
        self.assertEqual(self.files(), ["a-0000.exr", "a-0001.exr", "a-0002.exr", "r.json", "s.json"])


class Cells(Case):
    def setUp(self):
        super().setUp()
        self.write("s.json", json.dumps(SMALL))

    def test_npy(self):
        self.succeed("simulate", "--scene", "s.json", "--ticks", "0", "--cells", "a.npy")
        shape, cells = read_npy(self.read("a.npy"))
        self.assertEqual(shape, (5, 7, 9))
        expected = [1 if y == 0 else 64 if 2 <= x < 4 and 4 <= y < 6 and 1 <= z < 3 else 4 if (x, y, z) == (6, 4, 4)
                    else 0 for z in range(5) for y in range(7) for x in range(9)]
        self.assertEqual(list(cells), expected)

    def test_amounts(self):
        self.succeed("simulate", "--scene", "s.json", "--ticks", "0", "--cells", "a.npy", "--amounts", "b.npy")
        shape, amounts = read_npy(self.read("b.npy"))
        self.assertEqual(shape, (5, 7, 9))
        self.assertEqual(list(amounts), [16 * (id == 64) for id in read_npy(self.read("a.npy"))[1]])
        # Spread over the floor there are parts of voxels: one id whatever the amount.
        self.succeed("simulate", "--scene", "s.json", "--ticks", "60", "--cells", "a.npy", "--amounts", "b.npy",
                     "--set", "film_threshold=1")
        ids, amounts = (read_npy(self.read(name))[1] for name in ("a.npy", "b.npy"))
        self.assertEqual([id == 64 for id in ids], [quanta > 0 for quanta in amounts])
        self.assertEqual(sum(amounts), 8 * 16)
        self.assertLess(0, sum(0 < quanta < 16 for quanta in amounts))
        self.assertLessEqual(max(amounts), 16)
        self.assertEqual(self.succeed("simulate", "--scene", "s.json", "--ticks", "0", "--amounts", "b.npy"), "")
        self.refuse(["simulate", "--scene", "s.json", "--ticks", "0", "--amounts", "b.txt"], "--amounts", ".npy")
        self.refuse(["simulate", "--scene", "s.json", "--ticks", "0", "--amounts", "missing/b.npy"], "missing")

    def test_stats(self):
        self.succeed("simulate", "--scene", "s.json", "--ticks", "60", "--cells", "a.npy", "--stats", "a.json", "--set",
                     "film_threshold=1", "--set", "water_tier=block", "--set", "max_bounces=3")
        stats = json.loads(self.read("a.json"))
        _, cells = read_npy(self.read("a.npy"))
        self.assertEqual(stats["size"], [9, 7, 5])
        self.assertEqual(stats["ticks"], 60)
        self.assertEqual(stats["seed"], 3)
        self.assertEqual(stats["material_ids"], MATERIAL_IDS)
        self.assertEqual(stats["water_quanta"], 8 * 16)
        self.assertEqual({name: cells.count(id) for name, id in MATERIAL_IDS.items()}, stats["counts"])
        self.assertGreater(stats["counts"]["water"], 8)  # it spread
        self.assertEqual(stats["counts"]["sand"], 1)
        self.assertRegex(stats["cells_hash"], r"\A[0-9a-f]{16}\Z")
        self.assertEqual(set(stats["driver"]), {"vendor", "renderer", "version"})
        self.assertGreater(stats["pass_ms"]["step"]["mean"], 0)
        self.assertEqual([stats["settings"][key] for key in ("film_threshold", "water_tier", "max_bounces")],
                         [1, "block", 3])

    def test_stats_to_stdout(self):
        self.assertEqual(json.loads(self.succeed("simulate", "--scene", "s.json", "--ticks", "2"))["ticks"], 2)
        self.assertEqual(self.files(), ["s.json"])

    def test_same_command_same_bytes(self):
        for name in ("a", "b"):
            self.succeed("simulate", "--scene", "s.json", "--ticks", "50", "--cells", f"{name}.npy", "--stats",
                         f"{name}.json")
        self.assertEqual(self.read("a.npy"), self.read("b.npy"))
        a, b = (without_times(json.loads(self.read(f"{name}.json"))) for name in ("a", "b"))
        self.assertEqual(a, b)
        self.assertEqual(self.files(), ["a.json", "a.npy", "b.json", "b.npy", "s.json"])

    def test_seed(self):
        self.write("t.json", json.dumps(TERRAIN))
        for name, seed in (("a", ()), ("b", ("--seed", "3")), ("c", ("--seed", "4"))):
            self.succeed("simulate", "--scene", "t.json", "--ticks", "0", "--cells", f"{name}.npy", *seed)
        self.assertEqual(self.read("a.npy"), self.read("b.npy"))
        self.assertNotEqual(self.read("a.npy"), self.read("c.npy"))

    def test_old_files_are_replaced(self):
        self.write("a.npy", "older")
        self.succeed("simulate", "--scene", "s.json", "--ticks", "0", "--cells", "a.npy")
        self.assertEqual(len(read_npy(self.read("a.npy"))[1]), 9 * 7 * 5)
        self.assertEqual(self.files(), ["a.npy", "s.json"])


class Conservation(Case):
    def stats(self, scene, ticks):
        self.succeed("simulate", "--scene", scene, "--ticks", str(ticks), "--stats", "a.json")
        return json.loads(self.read("a.json"))

    def test_dam_break_is_constant(self):
        start, end = self.stats("dam-break", 0), self.stats("dam-break", 100)
        self.assertNotEqual(start["cells_hash"], end["cells_hash"])
        self.assertEqual(start["water_quanta"], end["water_quanta"])
        self.assertEqual(set(end["flow"].values()), {0})

    def test_waterfall_balances(self):
        start, end = self.stats("waterfall", 0), self.stats("waterfall", 300)
        flow = end["flow"]
        self.assertGreater(flow["sprung_water_quanta"], 0)
        self.assertEqual(end["water_quanta"],
                         start["water_quanta"] + flow["sprung_water_quanta"] - flow["drained_water_quanta"])
        self.assertEqual(end["counts"]["sand"],
                         start["counts"]["sand"] + flow["sprung_sand_voxels"] - flow["drained_sand_voxels"])


class Pictures(Case):
    def render(self, name, *arguments, **environment):
        self.succeed("render", "--scene", "furnace", "--size", "20x12", "--out", name, *arguments, **environment)
        return self.read(name)

    def test_png(self):
        furnace = ("--set", "light_sampling=none", "--set", "roulette_after=1024", "--set", "tone_map=linear", "--set",
                   "max_diffuse_bounces=1024", "--set", "firefly_limit=0")
        for bounces, expected_srgb in ((0, 188), (1, 225), (5, 253)):  # of 1 - 0.5^(n+1), sRGB-encoded
            width, height, channels, rows = read_png(self.render("a.png", "--set", f"max_bounces={bounces}", *furnace))
            self.assertEqual((width, height), (20, 12))
            for row in rows:
                for x in range(width):
                    for value in row[channels * x:channels * x + 3]:
                        self.assertAlmostEqual(value, expected_srgb, delta=1)

    def test_exr(self):
        data = self.render("a.exr", "--exact", "--spp", "2", "--stats", "a.json")
        attributes = exr_attributes(data)
        self.assertEqual(struct.unpack("<4i", attributes["dataWindow"]), (0, 0, 19, 11))
        for channel in (b"R\0", b"G\0", b"B\0"):
            self.assertIn(channel + struct.pack("<i", 2), attributes["channels"])  # 32-bit float
        stats = json.loads(self.read("a.json"))
        self.assertEqual((stats["settings"]["quality"], stats["settings"]["filter"], stats["samples"]),
                         ("exact", "none", 2))
        self.assertEqual(stats["rejected_samples"], 0)
        self.assertEqual(stats["gl_errors"], [])

    def test_same_command_same_bytes(self):
        for extension in ("png", "exr"):
            command = ("--frames", "3", "--camera", "7.5,8,8,30,-10,70")
            self.assertEqual(self.render(f"a.{extension}", *command), self.render(f"b.{extension}", *command))
        self.assertEqual(self.files(), ["a.exr", "a.png", "b.exr", "b.png"])

    def test_settings_reach_the_picture(self):
        self.write("s.json", json.dumps(SMALL))

        def picture(*arguments):
            self.succeed("render", "--scene", "s.json", "--size", "24x16", "--out", "a.png", *arguments)
            return read_png(self.read("a.png"))

        view = ("--camera", "4,5,12,0,-25")
        usual = picture(*view)
        for change in ((*view, "--set", "max_bounces=0"), (*view, "--set", "max_distance_vox=4"),
                       (*view, "--ticks", "20"), (*view, "--set", "sky_zenith=1,0,0"), ("--camera", "4,5,14,0,-25")):
            self.assertNotEqual(picture(*change), usual, change)

    def test_views(self):
        pictures = {self.render("a.exr")}
        for view in ("albedo", "normal", "depth", "material", "bounces", "steps", "history", "variance"):
            data = self.render("a.exr", "--view", view)
            self.assertEqual(data, self.render("b.exr", "--set", f"view={view}"), view)
            self.assertEqual(data, self.render("b.exr", "--set", "view=depth", "--view", view), view)
            self.assertNotIn(data, pictures, view)
            pictures.add(data)
        self.assertIn(self.render("b.exr", "--view", "picture"), pictures)
        # Nothing but wall: one colour, neither black nor white.
        _, _, channels, rows = read_png(self.render("a.png", "--view", "material"))
        colours = {bytes(row[x:x + 3]) for row in rows for x in range(0, len(row), channels)}
        self.assertEqual(len(colours), 1)
        self.assertNotIn(colours.pop(), (bytes(3), b"\xff\xff\xff"))

    def test_ticks_per_frame(self):
        self.write("s.json", json.dumps(SMALL))
        for per_frame, ticks in ((0, 5), (3, 17)):
            self.succeed("render", "--scene", "s.json", "--size", "8x8", "--out", "a.png", "--stats", "a.json",
                         "--ticks", "5", "--frames", "4", "--set", f"ticks_per_frame={per_frame}")
            self.assertEqual(json.loads(self.read("a.json"))["ticks"], ticks)

    def test_play_without_a_display(self):
        text = self.succeed("play", "--scene", "furnace", "--size", "16x9", DISPLAY="", WAYLAND_DISPLAY="")
        self.assertRegex(text, r"\Atarn: no display[^\n]*tarn-furnace\.png[^\n]*\n\Z")
        self.assertEqual(self.files(), ["tarn-furnace.png"])
        self.assertEqual(read_png(self.read("tarn-furnace.png"))[:2], (16, 9))


if __name__ == "__main__":
    unittest.main()
