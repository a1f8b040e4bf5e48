#!/usr/bin/env python3
"""The file of the states of a run: read with nothing but the standard library, after a kill, and new channels from it."""
import csv
import io
import json
import os
import resource
import signal
import struct
import unittest
import zlib

from run_case import RunCase


def read_states(path):
    """Header, bytes of the arrays, rows, end; as docs/result-file.md says."""
    data = path.read_bytes()
    magic, version, _ = struct.unpack_from("<8sII", data)
    assert (magic, version) == (b"floatfr\n", 1)
    header, arrays, rows, end, at = None, {}, [], None, 16
    while at + 16 <= len(data):
        length, kind, checksum = struct.unpack_from("<Q4sI", data, at)
        content = data[at + 16:at + 16 + length]
        if len(content) < length or zlib.crc32(content, zlib.crc32(data[at:at + 12])) != checksum:
            break
        at += 16 + (length + 7) // 8 * 8
        if kind == b"HEAD":
            header = json.loads(content)
            columns = sum(group["count"] for group in header["groups"])
        elif kind == b"DATA":
            arrays[header["arrays"][len(arrays)]["name"]] = content
        elif kind == b"ROWS":
            assert length % (8 * columns) == 0 and length <= 1 << 20
            rows += struct.iter_unpack(f"<{columns}d", content)
        else:
            assert kind == b"DONE"
            end = json.loads(content)
    return header, arrays, rows, end


