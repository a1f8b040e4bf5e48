#!/usr/bin/env python3
"""A plant through `linearize` into the controller `state_space` of another model: the same poles, the same response."""
import json
import re
import unittest
import zipfile

from run_case import RunCase

# Two carts on springs. The second model has them twice: as bodies and as a block with the same force.
CARTS = """\
floatframe: 1
bodies:
  a: {{position: [0, 0, 0], rigid: {{mass: 2}}}}
  b: {{position: [1, 0, 0], rigid: {{mass: 0.5}}}}
joints:
  ja: {{type: prismatic, child: a, at: [0, 0, 0], axis: x}}
  jb: {{type: prismatic, parent: a, child: b, at: [1, 0, 0], axis: x}}
{inputs}forces:
  ka: {{type: joint_spring, joint: ja, spring: 300, damper: 2}}
  kb: {{type: joint_spring, joint: jb, spring: 80, damper: 0.4}}
  push: {{type: force, body: b, direction: [1, 0, 0], magnitude: {push}}}
  pull: {{type: force, body: a, direction: [1, 0, 0], magnitude: {pull}}}
{controllers}outputs:
  xa: {{joint_position: ja}}
  vb: {{joint_velocity: jb}}
{outputs}simulation: {{step: 1.0e-3, duration: 2, spectral_radius: 0.9}}
"""
PLANT = CARTS.format(inputs="inputs: {push: {unit: N}, pull: {unit: N}}\n", push="{input: push}", pull="{input: pull}",
                     controllers="", outputs="")
BLOCK = """\
controllers:
  plant: {type: state_space, file: %s, initial: zero, inputs: %s}
"""
OUTPUTS = """\
  ya: {controller: plant, output: xa}
  yb: {controller: plant, output: 2}
  sum: {formula: "controller(plant, xa) + 3 * controller(plant, 'vb') - ya - 3 * yb"}
"""
FORCE = "{sine: {amplitude: 30, frequency: 1.5}}"


