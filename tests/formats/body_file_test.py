#!/usr/bin/env python3
"""Opens a body file as a user of Python would, with the standard library only, and recomputes the
inertia integrals from the projection data: another program, another language, the same numbers.
With NumPy the same is `f = numpy.load("bracket_v1.ffb"); f["K"]`, which is tried if it is there."""
import ast
import json
import math
import os
import pathlib
import struct
import unittest
import zipfile

FILE = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "body_files" / "bracket_v1.ffb"


def load(data):
    """A .npy array as (shape, flat list)."""
    assert data[:8] == b"\x93NUMPY\x01\x00"
    length, = struct.unpack("<H", data[8:10])
    header = ast.literal_eval(data[10:10 + length].decode("latin1"))
    assert not header["fortran_order"]
    code, size = {"<f8": ("d", 8), "<i4": ("i", 4), "<i8": ("q", 8)}[header["descr"]]
    values = data[10 + length:]
    return header["shape"], list(struct.unpack(f"<{len(values) // size}{code}", values))


class BodyFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with zipfile.ZipFile(FILE) as archive:
            assert archive.testzip() is None
            cls.header = json.loads(archive.read("header.json"))
            cls.arrays = {name[:-4]: load(archive.read(name)) for name in archive.namelist()
                          if name.endswith(".npy")}

    def close(self, found, expected, scale):
        self.assertEqual(len(found), len(expected))
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=1e-13 * scale)

    def test_header(self):
        self.assertEqual(self.header["format"], "floatframe body")
        self.assertEqual(self.header["format_version"], 1)
        self.assertEqual([m["name"] for m in self.header["markers"]], ["foot", "knee", "eye"])
        self.assertEqual(self.header["provenance"]["units"], "mm-t-s")
        self.assertEqual(self.header["health"]["warnings"], ["the interface 'eye' has few nodes"])

    def test_mass_properties_and_modal_masses_from_the_projection_data(self):
        (n, _), p = self.arrays["projection_p"]
        (_, _, nm), X = self.arrays["projection_X"]
        _, data = self.arrays["projection_M_s_data"]
        _, columns = self.arrays["projection_M_s_indices"]
        _, starts = self.arrays["projection_M_s_indptr"]
        m, m_u = 0.0, [0.0] * 3
        P_u, S, S2, S13 = [0.0] * 9, [0.0] * 3 * nm, [0.0] * 3 * nm, [0.0] * nm * nm
        for k in range(n):
            for e in range(starts[k], starts[k + 1]):
                l, w = columns[e], data[e]
                m += w
                for i in range(3):
                    m_u[i] += w * p[3 * l + i]
                    for j in range(3):
                        P_u[3 * i + j] += w * p[3 * k + i] * p[3 * l + j]
                    for a in range(nm):
                        x = X[(3 * l + i) * nm + a]
                        S[i * nm + a] += w * x
                        S2[i * nm + a] += w * p[3 * k + 1] * x
                for a in range(nm):
                    for b in range(nm):
                        S13[a * nm + b] += w * X[3 * k * nm + a] * X[(3 * l + 2) * nm + b]
        for name, found in (("m", [m]), ("m_u", m_u), ("P_u", P_u), ("S", S), ("S2", S2), ("S13", S13)):
            expected = self.arrays[name][1]
            self.close(found, expected, max(map(abs, expected)))

    def test_frequencies_of_the_header(self):
        (nm, _), K = self.arrays["K"]
        M = [sum(x) for x in zip(*(self.arrays[name][1] for name in ("S11", "S22", "S33")))]
        self.assertEqual(len(self.header["modes"]), nm)
        for k, mode in enumerate(self.header["modes"]):
            w = math.sqrt(K[k * nm + k] / M[k * nm + k])
            self.assertAlmostEqual(mode["frequency_Hz"], w / (2 * math.pi), delta=1e-12 * w)

    def test_sizes(self):
        nm, markers = len(self.header["modes"]), len(self.header["markers"])
        self.assertEqual(self.arrays["marker_X_theta"][0], (markers, 3, nm))
        self.assertEqual(self.arrays["surface_stress"][0], (3, 6, nm))
        self.assertEqual(self.arrays["m"][0], ())

    def test_numpy(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("NumPy is not installed")
        with numpy.load(FILE) as f:
            shape, values = self.arrays["marker_X"]
            self.assertEqual(f["marker_X"].shape, shape)
            self.assertEqual(list(f["marker_X"].ravel()), values)


if __name__ == "__main__":
    unittest.main()
