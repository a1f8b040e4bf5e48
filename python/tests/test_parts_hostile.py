"""Parts from what is none: exceptions of the package, never a crash."""

import os
import pickle

import floatframe as ff
import numpy as np
import pytest
from blocks import ARM, ENDS, QUICK, STEEL_MM, box, mesh

SOURCES = [None, 3, [], {}, "", "missing.inp", b"file.inp", "\0", os.devnull, ".", object(), np.zeros((3, 3)), float("nan")]


@pytest.mark.parametrize("source", SOURCES, ids=repr)
def test_sources_that_are_none(source):
    for function in (lambda: ff.reduce(source, units="si"), lambda: ff.read_body(source), lambda: ff.info(source)):
        with pytest.raises(ff.InputError):
            function()


CHANGES = [
    {"modes": -1},
    {"modes": 2.5},
    {"modes": "many"},
    {"modes": True},
    {"modes": 10**30},
    {"fmax": np.nan},
    {"fmax": -1.0},
    {"fmax": [1.0]},
    {"effective_mass": 2.0},
    {"damping": np.inf},
    {"damping": -0.1},
    {"method": "guess"},
    {"method": 1},
    {"reference": "node:"},
    {"reference": "node:NOWHERE"},
    {"reference": ["buckens"]},
    {"integration": "exactly"},
    {"solver": "magic"},
    {"solver": "\0"},
    {"units": "furlong"},
    {"units": 3},
    {"free_check": 1},
    {"stresses": "no"},
    {"projection": None, "format": "gmsh"},
    {"nodes": "nodes.csv"},
    {"progress": "often"},
    {"thickness": -1.0},
    {"section": 1.0},
    {"section": ff.BeamSection(1.0, 1.0, np.nan, 1.0)},
    {"section": ff.BeamSection(1.0, 1.0, 1.0, 1.0, (0, 0))},
    {"material": None},
    {"material": (2e11, 0.3, 7850.0)},
    {"material": ff.Material(-1.0, 0.3, 7850.0)},
    {"material": ff.Material(2e11, 0.5, 7850.0)},
    {"material": ff.Material(2e11, 0.3, np.nan)},
    {"material": ff.Material("2e11", 0.3, 7850.0)},
    {"interfaces": [ff.set("A")]},
    {"interfaces": {"A": "A"}},
    {"interfaces": {3: ENDS["A"]}},
    {"interfaces": {"": ENDS["A"]}},
    {"interfaces": {"A": ff.set("NOWHERE")}},
    {"interfaces": {"A": ff.set("")}},
    {"interfaces": {"A": ff.set(3)}},
    {"interfaces": {"A": ff.set("\ud800")}},
    {"interfaces": {"A": ff.node(-1)}},
    {"interfaces": {"A": ff.node(10**9)}},
    {"interfaces": {"A": ff.node(1.0)}},
    {"interfaces": {"A": ff.nodes([])}},
    {"interfaces": {"A": ff.nodes([0, 10**12])}},
    {"interfaces": {"A": ff.nodes([0.5])}},
    {"interfaces": {"A": ff.nodes([True, False])}},
    {"interfaces": {"A": ff.nodes("all")}},
    {"interfaces": {"A": ff.nodes([[1], [2, 3]])}},
    {"interfaces": {"A": ff.nearest([0, 0])}},
    {"interfaces": {"A": ff.nearest([0, 0, np.nan])}},
    {"interfaces": {"A": ff.plane([0, 0, 0], [0, 0, 0])}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "w")}},
    {"interfaces": {"A": ff.plane([9, 0, 0], "x")}},
    {"interfaces": {"A": ff.cylinder([0, 0, 0], "x", -1.0)}},
    {"interfaces": {"A": ff.cylinder([0, 0, 0], "x", 0.1, length=np.inf)}},
    {"interfaces": {"A": ff.sphere([0, 0, 0], None)}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", tolerance=0.0)}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", at=[1, 2])}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", type="loose")}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", dofs="xq")}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", dofs=7)}},
    {"interfaces": {"A": ff.plane([0, 0, 0], "x", residual=True)}},
    {"markers": {"M": ff.node(1, type="mean")}},
    {"markers": {"A": ff.node(1)}},
    {"interfaces": {"A": ff.Place("magic")}},
    {"interfaces": {"A": ff.Place("set")}},
]


@pytest.mark.parametrize("changes", CHANGES, ids=repr)
def test_options_that_are_none(changes):
    with pytest.raises(ff.Error):
        ff.reduce(mesh(), **({"interfaces": ENDS} | QUICK | changes))


def block(points=None, cells=None, word="hex8", **sets):
    p, c = box()
    return ff.Mesh(p if points is None else points, [(word, c if cells is None else cells)], sets)


MESHES = [
    block(points=np.zeros((0, 3))),
    block(points=np.zeros((63, 2))),
    block(points=np.full((63, 3), np.nan)),
    block(points=[["a", "b", "c"]]),
    block(points=np.zeros((63, 3))),
    block(points=np.zeros((63, 3), dtype=complex)),
    block(cells=np.zeros((0, 8), dtype=int)),
    block(cells=np.zeros((3, 8), dtype=int)),
    block(cells=np.zeros((3, 4), dtype=int)),
    block(cells=box()[1] + 1),
    block(cells=box()[1] - 1),
    block(cells=box()[1] + 2**40),
    block(cells=box()[1][:, [4, 5, 6, 7, 0, 1, 2, 3]]),
    block(cells=box()[1].astype(float)),
    block(cells=[[2**63] * 8]),
    block(cells=None, word="hex27"),
    block(cells=None, word=3),
    block(word="tet4", cells=[[0, 1, 2, 3]]),
    ff.Mesh(box()[0], []),
    ff.Mesh(box()[0], None),
    ff.Mesh(box()[0], "hex8"),
    ff.Mesh(box()[0], {"hex8": box()[1]}),
    ff.Mesh(None, None),
    block(END=[1, 2, 99999]),
    block(END=[-1]),
    block(END=np.ones(3, dtype=bool)),
    block(END=None),
    ff.Mesh(box()[0], [("hex8", box()[1])], [1, 2]),
    ff.Mesh(box()[0], [("hex8", box()[1])], {3: [1]}),
]


@pytest.mark.parametrize("given", MESHES, ids=range(len(MESHES)))
def test_meshes_that_are_none(given):
    with pytest.raises(ff.InputError):
        ff.reduce(given, interfaces={"A": ff.nodes([0, 1, 2, 3])}, **QUICK)


def test_meshio_meshes_that_are_none():
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    points, cells = box()
    for kind, which in [("hexahedron27", np.zeros((2, 27), dtype=int)), ("pyramid14", np.zeros((2, 14), dtype=int)), ("quad9", np.zeros((2, 9), dtype=int))]:
        with pytest.raises(ff.InputError, match="found the type"):
            ff.reduce(meshio.Mesh(points, [(kind, which)]), interfaces=ENDS, **QUICK)


def test_parts_are_not_made_by_hand(tmp_path):
    part = ff.reduce(mesh(), interfaces=ENDS, **QUICK)
    with pytest.raises(TypeError):
        ff.Part()
    (tmp_path / "broken.ffb").write_bytes(pickle.dumps(part)[:5000])
    with pytest.raises(ff.InputError):
        ff.read_body(tmp_path / "broken.ffb")
    with pytest.raises(ff.InputError):
        ff.parts._part_of_bytes(b"PK\x03\x04 and no more")
    with pytest.raises(ff.InputError, match="units is missing.*looks like mm-t-s"):
        ff.reduce(ARM, material=STEEL_MM)