class StateSpaceFile(RunCase):
    def setUp(self):
        super().setUp()
        self.write("plant.yaml", PLANT)
        self.program("linearize", "plant.yaml", "--npz", "plant.npz", "--mat", "plant.mat")

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def model(self, name, block, outputs=OUTPUTS):
        self.write(name, CARTS.format(inputs="", push=FORCE, pull=0, controllers=block, outputs=outputs))

    def poles(self, name):
        modes = json.loads(self.program("modes", name, "--json").stdout)["modes"]
        return [complex(m["real_1_s"], m["imaginary_1_s"]) for m in modes]

    def test_poles_are_those_of_the_plant(self):
        expected = self.poles("plant.yaml")
        self.write("block.yaml", "floatframe: 1\nbodies: {rest: {position: [0, 0, 0], rigid: {mass: 1}}}\n"
                   "joints: {slide: {type: prismatic, child: rest, at: [0, 0, 0], axis: x}}\n"
                   + BLOCK % ("plant.mat", "[0, 0]") + "simulation: {step: 1e-3, duration: 1}\n")
        found = self.poles("block.yaml")
        self.assertEqual(len(expected), 2)
        for pole in expected:
            self.assertLess(min(abs(pole - other) for other in found), 1e-9 * abs(pole))

    def test_responses_are_those_of_the_plant(self):
        for file in ("plant.npz", "plant.mat"):
            for inputs in ("{push: %s}" % FORCE, "[%s, 0]" % FORCE):
                self.model("m.yaml", BLOCK % (file, inputs))
                worst = []
                for step in ("4e-3", "2e-3"):
                    self.program("run", "m.yaml", "--step", step, "--out", "out", "--overwrite", "--quiet", "--no-report")
                    lines = (self.folder / "out/results.csv").read_text().splitlines()
                    rows = [[float(x) for x in line.split(",")] for line in lines[1:]]
                    self.assertGreater(max(abs(row[1]) for row in rows), 0.01)
                    self.assertLess(max(abs(row[5]) for row in rows), 1e-13)
                    worst.append(max(max(abs(row[1] - row[3]), abs(row[2] - row[4])) for row in rows))
                print(f"[ figure ] {file}: differences from the plant {worst[0]:.2e}, {worst[1]:.2e}")
                self.assertTrue(worst[1] < 1e-12 or 3.5 < worst[0] / worst[1] < 4.5, worst)

    def test_wrong_files_are_one_sentence_each(self):
        content = (self.folder / "plant.npz").read_bytes()
        (self.folder / "short.npz").write_bytes(content[:300])
        (self.folder / "flipped.npz").write_bytes(content.replace(b"\x93NUMPY", b"\x93NUMPX"))
        (self.folder / "short.mat").write_bytes((self.folder / "plant.mat").read_bytes()[:200])
        (self.folder / "new.mat").write_bytes(b"MATLAB 7.3 MAT-file")
        self.write("text.npz", "A = 1\n")
        for name, left_out in (("without_a.npz", "A.npy"), ("without_c.npz", "C.npy")):
            with zipfile.ZipFile(self.folder / "plant.npz") as old, zipfile.ZipFile(self.folder / name, "w") as new:
                for member in old.namelist():
                    if member != left_out:
                        new.writestr(member, old.read(member))
        with zipfile.ZipFile(self.folder / "packed.npz", "w", zipfile.ZIP_DEFLATED) as new:
            new.writestr("A.npy", bytes(1000))
        both = "plant.npz, A: [[1]]"
        for file, inputs, sentence in (
                ("none.npz", "0", "'none.npz'"),
                ("text.npz", "0", "'text.npz': found neither an .npz nor a .mat file"),
                ("short.npz", "0", "'short.npz': "), ("flipped.npz", "0", "'flipped.npz': "),
                ("packed.npz", "0", "'packed.npz': "), ("short.mat", "0", "'short.mat': the MATLAB file is damaged"),
                ("new.mat", "0", "version 7.3"), ("without_a.npz", "0", "found no matrix A"),
                ("without_c.npz", "0", "found no matrix C"), ("[1]", "0", "a list of 1"),
                (both, "[0, 0]", "excludes 'A'"), ("plant.npz", "[0, 0, 0]", "found 3 signals, expected 2 for the inputs of the file: push, pull"),
                ("plant.npz", "{pusch: 0}", "found no input of this name in the file, did you mean 'push'?"),
                ("plant.npz", "{push: {input: nothing}}", "unknown input 'nothing'")):
            with self.subTest(file=file, inputs=inputs):
                self.model("m.yaml", BLOCK % (file, inputs), "")
                done = self.program("check", "m.yaml", code=2)
                self.assertRegex(done.stderr, r"\Am\.yaml:\d+:\d+: controllers\.plant[^\n]*\n\Z")
                self.assertIn(sentence, done.stderr)

    def test_unknown_outputs_are_named(self):
        for output, sentence in (("{controller: plant, output: xaa}", "found the output 'xaa', expected xa or vb, did you mean 'xa'?"),
                                 ("{controller: plant, output: 3}", "found the output '3', expected xa or vb"),
                                 ("{formula: \"controller(plant, 0)\"}", "found the output '0', expected xa or vb"),
                                 ("{formula: \"controller(plant)\"}", None)):
            self.model("m.yaml", BLOCK % ("plant.npz", "[0, 0]"), "  wrong: %s\n" % output)
            done = self.program("check", "m.yaml", code=2 if sentence else 0)
            self.assertIn(sentence or "", done.stderr)
            self.assertTrue(sentence is None or re.match(r"m\.yaml:\d+:\d+: outputs\.wrong", done.stderr), done.stderr)

    def test_saved_states_are_of_their_file(self):
        """Another file makes another model: its states are refused."""
        self.model("m.yaml", BLOCK % ("plant.npz", "[0, 0]"))
        self.program("run", "m.yaml", "--duration", "0.01", "--out", "out", "--quiet")
        files = self.summary("out")["model"]["files"] if isinstance(self.summary("out").get("model"), dict) else None
        header = json.dumps(self.summary("out"))
        self.assertIn("plant.npz", json.dumps(files) if files else header)


if __name__ == "__main__":
    unittest.main()
