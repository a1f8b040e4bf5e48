#!/usr/bin/env python3
"""floatframe stress: envelope, hot spots and section forces are those that gauges of the same run show."""
import csv
import io
import json
import pathlib
import unittest

from export_readers import read_npz
from run_case import RunCase

SHORT = ("--set", "duration=0.2", "--quiet", "--no-report")
FORCES = ("N", "Vy", "Vz", "T", "My", "Mz")


class Stress(RunCase):
    def setUp(self):
        super().setUp()
        self.program("run", "m.yaml", "--out", "out", *SHORT)

    def stress(self, *more):
        return json.loads(self.program("stress", "out", "--json", *more).stdout)

    def gauge(self, channel):
        """Time and values of a channel of the run."""
        rows = list(csv.reader(io.StringIO(self.program("outputs", "out", "--add", "g: " + channel).stdout)))[1:]
        return [float(row[0]) for row in rows], [float(row[1]) for row in rows]

    def refused(self, sentence, *arguments):
        said = self.program("stress", *arguments, code=2).stderr
        self.assertEqual(said.removeprefix("floatframe: "), sentence + "\n")

    def table(self, path):
        return list(csv.DictReader(io.StringIO((self.folder / path).read_text())))

    def test_envelope_is_the_largest_that_gauges_show(self):
        found = self.stress("--top", "3", "--out", "made")
        self.assertEqual((found["instants"], found["from_s"], found["to_s"]), (201, 0, 0.2))
        self.assertEqual([body["name"] for body in found["bodies"]], ["beam"])
        beam = found["bodies"][0]
        self.assertTrue(beam["inertia_loads"])
        spot = beam["hot_spots"][0]
        self.assertEqual(spot["node"], "#1")  # of a rod that swings x (1 - x)^2 is largest near a third
        self.assertFalse(spot["doubtful"])
        # A row of the table is where a gauge can be.
        toward = [b - a for a, b in zip((0.25, 0, 0), spot["position_m"])]
        time, values = self.gauge(f"{{stress: {{body: beam, node: '#1', toward: {toward}}}, component: von_mises}}")
        self.assertAlmostEqual(max(values) / spot["von_mises_Pa"], 1, 12)
        self.assertAlmostEqual(max(map(abs, spot["principal_Pa"])) / spot["von_mises_Pa"], 1, 2)
        # The end at p is that of one element: eight points of its outline, a gauge for each.
        arrays = read_npz(self.folder / "made/envelope.npz")
        places = [k for k, node in enumerate(arrays["beam/nodes"].values) if node == "p"]
        self.assertEqual(len(places), 8)
        expected = [(arrays["beam/von_mises"].values[k], arrays["beam/time"].values[k]) for k in places]
        around = ([0, 0, 1], [0, 0, -1], [0, 1, 0], [0, -1, 0], [0, 1, 1], [0, 1, -1], [0, -1, 1], [0, -1, -1])
        shown = []
        for toward in around:
            time, values = self.gauge(f"{{stress: {{body: beam, node: p, toward: {toward}}}, component: von_mises}}")
            shown.append((max(values), time[values.index(max(values))]))
        self.assertGreater(min(shown)[0], 0)
        for (a, when_a), (b, when_b) in zip(sorted(shown), sorted(expected), strict=True):
            self.assertAlmostEqual(a / b, 1, 12)
            self.assertEqual(when_a, when_b)
        self.assertEqual([peak["force"] for peak in beam["section_forces"]], list(FORCES))
        self.assertEqual(arrays["beam/section_nodes"].values[0], "p")
        for force in ("N", "Vz", "Vy"):
            _, values = self.gauge(f"{{section_force: {{body: beam, node: p}}, component: {force}}}")
            scale = max(map(abs, values))
            for name, value in (("largest", max(values)), ("least", min(values))):
                self.assertAlmostEqual(arrays["beam/section_" + name].row(0)[FORCES.index(force)] / scale, value / scale, 12)

    def test_files_hold_every_place(self):
        text = self.program("stress", "out", "--out", "folder/made").stdout
        self.assertIn("body 'beam', 64 places\n", text)
        self.assertIn("von Mises [MPa]", text)
        arrays = read_npz(self.folder / "folder/made/envelope.npz")
        self.assertEqual(arrays["bodies"].values, ["beam"])
        self.assertEqual(arrays["beam/von_mises"].shape, (64,))
        self.assertEqual(arrays["beam/stress"].shape, (64, 6))
        self.assertEqual(set(arrays["beam/layers"].values), {"section"})
        self.assertEqual(arrays["beam/section_largest"].shape, (8, 6))
        spots = self.table("folder/made/hot_spots.csv")
        values = list(arrays["beam/von_mises"].values)
        self.assertEqual(float(spots[0]["von Mises [Pa]"]), max(values))
        place = int(spots[0]["place"])
        self.assertEqual(values[place], max(values))
        self.assertEqual(float(spots[0]["time [s]"]), arrays["beam/time"].values[place])
        self.assertEqual(arrays["beam/nodes"].values[place], spots[0]["node"])
        s = arrays["beam/stress"].row(place)
        again = (0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3 * sum(x * x for x in s[3:])) ** 0.5
        self.assertAlmostEqual(again / max(values), 1, 12)
        forces = self.table("folder/made/section_forces.csv")
        self.assertEqual(len(forces), 8 * 6)
        for k, row in enumerate(forces):
            self.assertEqual(row["force"], FORCES[k % 6])
            self.assertEqual(float(row["largest"]), arrays["beam/section_largest"].row(k // 6)[k % 6])
            self.assertEqual(float(row["smallest"]), arrays["beam/section_least"].row(k // 6)[k % 6])
            self.assertLessEqual(float(row["smallest"]), float(row["largest"]))

    def test_mirrored_parts_of_a_symmetric_vehicle(self):
        """Left and right of the Iltis on stairs across its whole width: equal stress, mirrored section forces."""
        model = str(pathlib.Path(__file__).resolve().parents[2] / "examples/iltis/iltis.yaml")
        self.program("run", model, "--out", "iltis", "--set", "duration=4.4", "--quiet", "--no-report")
        self.program("stress", "iltis", "--out", "made")
        arrays = read_npz(self.folder / "made/envelope.npz")
        self.assertEqual(len(arrays["bodies"].values), 12)
        for left in arrays["bodies"].values:
            if "left" not in left:
                continue
            right = left.replace("left", "right")
            a, b = (list(arrays[side + "/von_mises"].values) for side in (left, right))
            self.assertGreater(max(a), 1e6)
            self.assertLess(max(abs(x - y) for x, y in zip(a, b, strict=True)), 1e-6 * max(a))
            most, least, other, fewest = (arrays[f"{side}/section_{name}"] for side in (left, right) for name in ("largest", "least"))
            # Local axes are mirrored and made right-handed by turning z back.
            for c, sign in enumerate((1, 1, -1, -1, -1, 1)):
                scale = max(abs(most.row(k)[c]) for k in range(most.shape[0])) + 1
                for k in range(most.shape[0]):
                    expected = other.row(k)[c] if sign > 0 else -fewest.row(k)[c]
                    self.assertLess(abs(most.row(k)[c] - expected), 1e-6 * scale)

    def test_a_part_of_the_run(self):
        whole = self.stress()["bodies"][0]["hot_spots"][0]
        found = self.stress("--from", "0.05", "--to", "0.1", "--every", "10", "--body", "beam")
        self.assertEqual((found["instants"], found["from_s"], found["to_s"]), (6, 0.05, 0.1))
        part = found["bodies"][0]["hot_spots"][0]
        self.assertLessEqual(part["von_mises_Pa"], whole["von_mises_Pa"])
        self.assertTrue(0.05 <= part["time_s"] <= 0.1)
        self.assertEqual(self.stress("--top", "0")["bodies"][0]["hot_spots"], [])

    def test_what_has_no_stress_is_said_in_one_sentence(self):
        self.refused("--body: body 'slider' is rigid and has no stress, expected a flexible body with stress", "out",
                     "--body", "slider")
        self.refused("--body: found 'beem', expected a body of the model, did you mean 'beam'?", "out", "--body", "beem")
        self.refused("found --from 2 after --to 1, expected an earlier time", "out", "--from", "2", "--to", "1")
        rigid = "floatframe: 1\nbodies:\n  stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}\njoints:\n" \
                "  loose: {type: free, child: stone, at: [0, 0, 0]}\nsimulation: {step: 0.01, duration: 0.1}\n"
        (self.folder / "rigid.yaml").write_text(rigid)
        self.program("run", "rigid.yaml", "--out", "stone", "--quiet", "--no-report")
        self.refused("stone/states.ffr: found no body with stress data, expected a flexible body of bars, or a part reduced "
                     "with stresses", "stone")


if __name__ == "__main__":
    unittest.main()
