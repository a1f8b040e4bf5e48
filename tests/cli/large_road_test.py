#!/usr/bin/env python3
"""What a large OpenCRG file costs in memory, all in all: at most twice its size, narrow roads with a curved line included."""
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

BINARY = os.environ["FLOATFRAME_BINARY"]
SIZE = 20_000_000

MODEL = """\
floatframe: 1
bodies:
  box: {rigid: {mass: 1, centre_of_mass: [0, 0, 1], inertia: [1, 1, 1]}}
roads:
  long: {crg: %s}
"""


def write_road(path, form, columns, size, curved):
    """The same cross section again and again; a curved line has its heading in front of the heights."""
    numbers = ([0.0625] if curved else []) + [0.001 * (k % 7) for k in range(columns)]
    if form == "KRBI":
        row = struct.pack(f">{len(numbers)}f", *numbers)
    else:
        fields = [f"{x:10.6f}" for x in numbers]
        row = "".join("".join(fields[k:k + 8]) + "\n" for k in range(0, len(fields), 8)).encode()
    channels = ("D:reference line phi,rad\n" if curved else "") + "".join(f"D:long section {k + 1},m\n" for k in range(columns))
    header = f"$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 0.01\n$\n$KD_Definition\n#:{form}\n{channels}$\n$$$$\n"
    piece = row * max(1, 100_000 // len(row))  # the memory of this program counts as that of its child
    with open(path, "wb") as file:
        file.write(header.encode())
        for _ in range(max(2, size // len(piece))):
            file.write(piece)
    return path.stat().st_size


@unittest.skipIf(os.environ.get("FLOATFRAME_SANITIZE"), "the address sanitizer keeps memory of its own")
class LargeRoad(unittest.TestCase):
    def peak(self, folder, *road):
        size = write_road(folder / "road.crg", *road)
        (folder / "model.yaml").write_text(MODEL % "road.crg")
        with subprocess.Popen([BINARY, "check", "model.yaml"], cwd=folder, stdout=subprocess.DEVNULL) as child:
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(child.returncode, 0)
        return size, usage.ru_maxrss * 1024

    def test_memory(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for form, columns, curved, most in (("KRBI", 401, False, 1.1), ("LRFI", 401, False, 1.1), ("KRBI", 6, True, 2.0)):
                with self.subTest(form=form, columns=columns):
                    small = self.peak(folder, form, columns, 0, curved)[1]
                    size, peak = self.peak(folder, form, columns, SIZE, curved)
                    print(f"{form}, {columns} columns: {(peak - small) / size:.2f} of {size / 1e6:.0f} MB", file=sys.stderr)
                    self.assertLess(peak - small, most * size)


if __name__ == "__main__":
    unittest.main()
