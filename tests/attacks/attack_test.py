#!/usr/bin/env python3
"""Hostile models, results, decks, command lines, signals and limits: the program ends within a minute and 4 GB, with a result
or an error message, and existing files are unchanged. The number of attacks: see attack_case.py."""
import json
import math
import pathlib
import re
import resource
import shutil
import signal
import tempfile
import unittest

import hostile
from attack_case import BINARY, DATA, EXAMPLES, AttackCase

CHAIN = """\
floatframe: 1
name: attacked
parameters: {mass: 1, length: 0.5}
points: {o: [0, 0, 0], p: ["${length}", 0, 0], t: [1.1, 0, 0]}
bodies:
  arm: {rigid: {mass: "${mass}", centre_of_mass: [0.25, 0, 0], inertia: [0.001, 0.02, 0.02]}}
  beam:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: t, elements: 4, section: {round: 0.01}}}
      clamped: [p]
      static_modes: [{point: t, dofs: [y, z]}]
      normal_modes: 2
      damping: 0.01
joints:
  a: {type: revolute, child: arm, at: o, axis: y, position: 0.2}
  b: {type: revolute, parent: arm, child: beam, at: p, axis: y}
rods:
  tie: {from: {body: beam, node: t}, to: {body: ground, at: [1.1, 0, 0.6]}}
forces:
  spring: {type: spring_damper, from: {body: ground, at: [0, 0, 1]}, to: {body: arm, at: p}, spring: {linear: {stiffness: 500, free: 1.0}}, damper: {linear: {stiffness: 5}}}
outputs:
  tip: {position: {body: beam, node: t}}
  hinge: {joint_force: a}
simulation: {step: 1.0e-3, duration: 0.05}
"""
GOOD = [CHAIN] + [path.read_text(encoding="utf-8") for path in (
    EXAMPLES / "slider_crank/slider_crank.yaml", EXAMPLES / "flexible_pendulum/flexible_pendulum.yaml",
    EXAMPLES / "spin_up/spin_up.yaml", EXAMPLES / "quarter_car/quarter_car.yaml", EXAMPLES / "rotor/rotor.yaml")]
SHORT = ("--step", "1e-3", "--duration", "0.02", "--quiet")
OF_MODELS = (("check",), ("statics",), ("modes",), ("linearize",), ("mass",), ("run", *SHORT, "--out", "out"),
             ("run", *SHORT, "--out", "out", "--coordinates", "absolute"), ("response",),
             ("advise", "--step", "1e-3", "--duration", "0.02", "--repeat", "1"))
FREE = ("--units", "m-kg-s", "--method", "free_free", "--modes", "3")
WITH_MATERIAL = ("--material", "2e11,0.3,7800", *FREE)
DECKS = {"b33_shaft.inp": FREE, "two_bricks.inp": FREE, "bricks.msh": WITH_MATERIAL, "bricks_bin.msh.gz": WITH_MATERIAL,
         "bricks.bdf.gz": WITH_MATERIAL, "classical.SID_FEM": None,
         **dict.fromkeys(("beam_superelement.pch", "beam_superelement.op4"),
                         ("--units", "m-kg-s", "--interface", "a=node:1", "--interface", "b=node:2", "--modes", "0"))}
OF_RESULTS = (("export", "run", "--csv", "x.csv"), ("export", "run", "--glb", "x.glb"), ("export", "run", "--vtk", "x"),
              ("export", "run", "--npz", "x.npz", "--stress"), ("stress", "run", "--out", "x"), ("compare", "run", "run"),
              ("outputs", "run", "--add", "e: {position: arm}", "--out", "x.csv"), ("rainflow", "run", "--out", "x"),
              ("run", "m.yaml", "--out", "run", "--quiet"))
