#!/usr/bin/env python3
"""Body files on the command line: whatever `reduce` writes can be read, whatever contradicts itself or is made to harm
is refused in one sentence."""
import io
import itertools
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zipfile

BINARY = os.environ["FLOATFRAME_BINARY"]
DECKS = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"

STEEL = "*MATERIAL, NAME=M\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7850.\n"
EDGES = {"C3D10": "12 23 13 14 24 34", "C3D15": "12 23 31 45 56 64 14 25 36",
         "C3D20": "12 23 34 41 56 67 78 85 15 26 37 48"}
TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
WEDGES = [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)]


def solid(kind):
    """A bar of 3 x 1 x 1 bricks of 0.1 m, cut into elements of this kind, with the sets A and B at its ends."""
    points = [(0.1 * i, 0.1 * j, 0.1 * k) for i in range(4) for j in range(2) for k in range(2)]
    number = {p: n for n, p in enumerate(points)}
    at = lambda i, j, k: number[(0.1 * i, 0.1 * j, 0.1 * k)]
    parts = TETS if kind in ("C3D4", "C3D10") else WEDGES if kind in ("C3D6", "C3D15") else [tuple(range(8))]
    elements = []
    for i in range(3):
        corners = [at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 1, 0), at(i, 1, 0),
                   at(i, 0, 1), at(i + 1, 0, 1), at(i + 1, 1, 1), at(i, 1, 1)]
        for part in parts:
            nodes = [corners[k] for k in part]
            for edge in EDGES.get(kind.rstrip("R"), "").split():
                a, b = (points[nodes[int(c) - 1]] for c in edge)
                middle = tuple((x + y) / 2 for x, y in zip(a, b))
                if middle not in number:
                    number[middle] = len(points)
                    points.append(middle)
                nodes.append(number[middle])
            elements.append(nodes)
    return mesh(points, kind, elements) + f"{STEEL}*SOLID SECTION, ELSET=E, MATERIAL=M\n"


def mesh(points, kind, elements):
    text = "*NODE\n" + "".join(f"{n + 1}, {p[0]!r}, {p[1]!r}, {p[2]!r}\n" for n, p in enumerate(points))
    text += f"*ELEMENT, TYPE={kind}, ELSET=E\n"
    for n, nodes in enumerate(elements):
        fields = [str(n + 1), *(str(k + 1) for k in nodes)]
        text += ",\n".join(", ".join(fields[k:k + 12]) for k in range(0, len(fields), 12)) + "\n"
    last = max(p[0] for p in points)
    for name, x in (("A", 0.0), ("B", last)):
        text += f"*NSET, NSET={name}\n" + "".join(f"{n + 1}\n" for n, p in enumerate(points) if abs(p[0] - x) < 1e-9)
    return text


def shell(kind):
    """A plate of 0.6 m x 0.2 m x 20 mm, bent along its length."""
    points = [(0.1 * i, 0.1 * j, 0.03 * (j - 1) ** 2) for i in range(7) for j in range(3)]
    elements = []
    for i, j in itertools.product(range(6), range(2)):
        a, b, c, d = 3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1
        elements += [[a, b, c, d]] if kind == "S4" else [[a, b, c], [a, c, d]]
    return mesh(points, kind, elements) + f"{STEEL}*SHELL SECTION, ELSET=E, MATERIAL=M\n0.02\n"


def rod(kind, elements, length, section, more=""):
    """A straight rod, askew: elements much shorter than it is thick are the hard case."""
    n = elements * (2 if kind == "B32" else 1)
    points = [(length * k / n, 0.3 * length * k / n, 0.1 * length * k / n) for k in range(n + 1)]
    step = n // elements
    members = [[step * k + i for i in range(step + 1)] for k in range(elements)]
    return mesh(points, kind, members) + f"{STEEL}*BEAM SECTION, ELSET=E, MATERIAL=M, {section}\n0, 0, 1\n{more}"


FLYWHEEL = ("*ELEMENT, TYPE=MASS, ELSET=PM\n900, 5\n*MASS, ELSET=PM\n3.0\n*ELEMENT, TYPE=ROTARYI, ELSET=PR\n901, 5\n"
            "*ROTARY INERTIA, ELSET=PR\n0.02, 0.01, 0.01, 0, 0, 0\n")


def bars():
    """Nastran bars with a point mass off its node."""
    cards = ["CEND", "BEGIN BULK", "MAT1,1,2.1E11,,0.3,7850.0", "PBAR,1,1,3.14E-4,7.85E-9,7.85E-9,1.57E-8"]
    cards += [f"GRID,{k + 1},,{0.01 * k:.3f},0.0,0.0" for k in range(41)]
    cards += [f"CBAR,{k + 1},1,{k + 1},{k + 2},0.0,0.0,1.0" for k in range(40)]
    return "\n".join(cards + ["CONM2,100,20,,0.5,0.0,0.02,0.0", ",1.E-3,,1.E-3,,,1.E-3", "ENDDATA"]) + "\n"


