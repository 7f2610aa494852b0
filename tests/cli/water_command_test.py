"""`tarn water`: the table, its CSV and plot, on the GPU and the reference; bad names."""
import csv
import io
import os
import unittest
import xml.dom.minidom

from command import Case

SHORT = ["water", "--tier", "block", "--scenario", "tap,blob", "--ticks", "30"]
COST = "ms_per_tick"


class Water(Case):
    def rows(self, path):
        return list(csv.DictReader(io.StringIO(self.read(path).decode())))

    def test_table_csv_and_plot(self):
        text = self.succeed(*SHORT, "--seeds", "2", "--out", "new/folder")
        self.assertEqual(sorted(os.listdir(self.path("new/folder"))), ["water.csv", "water.svg"])
        self.assertIn("tier block, 2 seeds", text)
        rows = {(row["scenario"], row["figure"]): row for row in self.rows("new/folder/water.csv")}
        self.assertEqual({key[0] for key in rows}, {"tap", "blob"})
        for row in rows.values():
            self.assertEqual(row["tier"], "block")
            self.assertEqual(len(row["values"].split()), 2)
            self.assertIn(row["figure"], text)
        self.assertEqual(float(rows["tap", "ticks"]["worst"]), 30)
        self.assertEqual(rows["blob", "at_rest_from_tick"]["worst"], "inf")
        # 30 ticks of a tap of 2x2 into an arm of 64 columns that stands at 10, all of it counted.
        self.assertGreater(float(rows["tap", "left_arm_vox"]["typical"]), 10)
        self.assertEqual(float(rows["tap", "right_arm_vox"]["typical"]), 10)
        for scenario in ("tap", "blob"):
            self.assertEqual((rows[scenario, "mass_off"]["values"], rows[scenario, "mass_off"]["verdict"]),
                             ("0 0", "pass"))
            self.assertGreater(float(rows[scenario, COST]["typical"]), 0)
        plot = xml.dom.minidom.parseString(self.read("new/folder/water.svg"))
        self.assertEqual(len(plot.getElementsByTagName("polyline")), 2)

    def test_the_reference_gives_the_same_figures(self):
        run = ["water", "--scenario", "tap,blob", "--ticks", "30"]  # of every tier
        self.succeed(*run, "--out", "gpu")
        self.succeed(*run, "--out", "cpu", "--reference")
        self.succeed(*run, "--out", "awake", "--awake")
        self.succeed(*run, "--out", "other", "--set", "film_threshold=9")

        def figures(folder):
            return [row for row in self.rows(folder + "/water.csv")
                    if row["figure"] not in (COST, "active_bricks")]
        self.assertEqual({row["tier"] for row in figures("gpu")}, {"block", "level", "pressure"})
        self.assertEqual(figures("gpu"), figures("cpu"))
        self.assertEqual(figures("gpu"), figures("awake"))
        self.assertNotEqual(figures("gpu"), figures("other"))

    def test_bad_names(self):
        self.refuse(["water", "--tier", "wet"], "--tier wet", "block")
        self.refuse(["water", "--tier", "block,"], "--tier", "block")
        self.refuse(["water", "--scenario", "dam,moat"], "--scenario moat", "dam, blob, spill", "bigdam")
        for option in ("--seeds", "--ticks"):
            for value in ("0", "-1", "nan", "1.5"):
                self.refuse(["water", f"{option}={value}"], option)
        self.refuse([*SHORT, "--set", "film_threshold=0"], "film_threshold", "1 to 16")
        self.write("file", "")
        self.refuse([*SHORT, "--out", "file"], "--out file")
        self.refuse([*SHORT, "--out", "file/folder"], "--out file/folder")

    def test_help_lists_tiers_and_scenarios(self):
        text = self.succeed("water", "--help")
        for word in ("block", "dam", "tall-arm", "shafts", "--reference", "--awake", "Exit code 1"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
