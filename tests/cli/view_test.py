#!/usr/bin/env python3
"""The scenes of pages: of a run, of a model before it is run, of a reduced part. Without the viewer a sentence instead."""
import base64
import os
import pathlib
import re
import shutil
import struct
import unittest
import zlib

from report_page import page_of
from run_case import RunCase

EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES", "examples")).resolve()
PARTS = pathlib.Path(os.environ.get("FLOATFRAME_TEST_DATA", "tests/data")).resolve() / "fe"


def buffer_of(path, page):
    text = re.search(r'id="floatframe-buffer">(.*?)</script>', path.read_text("utf-8"), re.S)[1]
    data = base64.b64decode(text)
    return zlib.decompress(data) if page.get("compression") == "deflate" else data


def numbers(data, view):
    count = 1
    for n in view["shape"]:
        count *= n
    letter = {"f16": "e", "f32": "f", "f64": "d", "u16": "H", "u32": "I"}[view["type"]]
    return struct.unpack_from(f"<{count}{letter}", data, view["offset"])


# A rod between two joints that it cannot reach.
TORN = """
floatframe: 1
name: torn
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  slider: {rigid: {mass: 1, centre_of_mass: [5, 0, 0], inertia: [0.01, 0.01, 0.01]}}
joints:
  drive: {type: revolute, child: crank, at: [0, 0, 0], axis: z}
  hinge: {type: revolute, child: slider, at: [5, 0, 0], axis: z}
rods: {rod: {from: {body: crank, at: [0.1, 0, 0]}, to: {body: slider, at: [5.1, 0, 0]}, length: 1}}
simulation: {step: 0.01, duration: 0.1}
"""


# A rod without modes along it, turning: its stress rho w^2 (L^2 - x^2) / 2 is its own inertia's.
TURNING = """
floatframe: 1
name: turning
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
simulation: {step: 1.0e-3, duration: 0.05, output_interval: 0.01}
"""


# A box that nothing holds.
FREE = """
floatframe: 1
name: free
gravity: [0, 0, 0]
bodies:
  box: {position: [1, 2, 3], rigid: {mass: 2, inertia: [1, 1, 1]}}
joints:
  fly: {type: free, child: box, at: [1, 2, 3]}
simulation: {step: 0.01, duration: 0.2}
"""