class States(RunCase):
    def table(self, text):
        lines = list(csv.reader(io.StringIO(text)))
        return lines[0], [[float(x) for x in line] for line in lines[1:]]

    def results(self, folder):
        return self.table((self.folder / folder / "results.csv").read_text())

    def states(self, folder):
        return read_states(self.folder / folder / "states.ffr")

    def test_the_file_says_what_it_holds(self):
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.05", "--quiet")
        header, arrays, rows, end = self.states("out")
        self.assertEqual(end, {"status": "completed", "message": ""})
        _, table = self.results("out")
        self.assertEqual([row[0] for row in rows], [row[0] for row in table])
        self.assertEqual(header["model"], "long")
        self.assertEqual(header["origin"]["settings"], ["duration=0.05"])
        self.assertEqual(list(header["origin"]["files"]), ["m.yaml"])
        self.assertEqual(header["origin"]["file_from_here"], "../m.yaml")
        self.assertIn("duration: 0.05\n", header["origin"]["text"])
        self.assertNotIn("${", header["origin"]["text"])
        self.assertEqual(len(header["v"]), header["velocities"])
        bodies = {body["name"]: body for body in header["bodies"]}
        beam = bodies["beam"]
        self.assertEqual(len(beam["modes"]), 4)
        for name, content in arrays.items():
            entry = next(a for a in header["arrays"] if a["name"] == name)
            size = {"f32": 4, "f64": 8, "u32": 4}[entry["type"]]
            for n in entry["shape"]:
                size *= n
            self.assertEqual(len(content), size, name)
        # The tip of the beam, from pose and modes.
        nodes = header["shapes"][beam["shape"]]["nodes"]
        tip = nodes.index("tip")
        X = struct.unpack(f"<{12 * len(nodes)}d", arrays[f"shapes/{beam['shape']}/node_modes"])
        p = struct.unpack(f"<{3 * len(nodes)}d", arrays[f"shapes/{beam['shape']}/node_positions"])
        for row, expected in zip(rows, table):
            y = row[beam["amplitudes"]:beam["amplitudes"] + 4]
            local = [p[3 * tip + c] + sum(X[(3 * tip + c) * 4 + m] * y[m] for m in range(4)) for c in range(3)]
            x0, y0, z0, w, x, y, z = row[beam["pose"]:beam["pose"] + 7]
            turned = ((1 - 2 * (y * y + z * z)) * local[0] + 2 * (x * y - w * z) * local[1] + 2 * (x * z + w * y) * local[2],
                      2 * (x * y + w * z) * local[0] + (1 - 2 * (x * x + z * z)) * local[1] + 2 * (y * z - w * x) * local[2],
                      2 * (x * z - w * y) * local[0] + 2 * (y * z + w * x) * local[1] + (1 - 2 * (x * x + y * y)) * local[2])
            for k, origin in enumerate((x0, y0, z0)):
                self.assertAlmostEqual(origin + turned[k], expected[4 + k], 12)

    def test_what_is_recorded_is_asked_for(self):
        short = ("--set", "duration=0.05", "--quiet")
        self.program("run", "m.yaml", "--out", "out", *short)
        self.program("run", "m.yaml", "--out", "out", "--record", "none", *short)
        self.assertFalse((self.folder / "out/states.ffr").exists(), "those of an older run go")
        text = (self.folder / "m.yaml").read_text()
        some = "simulation: {record: {states: {every: 7, bodies: [beam], accelerations: false}}, "
        (self.folder / "some.yaml").write_text(text.replace("simulation: {", some))
        self.program("run", "some.yaml", "--out", "some", *short)
        header, _, rows, _ = self.states("some")
        self.assertEqual([group["name"] for group in header["groups"]],
                         ["time", "q", "v", "spring_angles", "inputs", "poses", "health"])
        self.assertEqual([b["name"] for b in header["bodies"] if b["pose"] >= 0], ["beam"])
        self.assertEqual(len(rows), 9)
        (self.folder / "none.yaml").write_text(text.replace("simulation: {", "simulation: {record: none, "))
        self.program("run", "none.yaml", "--out", "none", *short)
        self.assertFalse((self.folder / "none/states.ffr").exists())
        self.program("run", "none.yaml", "--out", "none", "--record", "states", *short)
        self.assertTrue((self.folder / "none/states.ffr").exists())
        for wrong, sentence in (
                ("some", "simulation.record: found 'some', expected none or states"),
                ("{states: {every: 0}}", "simulation.record.states.every: found 0, expected a number of instants (a whole number from 1"),
                ("{states: {bodies: [beem]}}", "simulation.record.states.bodies[1]: unknown body 'beem', did you mean 'beam'?"),
                ("{state: all}", "simulation.record: missing key 'states'")):
            (self.folder / "bad.yaml").write_text(text.replace("simulation: {", f"simulation: {{record: {wrong}, "))
            self.assertIn(sentence, self.program("check", "bad.yaml", code=2).stderr)

    def test_a_killed_run_leaves_what_can_be_used(self):
        process = self.begin("run", "m.yaml", "--out", "out")
        path = self.folder / "out/states.ffr"
        self.wait_for(lambda: path.exists() and len(self.states("out")[2]) > 200, process)
        self.end(process, signal.SIGKILL)
        _, _, rows, end = self.states("out")
        self.assertIsNone(end)
        size = path.stat().st_size
        with open(path, "ab") as file:  # as if it had been killed while it wrote
            file.write(struct.pack("<Q4sI", 800, b"ROWS", 1) + b"torn")
        done = self.program("outputs", "out", "--add", "z: {position: slider, axis: x}", "--out", "z.csv")
        self.assertEqual(done.stderr, "floatframe: out/states.ffr: the last 20 bytes are a block that was not written to "
                                      "its end: left out\n")
        head, table = self.table((self.folder / "z.csv").read_text())
        self.assertEqual(head, ["time [s]", "z [m]"])
        self.assertEqual([row[0] for row in table], [row[0] for row in rows])
        data = bytearray(path.read_bytes()[:size])
        data[size // 2] ^= 1
        path.write_bytes(data)
        self.assertIn("is damaged", self.program("outputs", "out", "--add", "z: {position: slider, axis: x}", code=2).stderr)

    def test_a_run_goes_on_with_its_states(self):
        setting = ("--set", "duration=2", "--quiet")
        self.program("run", "m.yaml", "--out", "whole", *setting)
        process = self.begin("run", "m.yaml", "--out", "out", "--checkpoint-every", "0.1", *setting)
        checkpoint = self.folder / "out/run.checkpoint"
        self.wait_for(lambda: checkpoint.exists() or process.poll() is not None)
        if process.poll() is None:
            self.end(process, signal.SIGKILL)
        if checkpoint.exists():  # else it was quicker
            data = bytearray((self.folder / "out/states.ffr").read_bytes())
            (self.folder / "out/states.ffr").write_bytes(data[:100])
            done = self.program("run", "m.yaml", "--out", "out", "--resume", *setting, code=2)
            self.assertIn("the file 'out/states.ffr' cannot be continued: found 100 bytes", done.stderr)
            (self.folder / "out/states.ffr").write_bytes(data)
            done = self.program("run", "m.yaml", "--out", "out", "--resume", "--record", "none", *setting, code=2)
            self.assertIn("was made with another value of states recorded: found every 1, this run has none", done.stderr)
            self.program("run", "m.yaml", "--out", "out", "--resume", *setting)
        self.same_files("out", "whole")
        one, two = self.states("out"), self.states("whole")
        self.assertEqual(one[2], two[2])
        self.assertEqual((one[1], one[3]), (two[1], two[3]))

    def test_a_disk_that_is_full_leaves_whole_blocks(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (150_000, 150_000))
        done = self.program("run", "m.yaml", "--out", "out", "--no-report", "--set", "duration=10", code=1,
                            preexec_fn=limit)
        self.assertRegex(done.stderr, "the run failed: at t = .* s the file 'out/states.ffr' cannot be written: File too large")
        _, _, rows, _ = self.states("out")
        self.assertGreater(len(rows), 50)
        self.assertLessEqual((self.folder / "out/states.ffr").stat().st_size, 150_000)

    def test_new_channels_equal_those_of_a_run(self):
        setting = ("--set", "duration=0.3")
        channels = {"a": "{acceleration: {body: beam, node: tip}}", "turns": "{joint_position: spin}",
                    "w": "{angular_velocity: slider, axis: z}", "f": "{joint_force: hinge}"}
        text = (self.folder / "m.yaml").read_text()
        (self.folder / "more.yaml").write_text(
            text.replace("\nsimulation:", "".join(f"\n  {name}_: {value}" for name, value in channels.items()) + "\nsimulation:"))
        for coordinates in ("relative", "absolute"):
            self.program("run", "m.yaml", "--out", "out", "--coordinates", coordinates, *setting, "--quiet")
            self.program("run", "more.yaml", "--out", "more", "--coordinates", coordinates, *setting, "--quiet")
            added = [x for name, value in channels.items() for x in ("--add", f"{name}_: {value}")]
            head, table = self.table(self.program("outputs", "out", *added).stdout)
            wide, expected = self.results("more")
            self.assertEqual(head[1:], wide[-8:])
            self.assertEqual([row[1:] for row in table], [row[-8:] for row in expected])

    def test_a_study_keeps_states_where_the_model_asks_for_them(self):
        text = (self.folder / "m.yaml").read_text()
        (self.folder / "kept.yaml").write_text(text.replace("simulation: {", "simulation: {record: states, "))
        for model, there in (("m.yaml", False), ("kept.yaml", True)):
            self.program("sweep", model, "--vary", "mass=1,2", "--vary", "simulation.step=0.001,0.002", "--set",
                         "duration=0.1", "--keep-results", "--out", "study", "--fresh", "--quiet")
            self.assertEqual((self.folder / "study/runs/3/states.ffr").exists(), there)
        header, _, rows, end = self.states("study/runs/3")
        self.assertEqual(header["origin"]["settings"], ["duration=0.1", "mass=2"])
        self.assertEqual(end["status"], "completed")
        _, table = self.results("study/runs/3")
        self.assertEqual([row[0] for row in rows], [row[0] for row in table])
        for number, rows in ((3, 101), (4, 51)):
            done = self.program("outputs", f"study/runs/{number}", "--add", "again: {joint_position: spin}")
            _, found = self.table(done.stdout)
            _, table = self.results(f"study/runs/{number}")
            self.assertEqual([row[1] for row in found], [row[2] for row in table])
            self.assertEqual(len(found), rows)

    def test_wrong_questions_are_answered(self):
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.05", "--quiet")

        def refused(*arguments):
            return self.program("outputs", *arguments, code=2).stderr.replace("floatframe: ", "", 1)
        add = ("--add", "z: {position: slider, axis: x}")
        self.assertIn("found no --add, expected a channel", refused("out"))
        self.assertIn("--add:1:15: outputs.z.position: unknown body 'slidr', did you mean 'slider'?",
                      refused("out", "--add", "z: {position: slidr, axis: x}"))
        self.assertIn("--add:1:1: outputs: the column 'tip.x' exists already", refused("out", "--add", "tip: {position: slider}"))
        self.assertIn("--add:1:", refused("out", "--add", "z: {position: [slider"))
        self.assertIn("impulses of projections",
                      refused("out", "--add", "z: {projection_impulse: guide, axis: y}"))
        self.assertIn("out/report.html: this is not a result file of a run", refused("out/report.html", *add))
        self.assertIn("No such file", refused("nothing.ffr", *add))
        before = (self.folder / "out/states.ffr").read_bytes()
        self.assertIn("--out", refused("out", *add, "--out", "out/states.ffr"))
        self.assertEqual((self.folder / "out/states.ffr").read_bytes(), before)
        (self.folder / "m.yaml").rename(self.folder / "moved.yaml")
        self.assertIn("the model file 'm.yaml' does not exist any more", refused("out", *add))
        self.program("outputs", "out", *add, "--model", "moved.yaml")  # the same by another name
        (self.folder / "m.yaml").write_text((self.folder / "moved.yaml").read_text() + "# changed\n")
        self.assertIn("made before 'm.yaml' was changed", refused("out", *add))
        (self.folder / "m.yaml").write_text((self.folder / "moved.yaml").read_text())
        os.rename(self.folder / "out", self.folder / "elsewhere")
        self.program("outputs", "elsewhere", *add)
        (self.folder / "far").mkdir()
        (self.folder / "m.yaml").rename(self.folder / "far/m.yaml")
        self.program("outputs", "elsewhere", *add, "--model", "far/m.yaml")


if __name__ == "__main__":
    unittest.main()
