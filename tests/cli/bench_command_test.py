"""`tarn bench`: what it prints and writes, figures of contestants that agree, two runs side by side, bad names."""
import csv
import io
import json
import os
import unittest

from command import Case

SHORT = ["bench", "--sizes", "32", "--repeats", "1"]


class Bench(Case):
    def run_short(self, suites, folder, *more):
        text = self.succeed(*SHORT, "--suite", suites, "--out", folder, *more)
        self.assertEqual(sorted(os.listdir(self.path(folder))), ["bench.csv", "bench.json"])
        report = json.loads(self.read(folder + "/bench.json"))
        self.assertEqual(report["failures"], [])
        for figure in report["figures"]:
            self.assertIn(figure["what"], text)
            self.assertTrue(figure["min"] <= figure["median"] <= figure["max"], figure)
        return text, report, {(f["suite"], f["scene"], f["what"], f["who"]): f for f in report["figures"]}

    def test_rays_ticks_edits(self):
        text, report, figures = self.run_short("rays,sim,edit", "new/folder")
        for word in ("cpu", "driver", "bar", "at least", "reach for", "not measured"):
            self.assertIn(word, text)
        for key in ("cpu", "threads", "driver", "compiler", "tarn", "embree", "repeats"):
            self.assertIn(key, report["about"])
        self.assertEqual(report["about"]["sizes_vox"], "32")
        self.assertEqual(report["settings"]["quality"], "balanced")
        rows = list(csv.DictReader(io.StringIO(self.read("new/folder/bench.csv").decode())))
        self.assertEqual({(r["suite"], r["scene"], r["what"], r["who"]) for r in rows}, set(figures))

        contestants = ["tarn", "voxel"]
        if report["about"]["embree"]:
            contestants += ["embree-8", "embree-1"]
        else:
            self.assertIn("Embree is left out", text)
        for kind in ("primary", "diffuse", "in-water", "shadow"):
            for who in contestants:
                self.assertGreater(figures["rays", "terrain-32", kind, who]["median"], 0)
                if who.startswith("embree"):
                    self.assertGreaterEqual(figures["rays", "terrain-32", kind + ": agree", who]["median"], 0.999)
            self.assertLessEqual(figures["rays", "terrain-32", kind + ": steps", "tarn"]["median"],
                                 figures["rays", "terrain-32", kind + ": steps", "voxel"]["median"])
        self.assertEqual(figures["rays", "terrain-32", "primary: rays", "all"]["median"], 640 * 360)
        counts = {what.split(": ")[0]: figure["median"] for (_, _, what, who), figure in figures.items()
                  if what.endswith(": rays") and who == "all"}
        for who in contestants:
            time = sum(count / figures["rays", "terrain-32", kind, who]["samples"][0] for kind, count in counts.items())
            self.assertAlmostEqual(figures["rays", "terrain-32", "all kinds", who]["samples"][0],
                                   sum(counts.values()) / time, places=3)
        awake = {who: figures["sim", "terrain-32", "active bricks", who]["median"]
                 for who in ("awake", "tenth", "asleep")}
        self.assertEqual((awake["awake"], awake["asleep"]), (8 ** 3, 0))
        self.assertEqual(awake["tenth"], 8 * 8)
        for who in ("awake", "asleep", "cpu awake", "awake block", "cpu awake block"):
            self.assertGreater(figures["sim", "terrain-32", "tick", who]["median"], 0)
        for who in ("radius 1", "radius 8", "radius 32"):
            self.assertGreater(figures["edit", "terrain-32", "stroke", who]["median"], 0)

    def test_frames(self):
        size = "96x54"
        text, report, figures = self.run_short("frame", "frames", "--size", size)
        for scene in ("lake", "terrain-32"):
            for who in ("baseline", "fast", "balanced", "quality", "exact"):
                self.assertGreater(figures["frame", scene, "frame " + size, who]["median"], 0)
                passes = {what.split(": ")[1]: figure["median"] for (_, of, what, by), figure in figures.items()
                          if of == scene and by == who and what.startswith(f"frame {size}: ")}
                last = {"accumulate"} if who == "exact" else {"temporal", "filter"}
                if who in ("balanced", "quality"):
                    last.add("antialias")
                self.assertEqual(set(passes), {"trace", "display", *last}, (scene, size, who))
                self.assertGreater(min(passes.values()), 0)
            if report["about"]["embree"]:
                self.assertGreater(figures["frame", scene, "primary rays " + size, "embree-8"]["median"], 0)
        if not report["about"]["embree"]:
            self.assertIn("Embree is left out", text)

    def test_compare(self):
        self.run_short("edit", "old")
        text = self.succeed(*SHORT, "--suite", "edit", "--compare", "old/bench.json")
        self.assertIn("new/old", text)
        report = json.loads(self.read("old/bench.json"))
        for figure in report["figures"]:
            figure["samples"] = [2 * value for value in figure["samples"]]
        self.write("doubled.json", json.dumps(report))
        rows = [line for line in self.succeed("bench", "--compare", "old/bench.json", "--with", "doubled.json")
                .splitlines() if "stroke" in line]
        self.assertEqual(len(rows), 3)
        for row in rows:
            self.assertRegex(row, r" 2\.000  worse$")

    def test_start(self):
        _, _, figures = self.run_short("start", "start")
        for scene in ("lake", "terrain-32"):
            for who in ("cold", "warm"):
                self.assertGreater(figures["start", scene, "first frame", who]["median"], 0)
                # The program itself and the driver's libraries need some.
                self.assertGreater(figures["start", scene, "peak memory", who]["median"], 20)

    def test_variants(self):
        _, _, figures = self.run_short("variants", "variants")
        for scene, names in (("dry-32", ("clear", "rough", "smooth-water", "coated", "emitters", "all")),
                             ("terrain-32", ("rough", "coated", "emitters", "tick at rest", "tick awake")),
                             ("cave", ("sun", "all"))):
            for who in names:
                self.assertGreater(figures["variants", scene, "with / without", who]["median"], 0)

    def test_bad_names(self):
        self.refuse(["bench", "--suite", "rays,moon"], "--suite moon", "rays, frame, sim, edit, start, variants")
        self.refuse(["bench", "--sizes", "8"], "--sizes", "16")
        self.refuse(["bench", "--repeats", "0"], "--repeats")
        self.refuse(["bench", "--with", "old.json"], "--with", "--compare")
        self.refuse(["bench", "--compare", "missing.json"], "missing.json")
        self.write("other.json", "{}")
        self.refuse(["bench", "--compare", "other.json"], "other.json", "bench.json")
        self.write("file", "")
        self.refuse([*SHORT, "--suite", "edit", "--out", "file"], "--out file")

    def test_help(self):
        text = self.succeed("bench", "--help")
        for word in ("rays", "frame", "sim", "edit", "start", "Embree", "--compare", "Exit code 1"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