# A pendulum with its mass above the hinge: lambda = +-sqrt(g / l).
UPRIGHT = """
floatframe: 1
name: upright
bodies:
  bob: {position: [0, 0, 1], rigid: {mass: 2, inertia: [0, 0, 0]}}
joints:
  hinge: {type: revolute, child: bob, at: [0, 0, 0], axis: y}
simulation: {step: 0.01, duration: 0.2}
"""


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class View(RunCase):
    def test_a_run_shows_its_motion(self):
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.2", "--quiet")
        path = self.folder / "out/report.html"
        page = page_of(path)
        if page is None:
            self.skipTest("built without the viewer")
        scene, data = page["scene"], buffer_of(path, page)
        self.assertEqual([b["name"] for b in scene["bodies"]], ["crank", "slider", "disc", "beam"])
        time = numbers(data, scene["frames"]["time"])
        self.assertEqual(len(time), 201)
        self.assertEqual([b["shape"]["kind"] for b in scene["bodies"]], ["cylinder", "box", "box", "mesh"])
        pose = numbers(data, scene["frames"]["pose"])
        rows = (self.folder / "out/results.csv").read_text().splitlines()[1:]
        point = next(p for p in scene["points"] if p["name"] == "tip")
        y, columns = numbers(data, scene["frames"]["amplitudes"]), scene["frames"]["amplitudes"]["shape"][1]
        for frame in (0, 77, 200):
            local = [point["p"][c] + sum(point["modes"][m][c] * y[columns * frame + m] for m in range(4)) for c in range(3)]
            x0, y0, z0, x, y1, z, w = pose[7 * (4 * frame + 3):7 * (4 * frame + 4)]
            v = (x, y1, z)
            t = [2 * c for c in cross(v, local)]
            u = cross(v, t)
            world = [o + local[c] + w * t[c] + u[c] for c, o in enumerate((x0, y0, z0))]
            expected = [float(n) for n in rows[frame].split(",")[4:7]]
            for a, b in zip(world, expected):
                self.assertAlmostEqual(a, b, 5)
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.2", "--quiet", "--record", "none")
        self.assertIsNone(page_of(path)["scene"])

    def test_a_run_shows_whether_it_can_be_trusted(self):
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.2", "--quiet")
        page = page_of(self.folder / "out/report.html")
        if page is None:
            self.skipTest("built without the viewer")
        groups = [channel["group"] for channel in page["trust"]["channels"]]
        self.assertEqual([groups.count(g) for g in ("constraints", "effort", "energy", "range")], [2, 3, 12, 2])
        times = page["speed"]["step_times"]
        self.assertEqual(sum(times["counts"]), self.summary("out")["steps"])
        self.assertEqual([table["heading"] for table in page["tables"]][:3], ["Bodies", "Modes", "Coordinates"])

    def test_a_model_that_cannot_start_is_shown_as_designed(self):
        (self.folder / "torn.yaml").write_text(TORN)
        done = self.program("check", "torn.yaml", "--report", "check.html", code=None)
        if "without the viewer" in done.stderr:
            self.skipTest("built without the viewer")
        self.assertEqual(done.returncode, 1)
        self.program("run", "torn.yaml", "--out", "out", "--quiet", code=1)
        for name in ("check.html", "out/report.html"):
            page = page_of(self.folder / name)
            self.assertEqual(page["status"]["state"], "failed")
            self.assertRegex(page["status"]["sentences"][0], "^(A run of this model cannot|This run could not) start: .*rod")
            self.assertIn("design configuration", page["status"]["sentences"][1])
            self.assertEqual([b["name"] for b in page["scene"]["bodies"]], ["crank", "slider"])
            self.assertNotIn("NaN", (self.folder / name).read_text("utf-8").split('id="floatframe-buffer"', 1)[0][-20000:])

    def test_the_vehicle_stands_on_the_road(self):
        model = EXAMPLES / "iltis/iltis.yaml"
        done = self.program("check", str(model), "--report", "check.html", code=None)
        path = self.folder / "check.html"
        if done.returncode == 2:
            self.assertIn("--report: this program was built without the viewer", done.stderr)
            self.skipTest("built without the viewer")
        page = page_of(path)
        self.assertEqual(page["kind"], "check")
        scene, data = page["scene"], buffer_of(path, page)
        self.assertEqual(len(numbers(data, scene["frames"]["time"])), 1)
        pose = numbers(data, scene["frames"]["pose"])
        road = numbers(data, scene["roads"][0]["profile"])
        tyres = [f for f in scene["forces"] if f["type"] == "tyre"]
        self.assertEqual(len(tyres), 4)
        for tyre in tyres:
            point = scene["points"][tyre["a"]]
            x, _, z = pose[7 * point["body"]:7 * point["body"] + 3]
            nearest = min(range(0, len(road), 2), key=lambda k: abs(road[k] - x))
            height = z - road[nearest + 1]
            self.assertLess(height, tyre["radius"])
            self.assertGreater(height, 0.9 * tyre["radius"])
        self.assertIn("Joints", [t["heading"] for t in page["tables"]])
        self.assertLess(path.stat().st_size, 5_000_000)

    def modes_page(self, model, *options):
        done = self.program("modes", str(model), *options, "--report", "modes.html", code=None)
        if done.returncode == 2:
            self.assertIn("--report: this program was built without the viewer", done.stderr)
            self.skipTest("built without the viewer")
        page = page_of(self.folder / "modes.html")
        self.assertEqual(page["kind"], "modes")
        return page, buffer_of(self.folder / "modes.html", page)

    def moved(self, scene, data, motion):
        """Complex displacement of a point of the scene in a motion: d + theta x R (p + X y) + R X dy."""
        bodies, count = len(scene["bodies"]), sum(b["modes"]["count"] for b in scene["bodies"] if b["modes"])
        pose = numbers(data, scene["frames"]["pose"])
        start = motion * 12 * bodies
        places = numbers(data, scene["vibrations"]["places"])[start:start + 12 * bodies]
        present, swing = [], []
        if count > 0:
            present = numbers(data, scene["frames"]["amplitudes"])
            swing = numbers(data, scene["vibrations"]["amplitudes"])[2 * count * motion:2 * count * (motion + 1)]

        def turned(body, v):
            x, y, z, w = pose[7 * body + 3:7 * body + 7]
            t = [2 * c for c in cross((x, y, z), v)]
            u = cross((x, y, z), t)
            return [v[i] + w * t[i] + u[i] for i in range(3)]

        def of(index):
            point = scene["points"][index]
            body = point["body"]
            if body < 0:
                return [0j, 0j, 0j]
            local, bend = list(point["p"]), [0j, 0j, 0j]
            for j, mode in enumerate(point["modes"] or []):
                k = scene["bodies"][body]["modes"]["first"] + j
                for i in range(3):
                    local[i] += mode[i] * present[k]
                    bend[i] += mode[i] * complex(swing[k], swing[count + k])
            d, theta = ([complex(places[6 * body + at + i], places[6 * (bodies + body) + at + i]) for i in range(3)]
                        for at in (0, 3))
            arm = cross(theta, turned(body, local))
            bent = turned(body, bend)
            return [d[i] + arm[i] + bent[i] for i in range(3)]
        return of

    def test_vibrations_keep_joints_closed(self):
        # The page draws nodes to first order, which move by X + e_j y^T h_j where stiffening is counted in.
        linear = pathlib.Path(shutil.copytree(EXAMPLES / "iltis", self.folder / "linear")) / "iltis.yaml"
        linear.write_text(linear.read_text(encoding="utf-8").replace(
            "\nsimulation:\n", "\nsimulation:\n  geometric_stiffening: false\n"), encoding="utf-8")
        page, data = self.modes_page(linear, "--set", "speed=0")
        scene = page["scene"]
        self.assertEqual(len(numbers(data, scene["frames"]["time"])), 1)
        motions = scene["vibrations"]["list"]
        self.assertEqual([m["kind"] for m in motions[:4]], ["rigid"] * 3 + ["vibration"])
        self.assertEqual([m["number"] for m in motions[:5]], [None, None, None, 1, 2])
        self.assertAlmostEqual(motions[3]["frequency"], 1.527, 3)
        self.assertEqual(motions[3]["moves"][0][0], "chassis")
        closed = [j for j in scene["joints"] if j["type"] in ("spherical", "revolute", "universal", "weld")]
        self.assertGreater(len(closed), 12)
        free = {"spherical": (3, 0), "revolute": (1, 0), "universal": (2, 0), "weld": (0, 0), "prismatic": (0, 1), "free": (3, 3)}
        for j in scene["joints"]:
            self.assertEqual((j["turns"], j["slides"]), free[j["type"]], j["name"])
        for k in list(range(12)) + [30, 50]:
            moved = self.moved(scene, data, k)
            size = max(abs(x) for j in closed for x in moved(j["a"]))
            gap = max(abs(x - y) for j in closed for x, y in zip(moved(j["a"]), moved(j["b"])))
            self.assertLess(gap, 1e-4 * size, (k, motions[k]))
        self.assertEqual(page["tables"][0]["heading"], "Vibrations")
        self.assertEqual(page["tables"][0]["rows"][0][0], "1")

    def test_rigid_motions_are_those_of_single_coordinates(self):
        (self.folder / "free.yaml").write_text(FREE)
        page, data = self.modes_page("free.yaml", "--at", "0.1")
        self.assertIn("about the state that a run has at 0.1 s.", page["status"]["sentences"][0])
        motions = page["scene"]["vibrations"]["list"]
        self.assertEqual([m["kind"] for m in motions], ["rigid"] * 6)
        for m in motions:
            self.assertEqual([name for name, _ in m["moves"]], ["box"])
            self.assertAlmostEqual(m["moves"][0][1], 1)
        places = numbers(data, page["scene"]["vibrations"]["places"])
        self.assertEqual(max(abs(x) for k in range(6) for x in places[12 * k + 6:12 * k + 12]), 0)
        # A unit of one each, in the order of the coordinates.
        for k in range(6):
            for i, x in enumerate(places[12 * k:12 * k + 6]):
                self.assertAlmostEqual(abs(x), 1 if i == k else 0, 5)

    def test_what_grows_is_said(self):
        (self.folder / "upright.yaml").write_text(UPRIGHT)
        page, _ = self.modes_page("upright.yaml")
        self.assertRegex(page["status"]["warnings"][0], r"^Mode \d grows without oscillating, by e in 0.3193 s")
        self.assertEqual({m["kind"] for m in page["scene"]["vibrations"]["list"]}, {"growth", "decay"})

    def test_a_reduced_part_shows_its_modes(self):
        arguments = ("reduce", str(PARTS / "aarm_coarse_free.inp"), "--units", "mm-t-s", "--interface", "BALL=set:BALL",
                     "--interface", "BUSH_F=set:BUSH_F", "--modes", "3", "--quiet", "--report", "part.html")
        done = self.program(*arguments, code=None)
        if done.returncode == 2:
            self.assertIn("--report: this program was built without the viewer", done.stderr)
            self.skipTest("built without the viewer")
        page = page_of(self.folder / "part.html")
        self.assertEqual(page["kind"], "reduce")
        body = page["scene"]["bodies"][0]
        self.assertIsNone(page["scene"]["frames"])
        self.assertEqual(body["shape"]["kind"], "mesh")
        self.assertEqual(body["modes"]["count"], body["shape"]["displacements"]["shape"][1])
        self.assertEqual([p["name"] for p in page["scene"]["points"]], ["BALL", "BUSH_F"])
        self.assertEqual(len(body["spiders"]), 2)


    def test_stress_by_inertia_is_in_the_page(self):
        (self.folder / "m.yaml").write_text(TURNING)
        self.program("run", "m.yaml", "--out", "out", "--quiet")
        path = self.folder / "out/report.html"
        page = page_of(path)
        if page is None:
            self.skipTest("built without the viewer")
        data, (body,) = buffer_of(path, page), page["scene"]["bodies"]
        stress, largest = body["stress"], 0.5 * 2700 * 20 ** 2 * 0.6 ** 2
        vertices = numbers(data, body["shape"]["vertices"])
        envelope = numbers(data, stress["envelope"])
        for v, found in enumerate(envelope):
            self.assertLess(abs(found - 0.5 * 2700 * 20 ** 2 * (0.36 - vertices[3 * v] ** 2)), 1e-6 * largest)
        # And blended as the viewer does it, at each frame.
        rows = page["scene"]["frames"]["amplitudes"]
        amplitudes, (frames, columns) = numbers(data, rows), rows["shape"]
        count = body["modes"]["count"]
        tables = ((numbers(data, stress["modes"]), body["modes"]["first"], count), (numbers(data, stress["loads"]), stress["first_load"], 12))
        self.assertEqual(columns, count + 12)
        for frame in range(frames):
            for v in range(0, len(envelope), 7):
                xx = stress["factor"] * sum(table[6 * (v * n + k)] * amplitudes[frame * columns + first + k]
                                            for table, first, n in tables for k in range(n))
                self.assertLess(abs(xx - envelope[v]), 1e-3 * largest)


if __name__ == "__main__":
    unittest.main()
