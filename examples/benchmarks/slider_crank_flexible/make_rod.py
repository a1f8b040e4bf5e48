#!/usr/bin/env python3
"""Writes rod.ffb, the flexible rod of the slider-crank of the Test Set for IVP Solvers (B. Simeon; crank.f).

Its modes, s from the pin along the rod, x = s/L: bending q1 sin(pi x) + q2 sin(2 pi x), axial q3 4 x (1 - x) + q4 (2 x^2 - x).
The axial block of the mass matrix is that of crank.f, without the factor 1/15 of a line element: modal data to be taken as
they are. docs/body-file.md says what the members are.
"""
import json
import pathlib
import struct
import zipfile

L, m, h, E, pi = 0.3, 0.151104, 0.008, 2e11, 3.1415927
k, slender = E * h * h / L, (h / L) ** 2


def zeros(rows, columns=4):
    return [[0.0] * columns for _ in range(rows)]


S = zeros(3)
S[0] = [0, 0, 2 * m / 3, m / 6]
S[1] = [2 * m / pi, 0, 0, 0]
S1 = zeros(3)
S1[0] = [0, 0, L * m / 3, L * m / 6]
S1[1] = [L * m / pi, -0.5 * L * m / pi, 0, 0]
Sij = {f"S{i}{j}": zeros(4) for i in "123" for j in "123"}
Sij["S11"][2][2:], Sij["S11"][3][2:] = [8 * m, m], [m, 2 * m]
Sij["S22"][0][0] = Sij["S22"][1][1] = 0.5 * m
xy = Sij["S12"]
xy[2][0], xy[3][0], xy[3][1] = m * 16 / pi**3, m * (1 / pi - 8 / pi**3), -0.5 * m / pi
Sij["S21"] = [list(row) for row in zip(*xy)]
K = zeros(4)
K[0][0], K[1][1] = k * pi**4 / 24 * slender, k * pi**4 * 2 / 3 * slender
K[2][2:], K[3][2:] = [k * 16 / 3, -k * 8 / 3], [-k * 8 / 3, k * 7 / 3]
at_tip = zeros(3)
at_tip[0][3] = 1.0

ARRAYS = {
    "m": ((), [m]), "m_u": ((3,), [0.5 * m * L, 0, 0]), "P_u": ((3, 3), [[0.0045339259, 0, 0], [0, 0, 0], [0, 0, 0]]),
    "S": ((3, 4), S), "S1": ((3, 4), S1), "S2": ((3, 4), zeros(3)), "S3": ((3, 4), zeros(3)),
    **{name: ((4, 4), block) for name, block in Sij.items()}, "K": ((4, 4), K), "D": ((4, 4), zeros(4)),
    "frequencies": ((0,), []), "marker_p": ((2, 3), [[0, 0, 0], [L, 0, 0]]),
    "marker_X": ((2, 3, 4), [zeros(3), at_tip]), "marker_X_theta": ((2, 3, 4), [zeros(3), zeros(3)]),
    "surface_nodes": ((0,), []), "surface_triangles": ((0, 3), []), "surface_lines": ((0, 2), []),
    "surface_positions": ((0, 3), []), "surface_modes": ((0, 3, 4), []),
}
HEADER = {
    "format": "floatframe body", "format_version": 1, "floatframe": "0.1.0", "units": "SI (m, kg, s, rad)",
    "mass_model": "isoparametric",
    "modes": [{"name": name, "frequency_Hz": None} for name in ("bending 1", "bending 2", "axial 1", "axial 2")],
    "markers": [{"name": name, "interface": False, "kind": None} for name in ("pin", "tip")],
    "provenance": {"source": "crank.f, Test Set for IVP Solvers", "units": "m-kg-s", "options": [], "files": []},
}


def flat(values):
    for value in values:
        if isinstance(value, list):
            yield from flat(value)
        else:
            yield value


def npy(name, shape, values):
    whole = name in ("surface_nodes", "surface_triangles", "surface_lines")
    text = f"{{'descr': '{'<i4' if whole else '<f8'}', 'fortran_order': False, 'shape': {shape}, }}"
    text += " " * (-(len(text) + 11) % 64) + "\n"
    numbers = [float(x) for x in flat(values)]
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode() + struct.pack(f"<{len(numbers)}d", *numbers)


def main():
    with zipfile.ZipFile(pathlib.Path(__file__).parent / "rod.ffb", "w") as out:
        day = (2026, 1, 1, 0, 0, 0)
        out.writestr(zipfile.ZipInfo("header.json", day), json.dumps(HEADER, indent=1))
        for name, (shape, values) in ARRAYS.items():
            out.writestr(zipfile.ZipInfo(name + ".npy", day), npy(name, shape, values))


if __name__ == "__main__":
    main()
