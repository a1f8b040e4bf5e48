#!/usr/bin/env python3
"""floatframe export: what the files of other programs hold is what the solver says, and nothing is half written."""
import csv
import io
import math
import os
import resource
import signal
import time
import unittest

from export_readers import Glb, node_points, read_npz, read_pvd, read_table, read_vtu, rotated
from run_case import RunCase

SHORT = ("--set", "duration=0.2", "--quiet", "--no-report")
ROD = """\
floatframe: 1
gravity: [0, 0, 0]
points: {p: [0, 0, 0], tip: [0.6, 0, 0]}
bodies:
  rod:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 6, section: {rectangle: [0.02, 0.01]}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
joints:
  drive: {type: revolute, child: rod, at: p, axis: z, motion: {polynomial: [0.3, 20]}}
simulation: {step: 1.0e-3, duration: 0.05}
"""
# A strip of two materials with a beam at its end, turning and hanging.
STRIP = """\
floatframe: 1
gravity: [0, 0, -20]
bodies:
  strip:
    position: [1, 2, 3]
    orientation: [0, 0, 0.7]
    part:
      file: strip.inp
      units: m-kg-s
      interfaces: {ROOT: {set: ROOT}, TIP: {set: TIP}}
      reference: {node: ROOT}
      modes: 4
joints:
  drive: {type: revolute, child: strip, child_node: ROOT, at: [1, 2, 3], axis: z, motion: {polynomial: [0.3, 5]}}
simulation: {step: 1.0e-3, duration: 0.02}
"""


def strip():
    """8 x 2 four-node shells and a beam, as Abaqus writes them."""
    number = lambda i, j: 1 + 3 * i + j
    lines = ["*NODE,NSET=NALL"]
    lines += [f"{number(i, j)}, {0.05 * i}, {0.025 * (j - 1)}, 0." for i in range(9) for j in range(3)]
    lines.append("1000, 0.5, 0., 0.")
    for half, first in (("LEFT", 0), ("RIGHT", 4)):
        lines.append(f"*ELEMENT,TYPE=S4,ELSET={half}")
        lines += [f"{1 + 2 * i + j}, {number(i, j)}, {number(i + 1, j)}, {number(i + 1, j + 1)}, {number(i, j + 1)}"
                  for i in range(first, first + 4) for j in range(2)]
    return "\n".join(lines + [
        "*ELEMENT,TYPE=B31,ELSET=BAR", f"100, {number(8, 1)}, 1000", "*NSET,NSET=ROOT", " 1, 2, 3", "*NSET,NSET=TIP", " 1000",
        "*MATERIAL,NAME=STEEL", "*ELASTIC", "2.1e11, 0.3", "*DENSITY", "7850.",
        "*MATERIAL,NAME=ALU", "*ELASTIC", "7e10, 0.3", "*DENSITY", "2700.",
        "*SHELL SECTION,ELSET=LEFT,MATERIAL=STEEL", "0.002", "*SHELL SECTION,ELSET=RIGHT,MATERIAL=ALU", "0.002",
        "*BEAM SECTION,ELSET=BAR,MATERIAL=STEEL,SECTION=RECT", "0.01,0.006", "0.,1.,0."]) + "\n"


def von_mises(s):
    return math.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3 * (s[3] ** 2 + s[4] ** 2 + s[5] ** 2))


STIFF = "    geometric_stiffening: true\n"


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b, strict=True))


