"""`tarn tradeoff`: a tiny run from end to end, its files, resuming, reporting again, the front; bad names."""
import csv
import io
import json
import os
import unittest
import xml.dom.minidom

from command import Case, read_png

TINY = ("tradeoff", "--part", "light", "--quick", "--scene", "lake", "--size", "32x20", "--configurations", "5",
        "--reference-samples", "8", "--out", "new/folder")


class Tradeoff(Case):
    def rows(self):
        return list(csv.DictReader(io.StringIO(self.read("new/folder/tradeoff.csv").decode())))

    def test_run_resume_and_report(self):
        text = self.succeed(*TINY, "--write-front", "front.json")
        files = set(os.listdir(self.path("new/folder")))
        self.assertEqual(files, {"tradeoff.csv", "tradeoff.txt", "estimate.csv", "references"} |
                         {f"{name}.{kind}" for name in ("tradeoff", "tradeoff-lake", "estimate") for kind in ("svg", "png")})
        for name in ("tradeoff", "tradeoff-lake", "estimate"):
            xml.dom.minidom.parseString(self.read(f"new/folder/{name}.svg"))
            width, height, _, pixels = read_png(self.read(f"new/folder/{name}.png"))
            self.assertGreater(min(width, height), 500)
            self.assertGreater(sum(row.count(0) for row in pixels), 1000)  # ink
        rows = self.rows()
        self.assertEqual({row["recording"] for row in rows}, {"still", "flying", "moving-water"})
        self.assertEqual(len(rows), 5 * 3)
        labels = {row["label"] for row in rows}
        self.assertEqual({"baseline", "baseline samples_per_pixel=4", "balanced", "fast", "quality"}, labels)
        for row in rows:
            self.assertEqual(row["rejected"], "0")
            self.assertGreater(float(row["time_ms"]), 0)
            self.assertGreater(float(row["floor"]), 0)
            self.assertEqual(row["near_floor"], "1" if float(row["error"]) < 3 * float(row["floor"]) else "0")
        for word in ("front, from fast to accurate", "baseline for the same error", "true is"):
            self.assertIn(word, text)
        points = json.loads(self.read("front.json"))["points"]
        self.assertGreaterEqual(len(points), 1)

        # An interrupted run: half a row is measured anew, the rest is taken as it is.
        whole = self.read("new/folder/tradeoff.csv").decode()
        lines = whole.splitlines(keepends=True)
        self.write("new/folder/tradeoff.csv", "".join(lines[:-1]) + lines[-1][:20])
        text = self.succeed(*TINY, "--resume")
        self.assertIn("14 rows go on, 0 of another program", text)
        again = self.rows()
        self.assertEqual(len(again), 15)
        self.assertEqual(again[:14], rows[:14])
        # Random numbers follow from frames alone, and the references lie in the folder.
        for key in ("error", "bias", "floor", "predicted"):
            self.assertEqual(again[14][key], rows[14][key])

        report = self.succeed("tradeoff", "--report", "--out", "new/folder")
        self.assertIn("front, from fast to accurate", report)
        self.assertEqual(self.rows(), again)

    def test_bad_input(self):
        self.refuse(["tradeoff", "--scene", "moon"], "--scene moon", "lake, waterfall, gallery, cave")
        self.refuse(["tradeoff", "--part", "sound"], "--part sound", "light, water")
        self.refuse(["tradeoff", "--configurations", "201"], "--configurations")
        self.refuse(["tradeoff", "--reference-samples", "1"], "--reference-samples")
        self.refuse(["tradeoff", "--resume"], "--resume", "--out")
        self.refuse(["tradeoff", "--report"], "--report", "--out")
        self.refuse(["tradeoff", "--report", "--out", "none"], "none", "No such file")
        self.refuse(["tradeoff", "--size", "0x9"], "--size 0x9")
        for size in ("1x1", "31x16", "32x15"):
            self.refuse(["tradeoff", "--quick", "--part", "light", "--size", size], "--size", size, "32x16")
        self.refuse(["tradeoff", "--write-front", "missing/f.json"], "missing", "cannot write")
        self.write("file", "")
        self.refuse(["tradeoff", "--out", "file"], "--out file")
        os.mkdir(self.path("folder"))
        self.write("folder/tradeoff.csv", "a,b\n1,2\n")
        self.refuse(["tradeoff", "--resume", "--out", "folder", "--scene", "lake"], "tradeoff.csv", "--resume")


if __name__ == "__main__":
    unittest.main()