SETS = ("A=set:A", "B=set:B")
PARTS = {f"{kind}.inp": (solid(kind), SETS) for kind in
         ("C3D4", "C3D6", "C3D8", "C3D8I", "C3D8R", "C3D10", "C3D15", "C3D20")}
PARTS |= {f"{kind}.inp": (shell(kind), SETS) for kind in ("S3", "S4")}
PARTS |= {
    "thin.inp": (rod("B31", 40, 0.4, "SECTION=RECT\n0.02, 0.02"), SETS),
    "flat.inp": (rod("B31", 40, 0.4, "SECTION=RECT\n0.002, 0.04"), SETS),
    "stub.inp": (rod("B31", 20, 0.05, "SECTION=RECT\n0.02, 0.02"), SETS),
    "coarse.inp": (rod("B31", 4, 1.0, "SECTION=RECT\n0.02, 0.02", FLYWHEEL), SETS),
    "b32.inp": (rod("B32", 20, 0.4, "SECTION=RECT\n0.02, 0.02", FLYWHEEL), SETS),
    "bars.bdf": (bars(), ("A=node:1", "B=node:41")),
}


class Archive:
    """A body file whose members can be replaced."""

    def __init__(self, path):
        with zipfile.ZipFile(path) as archive:
            self.members = {name: archive.read(name) for name in archive.namelist()}

    @property
    def header(self):
        return json.loads(self.members["header.json"])

    def scaled(self, name, factor):
        data = self.members[name]
        length, = struct.unpack("<H", data[8:10])
        values = struct.unpack(f"<{(len(data) - 10 - length) // 8}d", data[10 + length:])
        return data[:10 + length] + struct.pack(f"<{len(values)}d", *(factor * x for x in values))

    def write(self, path, **changed):
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as archive:
            for name, content in self.members.items():
                archive.writestr(name, changed.get(name.split(".")[0], content))
        path.write_bytes(out.getvalue())


class BodyFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="floatframe-bodies-")
        cls.folder = pathlib.Path(cls.holder.name)
        for name, (text, _) in PARTS.items():
            (cls.folder / name).write_text(text)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def floatframe(self, *arguments, **environment):
        return subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=250, check=False, env={**os.environ, **environment})

    def reduce(self, name, *options, interfaces=None, units="m-kg-s"):
        """Reduced, and read again."""
        given = PARTS[name][1] if interfaces is None else interfaces
        chosen = [word for way in given for word in ("--interface", way)]
        done = self.floatframe("reduce", name, "--units", units, "--quiet", "--no-free-check", "--no-stress", *chosen,
                               *options, "-o", "part.ffb")
        self.assertEqual(done.returncode, 0, f"{name} {options}: {done.stderr}")
        read = self.floatframe("info", "part.ffb", "--json")
        self.assertEqual(read.returncode, 0, f"{name} {options}: {read.stderr}")
        return json.loads(read.stdout)

    def test_every_kind_of_element_is_read_again(self):
        for name in PARTS:
            info = self.reduce(name, "--modes", "4")
            self.assertEqual(len(info["modes"]), 10, name)
            rotary = not name.startswith("C3D")
            self.assertEqual(info["health"]["rotary_inertia"], rotary, name)

    def test_every_method_is_read_again(self):
        for name in ("C3D8I.inp", "S4.inp", "thin.inp", "bars.bdf"):
            self.reduce(name, "--method", "free_free", "--modes", "5", interfaces=[])
            self.reduce(name, "--method", "craig_chang", "--modes", "5", "--projection")
            self.reduce(name, "--modes", "2", "--reference", "node:B", "--projection")
            self.reduce(name, "--modes", "2", "--reference", "buckens", "--damping", "0.01")

    def test_parts_without_modes(self):
        for name in ("C3D8.inp", "S3.inp", "thin.inp", "bars.bdf"):
            info = self.reduce(name, "--modes", "0", "--projection", interfaces=PARTS[name][1][:1])
            self.assertEqual(info["modes"], [])
            self.assertEqual(len(self.reduce(name, "--modes", "0")["modes"]), 6)

    def test_many_interfaces(self):
        nodes = [f"N{k}=node:{k}" for k in range(1, 41, 8)]
        self.assertEqual(len(self.reduce("thin.inp", "--modes", "0", interfaces=nodes)["modes"]), 24)

    def test_parts_of_other_programs(self):
        self.reduce(DECKS / "two_bricks.sti.gz", "--modes", "2", interfaces=["A=plane:0,0,0,normal=z"])
        for name in ("beam_b31_free.inp", "beam_b32r_free.inp", "beam_c3d20r_free.inp"):
            self.reduce(DECKS / name, "--modes", "4", interfaces=["A=set:END_A", "B=set:END_B"])

    def test_rigid_motions_with_stiffness_are_an_error(self):
        text = mesh([(0.1 * k, 0.0, 0.0) for k in range(1001)], "B31", [[k, k + 1] for k in range(1000)])
        (self.folder / "wire.inp").write_text(
            f"{text}{STEEL}*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.001, 0.001\n0, 1, 0\n")
        done = self.floatframe("reduce", "wire.inp", "--units", "m-kg-s", "--quiet", "--no-stress", "--interface",
                               "A=set:A", "--interface", "B=set:B", "--modes", "4", "-o", "wire.ffb")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, "a rigid motion has an eigenvalue of .* instead of zero|digits")
        self.assertFalse((self.folder / "wire.ffb").exists())

    def test_a_part_that_is_kept_and_cannot_be_read_is_named(self):
        block = ("{part: {file: thin.inp, units: m-kg-s, interfaces: {A: {set: A}, B: {set: B}}, modes: 2, "
                 "free_check: false}}")
        (self.folder / "m.yaml").write_text(
            f"floatframe: 1\nbodies: {{p: {block}}}\n"
            "joints: {j: {type: revolute, child: p, child_node: A, axis: y}}\nsimulation: {duration: 0.01}\n")
        cache = self.folder / "cache"
        first = self.floatframe("check", "m.yaml", FLOATFRAME_CACHE=str(cache))
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertIn("kept in", first.stderr)
        second = self.floatframe("check", "m.yaml", FLOATFRAME_CACHE=str(cache))
        self.assertIn("from the cache", second.stderr)
        kept, = cache.glob("*.ffb")
        kept.write_bytes(kept.read_bytes()[:1000])
        third = self.floatframe("check", "m.yaml", FLOATFRAME_CACHE=str(cache))
        self.assertEqual(third.returncode, 0, third.stderr)
        self.assertIn("what was kept cannot be read: ", third.stderr)
        self.assertIn("truncated or damaged", third.stderr)

    def refused(self, archive, sentence, **changed):
        archive.write(self.folder / "bad.ffb", **changed)
        done = self.floatframe("info", "bad.ffb")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(sentence, done.stderr)
        self.assertLess(len(done.stderr), 1000)

    def test_a_file_that_contradicts_itself(self):
        self.reduce("C3D8I.inp", "--modes", "3")
        good = Archive(self.folder / "part.ffb")
        for factor in (1e6, -1.0, 0.0):
            self.refused(good, "member 'marker_X.npy': marker 'A' moves",
                         marker_X=good.scaled("marker_X.npy", factor))
        self.refused(good, "Hz for normal mode 1, but the health report gives",
                     frequencies=good.scaled("frequencies.npy", 2.0))

        def header(**changed):
            out = good.header
            for key, value in changed.items():
                *path, last = key.split("__")
                inner = out
                for step in path:
                    inner = inner[int(step) if step.isdigit() else step]
                inner[last] = value
            return json.dumps(out)

        self.refused(good, "of the elements", header=header(health__from_elements__mass_kg=1.0))
        self.refused(good, "found the frequency_Hz \"1.0\" of mode 1, expected a number",
                     header=header(modes__0__frequency_Hz="1.0"))
        self.refused(good, "found the surface point 99999 for marker 'A'",
                     header=header(markers__0__moves_with=[99999]))
        self.refused(good, "expected a list of surface points", header=header(markers__0__moves_with="1"))
        # A text that a terminal obeys.
        self.refused(good, r"found the marker name 'A\x1b[31m'", header=header(markers__0__name="A\x1b[31m"))
        self.refused(good, r"found the mode name 'a\x00b'", header=header(modes__0__name="a\0b"))
        self.refused(good, "found format version \"aaaa", header=header(format_version="a" * 100000))

    def test_control_bytes_are_written_out(self):
        self.reduce("C3D8.inp", "--modes", "1")
        good = Archive(self.folder / "part.ffb")
        header = good.header
        header["provenance"]["source"] = "x\x1b[31m.inp\n  forged"
        header["health"]["warnings"] = ["\x1b[2Jhello"]
        good.write(self.folder / "esc.ffb", header=json.dumps(header))
        done = self.floatframe("info", "esc.ffb")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("\x1b", done.stdout)
        self.assertIn(r"x\x1b[31m.inp\n  forged", done.stdout)
        self.assertIn(r"\x1b[2Jhello", done.stdout)

    def test_headers_that_nest_deeply(self):
        self.reduce("C3D8.inp", "--modes", "1")
        good = Archive(self.folder / "part.ffb")
        for key in ("units", "format", "format_version", "mass_model", "modes", "markers", "health", "provenance",
                    "other"):
            header = good.header
            header[key] = "@@"
            text = json.dumps(header).replace('"@@"', "[" * 300000 + "]" * 300000)
            self.refused(good, "nests deeper than 64 levels", header=text)


if __name__ == "__main__":
    unittest.main()
