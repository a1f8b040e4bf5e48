#!/usr/bin/env python3
"""First free frequencies of a plate with a rib under its middle line: shells and beams with offsets against solids.

    scripts/stiffened_plate.py [--build build]

Prints the table of docs/finite-elements.md (Stiffeners). Exit code 1 if a model with offsets differs from the solids by more than 1 %
in one of the first five frequencies. The row of CalculiX is left out where `ccx` is not installed.
"""
import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

LENGTH, WIDTH, THICKNESS, RIB_WIDTH, RIB_HEIGHT = 1.0, 0.6, 0.01, 0.01, 0.05
ARM = 0.5 * (THICKNESS + RIB_HEIGHT)  # of the middle of the rib
MATERIAL = "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, .3\n*DENSITY\n7850.\n"
COUNT = 5


def numbers(values):
    return ", ".join(map(str, values)) + "\n"


def shells(nx, ny, by_equations=False):
    """S8 and B32 with OFFSET2, or on nodes of their own that equations of the deck tie rigidly to the plate."""
    columns = 2 * nx + 1
    places = {}
    for j in range(2 * ny + 1):
        for i in range(columns):
            if i % 2 == 0 or j % 2 == 0:
                places[i, j] = (1 + i + columns * j, LENGTH * i / (2 * nx), WIDTH * (j / (2 * ny) - 0.5), 0.0)
    node = {place: values[0] for place, values in places.items()}
    text = "*NODE\n" + "".join(map(numbers, places.values()))
    rib = [node[i, ny] for i in range(columns)]
    if by_equations:
        own = [100000 + n for n in rib]
        text += "".join(numbers((own[i], LENGTH * i / (2 * nx), 0.0, -ARM)) for i in range(columns))
    text += "*ELEMENT, TYPE=S8, ELSET=P\n"
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    cells = [(2 * i, 2 * j) for j in range(ny) for i in range(nx)]
    for e, (i, j) in enumerate(cells):
        text += numbers([1 + e] + [node[i + a, j + b] for a, b in around])
    text += "*ELEMENT, TYPE=B32, ELSET=R\n"
    line = own if by_equations else rib
    for i in range(nx):
        text += numbers([50000 + i] + line[2 * i:2 * i + 3])
    offset = "" if by_equations else f", OFFSET2={ARM / RIB_HEIGHT}"
    text += MATERIAL + f"*SHELL SECTION, ELSET=P, MATERIAL=M\n{THICKNESS}\n*BEAM SECTION, ELSET=R, MATERIAL=M, SECTION=RECT{offset}\n"
    text += numbers((RIB_WIDTH, RIB_HEIGHT)) + "0., 1., 0.\n"
    if by_equations:  # u' = u + theta x (0, 0, -ARM)
        text += "*EQUATION\n"
        for a, n in zip(own, rib):
            text += f"3\n{a}, 1, 1., {n}, 1, -1., {n}, 5, {ARM}\n3\n{a}, 2, 1., {n}, 2, -1., {n}, 4, {-ARM}\n"
            text += "".join(f"2\n{a}, {dof}, 1., {n}, {dof}, -1.\n" for dof in (3, 4, 5, 6))
    return text


def solids(nx=40, ny=12):
    """C3D20R: one through the plate and the width of the rib, three in its height, ny on either side of it."""
    half = [-WIDTH / 2 + (WIDTH / 2 - RIB_WIDTH / 2) * k / ny for k in range(ny + 1)]
    planes = [[LENGTH * k / nx for k in range(nx + 1)], half + [-y for y in reversed(half)],
              [-THICKNESS / 2 - RIB_HEIGHT * (3 - k) / 3 for k in range(4)] + [THICKNESS / 2]]
    x, y, z = ([p for a, b in zip(values, values[1:]) for p in (a, (a + b) / 2)] + values[-1:] for values in planes)
    corners = ((0, 0), (2, 0), (2, 2), (0, 2))
    middles = ((1, 0), (2, 1), (1, 2), (0, 1))
    around = [(a, b, c) for c in (0, 2) for a, b in corners] + [(a, b, c) for c in (0, 2) for a, b in middles] + [(a, b, 1) for a, b in corners]
    node, elements = {}, []
    for i in range(nx):
        for j in range(2 * ny + 1):
            for k in range(4):
                if k == 3 or j == ny:
                    elements.append([node.setdefault((2 * i + a, 2 * j + b, 2 * k + c), len(node) + 1) for a, b, c in around])
    text = "*NODE\n" + "".join(numbers((n, x[i], y[j], z[k])) for (i, j, k), n in node.items()) + "*ELEMENT, TYPE=C3D20R, ELSET=E\n"
    for e, nodes in enumerate(elements):
        text += f"{e + 1}, {', '.join(map(str, nodes[:15]))},\n{numbers(nodes[15:])}"
    return text + MATERIAL + "*SOLID SECTION, ELSET=E, MATERIAL=M\n"