SHAFT = ("reduce", "b33_shaft.inp", *FREE, "-o", "out.ffb", "--quiet")
LONG = (("run", "m.yaml", "--duration", "20", "--out", "out", "--checkpoint-every", "0.5", "--quiet"),
        ("sweep", "m.yaml", "--vary", "mass=1:2:40", "--duration", "0.3", "--out", "out", "--quiet"),
        ("statics", "m.yaml", "--write-state", "out"), ("advise", "m.yaml"), SHAFT)
UNDER_LIMITS = (("run", "m.yaml", "--out", "out", "--quiet"), ("modes", "m.yaml"), ("linearize", "m.yaml", "--npz", "out.npz"),
                ("sweep", "m.yaml", "--vary", "mass=1,2,3", "--out", "out", "--quiet"), ("statics", "m.yaml"), SHAFT)


def of_deck(name):
    commands = [("info", name)]
    if DECKS[name]:
        commands.append(("reduce", name, *DECKS[name], "-o", "x.ffb", "--quiet"))
        if "superelement" not in name:
            commands.append(("convert", name, "x.vtu"))
    return commands


def is_positive(text):
    try:
        return 0.0 < float(text) < math.inf
    except ValueError:
        return False


class Attacks(AttackCase):
    def test_without_attacks_all_is_valid(self):
        """An attack on what fails anyway would test little."""
        made = self.made_run()
        shutil.copy(DATA / "fe" / "b33_shaft.inp", made)
        for command in (*OF_RESULTS, *LONG, *UNDER_LIMITS):
            for left in made.glob("out*"):
                shutil.rmtree(left) if left.is_dir() else left.unlink()
            code, _, err = self.attack(made, *command, own=("x", "out", "run"))
            self.assertEqual(code, 0, f"{command}: {err}")
        for name in DECKS:
            shutil.copy(DATA / "fe" / name, made)
            for command in of_deck(name):
                code, _, err = self.attack(made, *command, "--overwrite", own=("x",)) if command[0] != "info" else \
                    self.attack(made, *command)
                self.assertEqual(code, 0, f"{command}: {err}")
        for good in GOOD:
            (made / "good.yaml").write_text(good, encoding="utf-8")
            code, _, err = self.attack(made, "check", "good.yaml")
            self.assertEqual(code, 0, err)

    def test_models(self):
        def one(random, folder):
            (folder / "m.yaml").write_text(hostile.text(random, random.choice(GOOD)), encoding="utf-8")
            command, *options = random.choice(OF_MODELS)
            self.attack(folder, command, "m.yaml", *options, own=("out",))

        self.attacks("models", one)

    def made_run(self):
        """A folder with a model and its run."""
        made = pathlib.Path(tempfile.mkdtemp(prefix="floatframe_attack_"))
        self.addCleanup(shutil.rmtree, made, ignore_errors=True)
        (made / "m.yaml").write_text(CHAIN)
        code, _, err = self.attack(made, "run", "m.yaml", "--out", "run", "--quiet", own=("run",))
        self.assertEqual(code, 0, err)
        return made

    def test_results(self):
        made = self.made_run()

        def one(random, folder):
            shutil.copytree(made, folder, dirs_exist_ok=True)
            attacked = random.choice(sorted((folder / "run").iterdir()))
            attacked.write_bytes(hostile.data(random, attacked.read_bytes()))
            command = random.choice(OF_RESULTS)
            self.attack(folder, *command, own=("x", "run/") if command[0] == "run" else ("x",))

        self.attacks("results", one)

    def test_decks(self):
        def one(random, folder):
            name = random.choice(sorted(DECKS))
            good = (DATA / "fe" / name).read_bytes()
            packed = name.endswith((".gz", ".op4"))
            if name.endswith(".op4"):  # its nodes
                shutil.copy(DATA / "fe" / "beam_superelement.pch", folder)
            (folder / name).write_bytes(hostile.data(random, good) if packed or random.random() < 0.2 else
                                        hostile.text(random, good.decode("latin-1")).encode("utf-8"))
            command = random.choice(of_deck(name))
            self.attack(folder, *command, own=("x",))

        self.attacks("decks", one)

    def test_command_lines(self):
        nowhere = pathlib.Path(tempfile.mkdtemp(prefix="floatframe_attack_"))
        self.addCleanup(shutil.rmtree, nowhere, ignore_errors=True)
        options = self.options_of_commands(nowhere)

        def one(random, folder):
            (folder / "m.yaml").write_text(CHAIN)
            command = random.choice(sorted(options))
            words = [command, "m.yaml"] if random.random() < 0.9 else [command]
            for _ in range(random.randint(1, 3)):
                name, takes_value = random.choice(options[command])
                words.append(name)
                if takes_value or random.random() < 0.1:
                    value = random.choice((*hostile.NUMBERS, "out", "m.yaml", "/dev/null", "mass=2", "mass=1:2:3", "0.01,0.02",
                                           "tip", "arm", "x" * 3000, "мост"))
                    # A million seconds in steps of a microsecond take as long as was asked for.
                    words.append("0.02" if name in ("--at", "--duration", "--step") and is_positive(value) else value)
            self.attack(folder, *words, own=("out", "x", "nan", "inf", "мост", "mass", "true", "tip", "arm"))

        self.attacks("command lines", one)

    def options_of_commands(self, folder):
        """name -> (option, whether it takes a value), from the help; what serves or shows pages is left out."""
        _, text, _ = self.attack(folder, "--help")
        found = {}
        for command in re.findall(r"^  ([a-z]+) ", text, re.M):
            if command in ("bench", "realtime", "view"):
                continue
            _, text, _ = self.attack(folder, command, "--help")
            names = re.findall(r"^ +(?:-\w, ?)?(--[a-z-]+)( [A-Z])?", text, re.M)
            names = [(name, bool(value)) for name, value in names if name != "--help"]
            if names:
                found[command] = names
        self.assertGreater(len(found), 10, text)
        return found

    def test_signals(self):
        def one(random, folder):
            (folder / "m.yaml").write_text(CHAIN)
            shutil.copy(DATA / "fe" / "b33_shaft.inp", folder)
            command = random.choice(LONG)
            number = random.choice((signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU))
            code, _, err = self.attack(folder, *command, signals=((random.uniform(0.0, 0.6), number),), own=("out",))
            summary = folder / "out" / "summary.json"
            if command[0] == "run" and summary.exists():
                status = json.loads(summary.read_text())["status"]
                self.assertIn(status, ("completed", "interrupted", "running"), err)
                self.assertEqual(status == "completed", code == 0, err)
                if (folder / "out" / "states.ffr").exists():
                    self.attack(folder, "export", "out", "--csv", "x.csv", own=("x",))
                if (folder / "out" / "run.checkpoint").exists():
                    code, _, err = self.attack(folder, "run", "m.yaml", "--duration", "20", "--out", "out", "--quiet", own=("out",))
                    self.assertNotEqual(code, 0)
                    self.assertIn("--resume", err)

        self.attacks("signals", one)

    def test_limits(self):
        def one(random, folder):
            (folder / "m.yaml").write_text(CHAIN)
            shutil.copy(DATA / "fe" / "b33_shaft.inp", folder)
            command = random.choice(UNDER_LIMITS)
            which, sizes = random.choice((
                (resource.RLIMIT_AS, [m << 20 for m in (60, 100, 150, 250, 400, 800)]), (resource.RLIMIT_FSIZE, (0, 1000, 30000)),
                (resource.RLIMIT_NOFILE, (4, 6, 10, 20)), (resource.RLIMIT_STACK, [k << 10 for k in (64, 128, 256)])))
            self.attack(folder, *command, limits=((which, random.choice(sizes)),), own=("out",))

        self.attacks("limits", one)


if __name__ == "__main__":
    print(BINARY)
    unittest.main()