class Export(RunCase):
    def run_model(self, *more, out="out"):
        self.program("run", "m.yaml", "--out", out, *SHORT, *more)

    def outputs(self, *channels, out="out"):
        """Rows of numbers, time first."""
        added = [word for channel in channels for word in ("--add", channel)]
        table = list(csv.reader(io.StringIO(self.program("outputs", out, *added).stdout)))
        return [[float(x) for x in row] for row in table[1:]]

    def refused(self, sentence, *arguments, code=2):
        said = self.program("export", *arguments, code=code).stderr
        self.assertEqual(said.removeprefix("floatframe: "), sentence + "\n")

    def test_every_file_says_what_the_solver_says(self):
        (self.folder / "m.yaml").write_text((self.folder / "m.yaml").read_text().replace("joints:\n", STIFF + "joints:\n"))
        for coordinates in ("relative", "absolute"):
            self.run_model("--coordinates", coordinates)
            said = self.program("export", "out", "--vtk", "vtk", "--glb", "m.glb", "--npz", "m.npz", "--csv", "m.csv").stderr
            self.assertEqual(said.splitlines()[0], "vtk/motion.pvd: 201 instants, 4 bodies, 306 points")
            rows = self.outputs("p: {position: {body: beam, node: tip}}", "v: {velocity: {body: beam, node: tip}}",
                                "s: {position: slider}", "w: {angular_velocity: crank}", "a: {acceleration: slider}",
                                "y1: {modal_amplitude: beam, mode: 1}", "yd4: {modal_rate: beam, mode: 4}",
                                "ydd4: {modal_acceleration: beam, mode: 4}", "aa: {angular_acceleration: crank}",
                                "q: {rotation: disc}")
            self.assertEqual(len(rows), 201)
            self.vtk_is(rows)
            self.glb_is(rows)
            self.npz_is(rows)
            self.table_is(rows)

    def vtk_is(self, rows):
        index = read_pvd(self.folder / "vtk/motion.pvd")
        self.assertEqual([t for t, _ in index], [row[0] for row in rows])
        self.assertEqual(sorted(name for _, name in index),
                         sorted(path.name for path in (self.folder / "vtk").glob("*.vtu")))
        first = None
        for row, (t, name) in list(zip(rows, index))[::20]:
            grid = read_vtu(self.folder / "vtk" / name)
            self.assertEqual(grid["time"], t)
            self.assertEqual(grid["texts"]["body_names"], ["crank", "slider", "disc", "beam"])
            tip = node_points(grid, "beam")["tip"]
            self.assertLess(distance(grid["points"][tip], row[1:4]), 1e-12)
            self.assertLess(distance(grid["point"]["velocity"][tip], row[4:7]), 1e-6)
            # The design pose of the beam is straight along x: displacement = position - (0.6, 1, 0).
            moved = [a - b for a, b in zip(row[1:4], (0.6, 1.0, 0.0))]
            self.assertLess(distance(grid["point"]["displacement"][tip], moved), 1e-12)
            first = first or grid
            self.assertEqual(grid["cells"], first["cells"])
            # The box of the slider about its centre of mass, where its frame is.
            slider = [p for p, body in zip(grid["points"], grid["point"]["body"]) if body == 1]
            self.assertEqual(len(slider), 8)
            middle = [sum(p[c] for p in slider) / 8 for c in range(3)]
            self.assertLess(distance(middle, row[7:10]), 1e-12)
        # Sections stay about their nodes: the first ring of the beam, drawn as triangles of origin "bars".
        kinds = {kind for kind, _ in first["cells"]}
        self.assertEqual(kinds, {1, 5})
        self.assertEqual(sorted(set(first["cell"]["drawn"])), [1, 2, 4])

    def glb_is(self, rows):
        scene = Glb(self.folder / "m.glb")
        self.assertEqual(len(scene.times), 201)
        for t, row in zip(scene.times, rows):
            self.assertAlmostEqual(t, row[0], 6)
        tip = scene.named("beam").index("tip")
        worst = max(distance(scene.points("beam", k)[tip], rows[k][1:4]) for k in range(201))
        self.assertLess(worst, 1e-6)
        self.assertGreater(max(abs(row[13]) for row in rows), 0.0)
        weights = [x for (_, path), track in scene.tracks.items() if path == "weights" for x in track]
        self.assertGreaterEqual(min(weights), 0.0)  # Blender cuts others off
        self.assertEqual(max(weights), 1.0)
        for (_, path), track in scene.tracks.items():
            if path != "rotation":
                continue
            for q, following in zip(track, track[1:]):
                self.assertAlmostEqual(sum(x * x for x in q), 1.0, 6)
                self.assertGreater(sum(a * b for a, b in zip(q, following)), 0.0)
        low = min(p[1] for p in scene.numbers(scene.primitive("disc", 4)["attributes"]["POSITION"]))
        self.assertEqual(scene.json["accessors"][scene.primitive("disc", 4)["attributes"]["POSITION"]]["min"][1], low)
        # No gravity in this model: z is up, and the node of the whole turns it to y.
        self.assertLess(distance(scene.json["nodes"][0]["rotation"], (-0.5 ** 0.5, 0, 0, 0.5 ** 0.5)), 1e-12)

    def npz_is(self, rows):
        arrays = read_npz(self.folder / "m.npz")
        self.assertEqual(list(arrays["time"].values), [row[0] for row in rows])
        self.assertEqual(arrays["bodies"].values, ["crank", "slider", "disc", "beam"])
        tip = arrays["beam/nodes"].values.index("tip")
        for k, row in enumerate(rows):
            self.assertLess(distance(arrays["beam/node_positions"].row(k, tip), row[1:4]), 1e-12)
            self.assertLess(distance(arrays["beam/node_velocities"].row(k, tip), row[4:7]), 1e-11)
            self.assertLess(distance(arrays["slider/position"].row(k), row[7:10]), 1e-12)
            self.assertLess(distance(arrays["crank/angular_velocity"].row(k), row[10:13]), 1e-12)
            self.assertLess(distance(arrays["slider/acceleration"].row(k), row[13:16]), 1e-8)
            self.assertEqual(arrays["beam/amplitudes"].row(k)[0], row[16])
            self.assertEqual(arrays["beam/amplitude_rates"].row(k)[3], row[17])
            self.assertEqual(arrays["beam/amplitude_accelerations"].row(k)[3], row[18])
            self.assertLess(distance(arrays["crank/angular_acceleration"].row(k), row[19:22]), 1e-9)
            self.assertAlmostEqual(sum(x * x for x in arrays["disc/rotation"].row(k)), 1.0, 13)
        self.assertEqual(arrays["beam/amplitudes"].shape, (201, 4))

    def table_is(self, rows):
        table = read_table(self.folder / "m.csv")
        self.assertEqual(len(table), 201 * 6)
        tips = [row for row in table if (row["body"], row["node"]) == ("beam", "tip")]
        sliders = [row for row in table if (row["body"], row["node"]) == ("slider", "")]
        for expected, tip, slider in zip(rows, tips, sliders, strict=True):
            self.assertEqual(float(tip["time [s]"]), expected[0])
            self.assertLess(distance([float(tip[c + " [m]"]) for c in "xyz"], expected[1:4]), 1e-12)
            self.assertLess(distance([float(tip[f"v{c} [m/s]"]) for c in "xyz"], expected[4:7]), 1e-11)
            self.assertLess(distance([float(slider[c + " [m]"]) for c in "xyz"], expected[7:10]), 1e-12)
            self.assertAlmostEqual(sum(float(tip["q" + c]) ** 2 for c in "wxyz"), 1.0, 12)

    def test_stress_of_a_turning_rod(self):
        """Without modes along the rod its stress is what turning does: rho w^2 (L^2 - x^2) / 2."""
        (self.folder / "m.yaml").write_text(ROD)
        self.program("run", "m.yaml", "--out", "out", "--quiet", "--no-report")
        self.program("export", "out", "--npz", "m.npz", "--stress", "--vtk", "v")
        self.program("export", "out", "--npz", "plain.npz")
        self.assertFalse([name for name in read_npz(self.folder / "plain.npz") if "stress" in name])
        arrays = read_npz(self.folder / "m.npz")
        stress, places = arrays["rod/stress"], arrays["rod/stress_positions"]
        instants, count, _ = stress.shape
        self.assertEqual(places.shape, (count, 3))
        self.assertEqual(set(arrays["rod/stress_layers"].values), {"section"})
        largest = 0.5 * 2700 * 20 ** 2 * 0.6 ** 2
        grid = read_vtu(self.folder / f"v/motion_{instants - 1:06}.vtu")
        for k in range(count):
            x = 0.1 * arrays["rod/stress_nodes"].values[k]
            expected = 0.5 * 2700 * 20 ** 2 * (0.6 ** 2 - x ** 2)
            for frame in (0, instants - 1):
                self.assertLess(distance(stress.row(frame, k), (expected, 0, 0, 0, 0, 0)), 1e-6 * largest)
        # The picture shows it in world axes: the rod has turned by 0.3 + 20 * 0.05.
        axis = (math.cos(1.3), math.sin(1.3), 0)
        world = [axis[i] * axis[j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]
        drawn = 0
        for node, s, von_mises in zip(*(grid["point"][name] for name in ("node", "stress", "von_mises"))):
            if math.isnan(von_mises):
                continue  # a named node
            drawn += 1
            expected = 0.5 * 2700 * 20 ** 2 * (0.6 ** 2 - (0.1 * node) ** 2)
            self.assertLess(abs(von_mises - expected), 1e-6 * largest)
            self.assertLess(distance(s, [expected * w for w in world]), 1e-6 * largest)
        self.assertEqual(drawn, len(grid["points"]) - 2)

    def test_stress_of_a_part_of_shells_and_beams(self):
        """A node shows the worst of its places: sides of two materials, outer points of the section of a beam."""
        (self.folder / "strip.inp").write_text(strip())
        (self.folder / "m.yaml").write_text(STRIP)
        self.program("run", "m.yaml", "--out", "out", "--quiet", "--no-report")
        self.program("export", "out", "--npz", "m.npz", "--stress", "--vtk", "v", "--glb", "m.glb")
        arrays = read_npz(self.folder / "m.npz")
        layers = arrays["strip/stress_layers"].values
        self.assertEqual({layer: layers.count(layer) for layer in layers}, {"top": 30, "bottom": 30, "section": 16})
        nodes = arrays["strip/stress_nodes"].values
        for frame in (0, 10, 20):
            grid = read_vtu(self.folder / f"v/motion_{frame:06}.vtu")
            x, y, z, w = (lambda q: (q[1], q[2], q[3], q[0]))(arrays["strip/rotation"].row(frame))
            named = set(node_points(grid, "strip").values())
            self.assertEqual(len(grid["points"]) - len(named), 28)
            worst_layers = set()
            for point in set(range(len(grid["points"]))) - named:
                places = [k for k, node in enumerate(nodes) if node == grid["point"]["node"][point]]
                worst = max(places, key=lambda k: von_mises(arrays["strip/stress"].row(frame, k)))
                worst_layers.add(layers[worst])
                s = arrays["strip/stress"].row(frame, worst)
                self.assertLess(abs(grid["point"]["von_mises"][point] / von_mises(s) - 1), 1e-6)
                # n . S n does not depend on the axes: n = R e_y.
                n = rotated((x, y, z, w), (0.0, 1.0, 0.0))
                t = grid["point"]["stress"][point]
                normal = sum(n[i] * n[j] * t[c] * f for c, (i, j, f) in enumerate(
                    ((0, 0, 1), (1, 1, 1), (2, 2, 1), (0, 1, 2), (1, 2, 2), (2, 0, 2))))
                self.assertLess(abs(normal - s[1]), 1e-5 * von_mises(s))
            self.assertLessEqual({"top", "section"}, worst_layers)
        # Displacement is from the design, which is turned.
        design = (1 + 0.5 * math.cos(0.7), 2 + 0.5 * math.sin(0.7), 3)
        tips = [row[1:] for row in self.outputs("tip: {position: {body: strip, node: TIP}}")]
        tip = arrays["strip/nodes"].values.index("TIP")
        for frame in (0, 20):
            moved = [a - b for a, b in zip(tips[frame], design)]
            self.assertLess(distance(arrays["strip/node_displacements"].row(frame, tip), moved), 1e-12)
            grid = read_vtu(self.folder / f"v/motion_{frame:06}.vtu")
            self.assertLess(distance(grid["point"]["displacement"][node_points(grid, "strip")["TIP"]], moved), 1e-12)
        # The numbers are those of gauges in the model: six components, then five scalars.
        numbers, chosen = arrays["strip/stress_numbers"].values, []
        for number, layer in ((5, "top"), (5, "bottom"), (10, "top"), (26, "bottom"), (20, "top")):
            chosen += [k for k in range(len(layers)) if (numbers[k], layers[k]) == (number, layer)][:1]
        rows = self.outputs(*(f"g{k}: {{stress: {{body: strip, node: {numbers[k]}, layer: {layers[k]}}}}}" for k in chosen))
        largest = max(abs(x) for row in rows for x in row[1:])
        self.assertGreater(largest, 1e6)
        for column, k in enumerate(chosen):
            of_node = [i for i in range(len(layers)) if (numbers[i], layers[i]) == (numbers[k], layers[k])]
            for frame, row in enumerate(rows):
                gauge = row[1 + 11 * column:7 + 11 * column]
                self.assertLess(min(distance(arrays["strip/stress"].row(frame, i), gauge) for i in of_node), 1e-9 * largest)
        # glTF: triangles, the line of the beam and named nodes.
        self.assertEqual([p["mode"] for p in Glb(self.folder / "m.glb").json["meshes"][0]["primitives"]], [4, 1, 0])

    def test_a_range_of_times_every_nth_and_chosen_bodies(self):
        self.run_model()
        some = ("--from", "0.05", "--to", "0.1", "--every", "7", "--body", "beam", "--body", "disc")
        self.program("export", "out/states.ffr", "--npz", "m.npz", "--glb", "m.glb", "--vtk", "v", "--csv", "m.csv", *some)
        times = list(read_npz(self.folder / "m.npz")["time"].values)
        self.assertEqual([round(1000 * t) for t in times], [50, 57, 64, 71, 78, 85, 92, 99])
        self.assertEqual(read_npz(self.folder / "m.npz")["bodies"].values, ["disc", "beam"])
        scene = Glb(self.folder / "m.glb")
        self.assertEqual(sorted(scene.nodes), ["beam", "disc"])
        self.assertEqual(scene.times[0], 0.0)
        self.assertEqual(scene.json["nodes"][0]["extras"]["first_time_s"], times[0])
        self.assertEqual([t for t, _ in read_pvd(self.folder / "v/motion.pvd")], times)
        self.assertEqual({row["body"] for row in read_table(self.folder / "m.csv")}, {"disc", "beam"})
        grid = read_vtu(self.folder / "v/motion_000000.vtu")
        self.assertEqual(set(grid["point"]["body"]), {2, 3})
        # A shorter series leaves nothing of the longer one, and other files alone.
        (self.folder / "v/notes_000009.vtu").write_text("mine")
        self.program("export", "out", "--vtk", "v", "--every", "100")
        self.assertEqual(sorted(path.name for path in (self.folder / "v").iterdir()),
                         ["motion.pvd", "motion_000000.vtu", "motion_000001.vtu", "motion_000002.vtu", "notes_000009.vtu"])
        # One instant is a picture without animation.
        self.program("export", "out", "--glb", "one.glb", "--from", "0.1", "--to", "0.1")
        self.assertNotIn("animations", Glb(self.folder / "one.glb").json)

    def test_far_from_the_origin_floats_are_enough(self):
        text = (self.folder / "m.yaml").read_text().replace("[0, 1, 0]", "[50000, 1, 0]").replace("[0.6, 1, 0]", "[50000.6, 1, 0]")
        (self.folder / "m.yaml").write_text(text)
        self.run_model()
        self.program("export", "out", "--glb", "m.glb", "--body", "beam")
        rows = self.outputs("p: {position: {body: beam, node: tip}}")
        scene = Glb(self.folder / "m.glb")
        tip = scene.named("beam").index("tip")
        for k in (0, 100, 200):
            self.assertLess(distance(scene.points("beam", k)[tip], rows[k][1:4]), 1e-6)

    def test_what_cannot_be_exported_is_said_in_one_sentence(self):
        self.run_model()
        self.refused("found no file to write, expected --vtk, --glb, --npz or --csv", "out")
        self.refused("found --stress without --npz, expected the file that is to hold it", "out", "--stress", "--csv", "m.csv")
        self.refused("--stress: none of the bodies whose states were recorded has stress data", "out", "--stress", "--npz", "m.npz", "--body", "disc")
        said = self.program("export", "out", "--csv", "m.csv", "--body", "baem", code=2).stderr
        self.assertIn("--body: found 'baem', ", said)
        self.refused("out/states.ffr: found no recorded instant from 3 s on, expected some of the 201 from 0 to 0.2 s",
                     "out", "--csv", "m.csv", "--from", "3")
        self.refused("found --from 3 after --to 1, expected an earlier time", "out", "--csv", "m.csv", "--from", "3", "--to", "1")
        self.refused("--from: found 'soon', expected a number [s]", "out", "--csv", "m.csv", "--from", "soon")
        self.refused("the file 'no/m.glb' cannot be written: No such file or directory", "out", "--glb", "no/m.glb")
        self.refused("the output folder 'm.yaml' cannot be written: Not a directory", "out", "--vtk", "m.yaml")
        self.refused("--csv: found 'out/results.csv', which this command reads; expected another file", "out", "--csv", "out/results.csv")
        self.refused("--glb and --npz: found 'x' for both, expected two files", "out", "--glb", "x", "--npz", "x")
        self.refused("--csv: found 'm.yaml', which this command reads; expected another file", "out", "--csv", "m.yaml")
        self.run_model("--record", "none", out="none")
        self.refused("none/states.ffr: found no states, expected those of a run that records them (--record states)",
                     "none", "--csv", "m.csv")
        (self.folder / "m.yaml").write_text((self.folder / "m.yaml").read_text().replace("mass: 2", "mass: 3"))
        self.refused("out/states.ffr: the states are of a run that was made before 'm.yaml' was changed", "out", "--csv", "m.csv")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["m.yaml", "none", "out"])

    def test_a_full_disk_leaves_no_file(self):
        self.run_model()
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))
        done = self.program("export", "out", "--glb", "m.glb", "--npz", "m.npz", code=1, preexec_fn=limit)
        self.assertIn("cannot be written: File too large", done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir() if ".part" in p.name], [])
        self.assertFalse((self.folder / "m.npz").exists())

    def test_an_interrupted_series_has_no_index_and_whole_files(self):
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=4", "--quiet", "--no-report")
        self.program("export", "out", "--vtk", "v", "--every", "2000")
        process = self.begin("export", "out", "--vtk", "v")
        until = time.monotonic() + 60
        while len(list((self.folder / "v").glob("*.vtu"))) < 20 and time.monotonic() < until:
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGINT)
        names = os.listdir(self.folder / "v")
        self.assertNotIn("motion.pvd", names)
        self.assertGreaterEqual(len(names), 20)
        for name in names:
            read_vtu(self.folder / "v" / name)


if __name__ == "__main__":
    unittest.main()
