#!/usr/bin/env python3
"""Small things that commands share: --set of options, one value of --vary, cells of tables, distances of checkpoints."""
import json
import os
import pathlib
import shutil
import unittest
import zipfile

from run_case import MODEL, RunCase

DATA = pathlib.Path(os.environ.get("FLOATFRAME_TEST_DATA") or pathlib.Path(__file__).resolve().parents[1] / "data")
PART = """\
floatframe: 1
name: part
bodies:
  beam:
    part: {file: beam_b31_free.inp, units: mm-t-s, interfaces: {A: {set: END_A}, B: {set: END_B}}, modes: 2}
joints: {root: {type: revolute, child: beam, child_node: A, axis: y}}
"""

class SmallHabits(RunCase):
    def test_run_sets_what_sweep_sets(self):
        options = {"step": "0.002", "duration": "0.1", "coordinates": "absolute", "inertia": "projection",
                   "output_interval": "0.004", "spectral_radius": "0.8", "tolerance": "1e-8", "simulation.max_iterations": "20"}
        model = self.folder / "m.yaml"
        model.write_text(MODEL.replace("duration: 1000}", "speed: 20}").replace('"${duration}"', "1000"))
        settings = [word for name, value in options.items() for word in ("--set", f"{name}={value}")]
        self.program("sweep", "m.yaml", "--vary", "mass=1,2", *settings, "--keep-results", "--out", "study", "--quiet")
        self.program("run", "m.yaml", *settings, "--set", "mass=2", "--out", "run", "--quiet")
        self.assertEqual((self.folder / "study/runs/2/results.csv").read_bytes(), (self.folder / "run/results.csv").read_bytes())
        summary = self.summary("run")
        self.assertEqual((summary["step_s"], summary["coordinates"], summary["inertia"]), (0.002, "absolute", "projection"))
        self.assertEqual(summary["settings"]["step"], "0.002")
        # The states of such a run are read with the same settings; options of the command line are stronger.
        self.program("export", "run", "--csv", "motion.csv")
        self.program("run", "m.yaml", "--set", "duration=0.1", "--set", "step=0.002", "--step", "0.001", "--out", "run", "--quiet")
        self.assertEqual(self.summary("run")["step_s"], 0.001)

    def test_a_parameter_is_stronger_than_an_option_of_its_name(self):
        self.program("run", "m.yaml", "--set", "duration=0.05", "--set", "simulation.step=0.002", "--out", "run", "--quiet")
        self.assertEqual((self.summary("run")["duration_s"], self.summary("run")["step_s"]), (0.05, 0.002))

    def test_settings_that_are_refused(self):
        for setting, message in (("step=-1", "--set: step: found '-1', expected "), ("stepp=1", "stepp"),
                                 ("coordinates=polar", "--set: coordinates: found 'polar', expected relative or absolute"),
                                 ("simulation.nothing=1", "simulation.nothing"), ("step=1e-300", "1e+09 steps")):
            done = self.program("run", "m.yaml", "--set", setting, "--out", "run", code=2)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_one_value_of_a_range(self):
        self.program("sweep", "m.yaml", "--vary", "mass=3:6:1", "--set", "duration=0.02", "--out", "study", "--quiet")
        lines = (self.folder / "study/sweep.csv").read_text().splitlines()
        self.assertEqual([line.split(",")[:2] for line in lines[1:]], [["1", "3"]])

    def test_titles_are_no_formulas(self):
        text = MODEL.replace("  drive: {joint_position", "  \"=1+cmd|' /C calc'!A0\": {joint_position").replace(
            "  spin: {joint_position", '  "@sum": {joint_position')
        (self.folder / "m.yaml").write_text(text)
        done = self.program("run", "m.yaml", "--set", "duration=0.02", "--out", "run", "--quiet", code=None)
        if done.returncode == 2:  # such names may be refused as well
            self.assertIn("expected", done.stderr)
            return
        header = (self.folder / "run/results.csv").read_text().split("\n")[0].split(",")
        self.assertEqual(header[1:3], ["'=1+cmd|' /C calc'!A0 [rad]", "'@sum [rad]"])
        self.assertIn("@sum", self.program("rainflow", "run", "--channel", "@sum").stdout)
        self.program("compare", "run", "run", "--channel", "@sum", "--tolerance", "0")

    def test_checkpoints_behind_the_end(self):
        for every in ("1e300", "1e308", "0.051"):
            self.program("run", "m.yaml", "--set", "duration=0.05", "--checkpoint-every", every, "--out", "far", "--quiet")
        self.program("run", "m.yaml", "--set", "duration=0.05", "--out", "near", "--quiet")
        self.same_files("far", "near")
        process = self.begin("run", "m.yaml", "--checkpoint-every", "1e300", "--out", "long")
        self.wait_for(self.has_rows("long", 2000), process)
        self.assertFalse((self.folder / "long/run.checkpoint").exists())
        process.kill()

    def test_no_change_of_frequencies(self):
        data = json.loads(self.program("advise", "m.yaml", "--set", "duration=0.05", "--below", "1000", "--frequency-error", "0",
                                       "--json").stdout)
        self.assertEqual(data["tolerance"], 0)

    def test_entries_of_the_cache_are_known_by_their_content(self):
        for name in ("beam_b31_free.inp", "beam_b31_mesh.inp"):
            shutil.copy(DATA / "fe" / name, self.folder)
        (self.folder / "part.yaml").write_text(PART)
        self.assertIn("reduced to", self.program("check", "part.yaml").stderr)
        self.assertIn("from the cache", self.program("check", "part.yaml").stderr)
        kept, = (self.folder / ".floatframe-cache").glob("*.ffb")
        # Packed again with other numbers: every checksum of the archive is right.
        with zipfile.ZipFile(kept) as archive:
            members = [(i, archive.read(i)) for i in archive.infolist()]
            comment = archive.comment
        with zipfile.ZipFile(kept, "w") as archive:
            archive.comment = comment
            for info, content in members:
                if info.filename == "surface_positions.npy":  # the last bit of one number
                    content = content[:-8] + bytes([content[-8] ^ 1]) + content[-7:]
                archive.writestr(info, content)
        again = self.program("check", "part.yaml").stderr
        self.assertIn("what was kept cannot be read: ", again)
        self.assertIn("content is not", again)
        self.assertIn("reduced to", again)
        self.assertIn("from the cache", self.program("check", "part.yaml").stderr)


if __name__ == "__main__":
    unittest.main()