def nastran(nx, ny):
    def node(i, j):
        return 1 + i + (nx + 1) * j

    width, height = RIB_WIDTH, RIB_HEIGHT
    torsion = height * width**3 * (1 / 3 - 0.21 * width / height * (1 - (width / height)**4 / 12))
    lines = ["SOL 103", "CEND", "BEGIN BULK", "PARAM,COUPMASS,1"]
    lines += [f"GRID,{node(i, j)},,{LENGTH * i / nx:.6f},{WIDTH * (j / ny - 0.5):.6f},0." for j in range(ny + 1) for i in range(nx + 1)]
    lines += [f"CQUAD4,{1 + i + nx * j},1,{node(i, j)},{node(i + 1, j)},{node(i + 1, j + 1)},{node(i, j + 1)}" for j in range(ny) for i in range(nx)]
    for i in range(nx):
        lines.append(f"CBAR,{50000 + i},2,{node(i, ny // 2)},{node(i + 1, ny // 2)},0.,0.,1.\n,,,0.,0.,{-ARM},0.,0.,{-ARM}")
    lines += [f"PSHELL,1,1,{THICKNESS},1", "MAT1,1,2.1e11,,.3,7850.",
              f"PBAR,2,1,{width * height:.6e},{width * height**3 / 12:.6e},{height * width**3 / 12:.6e},{torsion:.6e}", "ENDDATA"]
    return "\n".join(lines) + "\n"


def ours(build, file):
    command = [build / "tests" / "deck_modes", "modes", file, "--modes", str(6 + COUNT)]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["frequencies"]
    return sorted(f for f in found if f > 1.0)[:COUNT]


def calculix(file):
    deck = file.with_name("ccx.inp")
    deck.write_text(file.read_text() + f"*STEP\n*FREQUENCY\n{12 + COUNT}\n*END STEP\n")
    subprocess.run(["ccx", "ccx"], cwd=file.parent, check=True, capture_output=True)
    found = []
    for line in deck.with_suffix(".dat").read_text().splitlines():
        words = line.split()
        if "P A R T I C I P A T I O N" in line:
            break
        if len(words) == 5 and words[0].isdigit():
            found.append(float(words[3]))
    return sorted(f for f in found if f > 1.0)[:COUNT]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=Path("build"))
    build = parser.parse_args().build.resolve()
    rows = [("solids: 40 x 25 C3D20R, three in the height of the rib", "solids.inp", solids(), False),
            ("10 x 6 S8 and B32 with OFFSET2", "coarse.inp", shells(10, 6), True),
            ("20 x 12 S8 and B32 with OFFSET2", "fine.inp", shells(20, 12), True),
            ("20 x 12 CQUAD4 and CBAR with offsets", "bars.bdf", nastran(20, 12), True),
            ("10 x 6 S8 and B32 on arms by equations of the deck", "arms.inp", shells(10, 6, True), False)]
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        table = []
        for what, name, text, with_offsets in rows:
            file = Path(folder) / name
            file.write_text(text)
            table.append((what, ours(build, file), with_offsets))
        if shutil.which("ccx"):
            table.append(("10 x 6 S8 and B32 with OFFSET2 in CalculiX", calculix(Path(folder) / "coarse.inp"), False))
    reference = table[0][1]
    for what, found, with_offsets in table:
        print(f"{what:56}" + "".join(f"{f:9.2f}" for f in found))
        failed |= with_offsets and any(abs(f - r) > 0.01 * r for f, r in zip(found, reference, strict=True))
    if failed:
        print("a model with offsets differs from the solids by more than 1 %", file=sys.stderr)
    return failed


if __name__ == "__main__":
    sys.exit(main())
