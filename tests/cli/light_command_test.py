"""`tarn light`: the table and its CSV; sampled light has the mean of light found by chance; bad names."""
import csv
import io
import os
import unittest

from command import Case

SHORT = ["light", "--scenario", "cave,lamp-room,sky", "--rounds", "4", "--spp", "4"]


class Light(Case):
    def test_table_and_csv(self):
        text = self.succeed(*SHORT, "--out", "new/folder")
        self.assertEqual(os.listdir(self.path("new/folder")), ["light.csv"])
        rows = {(row["scenario"], row["strategy"]): row
                for row in csv.DictReader(io.StringIO(self.read("new/folder/light.csv").decode()))}
        self.assertEqual(set(rows), {("cave", "chance"), ("cave", "lights"), ("lamp-room", "chance"), ("lamp-room", "lights"), ("sky", "lights"), ("sky", "all")})
        for (scenario, strategy), row in rows.items():
            self.assertIn(scenario, text)
            self.assertIn(strategy, text)
            self.assertEqual(row["rejected"], "0")
            self.assertGreater(float(row["mean"]), 0)
            self.assertGreater(float(row["sample_ms"]), 0)
            self.assertLess(abs(float(row["off_by"])), 4)
        # 79 against 5, and 907 against 0.76, where they were measured at length.
        for scenario, factor in (("cave", 5), ("lamp-room", 50)):
            chance, lights = (float(rows[scenario, s]["relative_variance"]) for s in ("chance", "lights"))
            self.assertGreater(chance, factor * lights)

    def test_bad_names(self):
        self.refuse(["light", "--scenario", "moon"], "--scenario moon", "cave, lamp-room")
        self.refuse([*SHORT, "--rounds", "1"], "--rounds")
        self.refuse([*SHORT, "--set", "max_bounces=-1"], "max_bounces", "0 to 1024")
        for assignment in ("view=albedo", "light_sampling=none", "history=count", "quality=fast"):
            self.refuse([*SHORT, "--set", assignment], assignment, "strategies")
        self.write("file", "")
        self.refuse([*SHORT, "--out", "file"], "--out file")

    def test_help_lists_scenarios(self):
        text = self.succeed("light", "--help")
        for word in ("cave", "lamp-room", "lake-bed", "sky", "equal_time_gain", "Exit code 1"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
