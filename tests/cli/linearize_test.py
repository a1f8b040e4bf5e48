#!/usr/bin/env python3
"""`floatframe linearize` from outside: the same matrices in JSON and in all files, read with the standard library (with NumPy
and SciPy: python/tests/test_files_read.py)."""
import ast
import csv
import io
import json
import struct
import unittest
import zipfile
import zlib

from run_case import RunCase

MODEL = """\
floatframe: 1
name: sledge
bodies:
  sledge: {position: [0, 0, 0], rigid: {mass: 4}}
  bob: {position: [0, 0, -1], rigid: {mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  slide: {type: prismatic, child: sledge, at: [0, 0, 0], axis: x, motion: {polynomial: [0]}}
  pin: {type: revolute, parent: sledge, child: bob, at: [0, 0, 0], axis: y}
inputs: {torque: {unit: "N\u00b7m"}}
forces:
  friction: {type: joint_spring, joint: pin, damper: 0.3, actuator: {input: torque}}
outputs:
  pin: {joint_position: pin}
  bob: {acceleration: bob, axis: x}
  motor: {motion_force: slide}
simulation: {start: equilibrium, step: 1.0e-3, duration: 1}
"""


def npy(data):
    """(shape, flat list) of a .npy array of doubles or texts."""
    assert data[:8] == b"\x93NUMPY\x01\x00"
    length, = struct.unpack("<H", data[8:10])
    header = ast.literal_eval(data[10:10 + length].decode("latin1"))
    assert not header["fortran_order"]
    values = data[10 + length:]
    if header["descr"].startswith("<U"):
        size = 4 * int(header["descr"][2:])
        return header["shape"], [values[k:k + size].decode("utf-32-le").rstrip("\0") for k in range(0, len(values), size)]
    assert header["descr"] == "<f8"
    return header["shape"], list(struct.unpack(f"<{len(values) // 8}d", values))


def elements(data):
    """(type, content) of the elements of a level 5 MAT-file, which are filled up to 8 bytes unless compressed."""
    at = 0
    while at < len(data):
        kind, size = struct.unpack("<II", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + size]
        at += 8 + (size if kind == 15 else (size + 7) // 8 * 8)


def mat_array(content):
    """Name, and rows of numbers or list of texts."""
    parts = list(elements(content))
    assert [kind for kind, _ in parts[:3]] == [6, 5, 1]
    rows, columns = struct.unpack("<2i", parts[1][1])
    name, array_class = parts[2][1].decode(), parts[0][1][0]
    if array_class == 6:
        assert parts[3][0] == 9
        values = struct.unpack(f"<{rows * columns}d", parts[3][1])
        return name, [list(values[i::rows]) for i in range(rows)] if columns else [[] for _ in range(rows)]
    assert array_class == 1 and columns == 1 and len(parts) == 3 + rows
    texts = []
    for kind, cell in parts[3:]:
        inner = list(elements(cell))
        assert kind == 14 and inner[0][1][0] == 4 and inner[3][0] == 4
        texts.append(inner[3][1].decode("utf-16-le"))
    return name, texts


def mat(data):
    assert data[:6] == b"MATLAB" and data[124:128] == b"\x00\x01IM"
    found = {}
    for kind, content in elements(data[128:]):
        assert kind == 15
        (inner, array), = elements(zlib.decompress(content))
        assert inner == 14
        name, value = mat_array(array)
        found[name] = value
    return found


class Linearize(RunCase):
    def setUp(self):
        super().setUp()
        (self.folder / "sledge.yaml").write_text(MODEL, encoding="utf-8")

    def test_all_files_hold_the_same_system(self):
        done = self.program("linearize", "sledge.yaml", "--json", "--npz", "s.npz", "--mat", "s.mat", "--csv", "s.csv")
        result = json.loads(done.stdout)
        self.assertEqual(result["inputs"], [{"name": "torque", "unit": "N\u00b7m"},
                                            {"name": "acceleration of motion of slide", "unit": "m/s2"}])
        self.assertEqual(result["states"], ["joint 'pin'", "rate of joint 'pin'", "motion of slide",
                                            "rate of motion of slide"])
        # J phi'' + c phi' + m g l phi = T + m l a (phi turns the bob to -x)
        self.assertAlmostEqual(result["A"][1][0], -2 * 9.81 / 2.1, places=7)
        self.assertAlmostEqual(result["A"][1][1], -0.3 / 2.1, places=7)
        self.assertAlmostEqual(result["B"][1][0], 1 / 2.1, places=7)
        self.assertAlmostEqual(abs(result["B"][1][1]), 2 / 2.1, places=7)
        self.assertAlmostEqual(result["D"][2][1], 6 - 2 * 2 / 2.1, places=7)

        with zipfile.ZipFile(self.folder / "s.npz") as archive:
            self.assertIsNone(archive.testzip())
            arrays = {name[:-4]: npy(archive.read(name)) for name in archive.namelist()}
        matlab = mat((self.folder / "s.mat").read_bytes())
        self.assertEqual(list(arrays), list(matlab))
        for name in "ABCD":
            rows = result[name]
            self.assertEqual(arrays[name], ((len(rows), len(rows[0])), [x for row in rows for x in row]))
            self.assertEqual(matlab[name], rows)
        for name in ("states", "inputs", "outputs"):
            names = [x if isinstance(x, str) else x["name"] for x in result[name]]
            self.assertEqual(arrays[name], ((len(names),), names))
            self.assertEqual(matlab[name], names)
        self.assertEqual(arrays["time"], ((), [0.0]))
        self.assertEqual(matlab["output_units"], ["rad", "m/s2", "N"])

        table = list(csv.reader(io.StringIO((self.folder / "s.csv").read_text(encoding="utf-8"))))
        self.assertEqual(table[0], ["of", *result["states"], "torque [N\u00b7m]", "acceleration of motion of slide [m/s2]"])
        self.assertEqual(table[2][0], "derivative of rate of joint 'pin'")
        self.assertEqual([[float(x) for x in row[1:]] for row in table[1:]],
                         [a + b for a, b in zip(result["A"] + result["C"], result["B"] + result["D"])])

    def test_names_and_places(self):
        done = self.program("linearize", "sledge.yaml", "--inputs", "motion of slide", "--outputs", "motor,pin", "--at", "0.01")
        self.assertIn("4 states, 1 input, 2 outputs at t = 0.01 s", done.stdout)
        for arguments, sentence in (
                (("--inputs", "motion of slid"), "unknown input 'motion of slid', did you mean 'motion of slide'?"),
                (("--outputs", "bop"), "unknown output 'bop', did you mean 'bob'?")):
            done = self.program("linearize", "sledge.yaml", *arguments, code=2)
            self.assertIn(sentence, done.stderr)


if __name__ == "__main__":
    unittest.main()
