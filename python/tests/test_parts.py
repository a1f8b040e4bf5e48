"""Parts: reductions of files and meshes against the command line and against each other, views, reports, hostile input."""

import copy
import gc
import gzip
import inspect
import io
import json
import os
import pickle
import signal
import subprocess
import threading
import time
import weakref
import zipfile
from contextlib import redirect_stderr

import floatframe as ff
import numpy as np
import pytest
from blocks import ARM, ENDS, QUICK, STEEL_MM, box, mesh


@pytest.fixture(scope="module")
def part():
    return ff.reduce(mesh(), interfaces=ENDS, **QUICK)


@pytest.fixture(scope="module")
def arm_arguments():
    places = {"BUSH_F": ff.set("BUSH_F"), "BUSH_R": ff.set("BUSH_R"), "BALL": ff.set("BALL", type="mean", dofs="xyz")}
    markers = {"DAMP": ff.set("DAMP_F", at=[1.0, 2.0, 3.0], residual=True)}
    return {"interfaces": places, "markers": markers, "modes": 4, "reference": "node:BUSH_F", "free_check": False}


@pytest.fixture(scope="module")
def arm(arm_arguments):
    return ff.reduce(ARM, units="mm-t-s", material=STEEL_MM, projection=True, damping=0.01, **arm_arguments)


def header_and_arrays(path):
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files if name != "header.json"}
    header = json.loads(zipfile.ZipFile(path).read("header.json"))
    header["provenance"].pop("date")
    header["health"].pop("seconds")
    return header, arrays


def test_damping_is_given_by_the_keys_of_model_files(arm_arguments):
    arguments = arm_arguments | {"reference": "mean_axis"}

    def reduced(damping):
        return ff.reduce(ARM, units="mm-t-s", material=STEEL_MM, damping=damping, **arguments)

    mounted = reduced({"fraction": 0.02, "reference": "mounted"})
    assert np.allclose(mounted.body.damped_modes("mounted")[:, 1], 0.02, rtol=1e-6)
    free = reduced(np.float64(0.02)).body
    assert np.allclose(free.damped_modes()[:, 1], 0.02, rtol=1e-6)
    assert np.allclose(free.damped_modes("frame"), free.damped_modes("free"), rtol=1e-6)
    rayleigh = reduced({"rayleigh": (0.0, 1e-6)}).body
    assert np.allclose(rayleigh.D, 1e-6 * rayleigh.K, atol=1e-12 * rayleigh.K.max())
    assert np.allclose(reduced([0.01, 0.03]).body.damped_modes()[:3, 1], [0.01, 0.03, 0.03], rtol=1e-6)
    bands = {"bands": [[1e5, 0.01], 0.5], "reference": "free"}
    assert np.allclose(reduced(bands).body.damped_modes()[:4, 1], 0.01, rtol=1e-6)
    assert dict(reduced({"bands": "usual"}).provenance["options"])["damping"] == "bands:100=0.01,1000=0.1,1"
    for wrong in ({"fraction": 0.1, "bands": "usual"}, {"share": 0.1}, {"bands": "all"}, "much", {"fraction": 0.1, "reference": "held"}):
        with pytest.raises(ff.InputError, match="damping"):
            reduced(wrong)


def test_a_file_gives_the_body_of_the_command_line(arm, tmp_path):
    arm.save(tmp_path / "python.ffb")
    command = [ff.program(), "reduce", str(ARM), "--units", "mm-t-s", "--material", "200000.0,0.3,7.85e-09", "--modes", "4"]
    command += ["--interface", "BUSH_F=set:BUSH_F", "--interface", "BUSH_R=set:BUSH_R"]
    command += ["--interface", "BALL=set:BALL,type=mean,dofs=xyz", "--marker", "DAMP=set:DAMP_F,at=1,2,3,residual"]
    command += ["--reference", "node:BUSH_F", "--no-free-check", "--projection", "--damping", "0.01", "--quiet"]
    printed = subprocess.run([*command, "-o", tmp_path / "command.ffb"], check=True, capture_output=True, text=True).stdout
    (header, arrays), (header_c, arrays_c) = (header_and_arrays(tmp_path / f"{n}.ffb") for n in ("python", "command"))
    assert header == header_c and arrays.keys() == arrays_c.keys()
    for name in arrays:
        assert np.array_equal(arrays[name], arrays_c[name]), name

    def without_times(text):
        return text.split("Time (solver")[0]

    assert without_times(str(arm.report)) == without_times(printed)
    again = ff.read_body(tmp_path / "python.ffb")
    assert np.array_equal(again.mode_shapes, arm.mode_shapes) and str(again.report) == str(arm.report)
    assert ff.info(tmp_path / "python.ffb")["modes"] and "DAMP" in str(ff.info(tmp_path / "python.ffb"))


def test_every_option_of_the_command_is_there():
    parameters = set(inspect.signature(ff.reduce).parameters)
    assert set(ff._core.reduce_options()) <= parameters
    assert parameters - set(ff._core.reduce_options()) == {"source", "section", "progress"}


def test_thickness_of_surfaces_of_a_file(tmp_path):
    file = tmp_path / "plate.msh"
    file.write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"RIB\"\n$EndPhysicalNames\n$Nodes\n6\n"
        "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n6 2 1 0\n$EndNodes\n"
        "$Elements\n2\n1 3 2 1 1 1 2 3 4\n2 3 2 0 2 2 5 6 3\n$EndElements\n"
    )
    steel = ff.Material(2.1e11, 0.3, 7850)
    info = ff.info(file, material=steel, thickness={"RIB": 0.01, "": 0.004})
    assert info["mass"] == pytest.approx(7850 * 0.014, rel=1e-12)
    held = {"A": ff.node(1)}
    assert ff.reduce(file, units="m-kg-s", thickness=0.01, interfaces=held, **QUICK).invariants.m == pytest.approx(157.0)
    ff.convert(file, tmp_path / "plate.inp", material=steel, thickness=0.01)
    assert "SHELL SECTION" in (tmp_path / "plate.inp").read_text().upper()
    for wrong in ("thick", True, {1: 0.01}, {"RIB": None}):
        with pytest.raises(ff.InputError, match="thickness: found"):
            ff.info(file, thickness=wrong)


def test_all_ways_of_choosing_nodes(arm_arguments):
    points, cells = box()
    ways = {
        "SET": (ff.set("END"), 9),
        "PLANE": (ff.plane([0.6, 0, 0], "-x", tolerance=1e-6), 9),
        "VECTOR": (ff.plane(np.array([0.6, 0, 0]), [1, 0, 0]), 9),
        "CYLINDER": (ff.cylinder([0, 0.05, 0.05], "x", 0.05 * 2**0.5, length=0.25), 8),
        "SPHERE": (ff.sphere([0.6, 0.05, 0.05], 0.05, tolerance=1e-6), 4),
        "MASK": (ff.nodes(points[:, 0] > 0.55), 9),
        "INDICES": (ff.nodes(np.flatnonzero(points[:, 0] > 0.55)), 9),
    }
    block = ff.Mesh(points, [("hex8", cells)], {"END": points[:, 0] > 0.55})
    for name, (place, count) in ways.items():
        part = ff.reduce(block, interfaces={name: place}, **QUICK)
        assert part.report.interfaces[0].nodes == count, name
    part = ff.reduce(block, interfaces=ENDS, markers={"M": ff.node(7), "N": ff.nearest(points[7] + 1e-4)}, **QUICK)
    assert np.allclose(part.body.nodes["M"].p, points[7]) and np.allclose(part.body.nodes["N"].p, points[7])
    assert np.array_equal(part.body.nodes["M"].X, part.body.nodes["N"].X)


def test_a_mesh_is_the_part_of_its_file(arm, arm_arguments, tmp_path):
    """The same nodes and elements by meshio. Nodes of sets come in another order, so sums are rounded otherwise; stiffness has
    that error relative to its largest entry."""
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    (tmp_path / "arm.msh").write_bytes(gzip.decompress(ARM.read_bytes()))
    given = meshio.read(tmp_path / "arm.msh")
    part = ff.reduce(given, units="mm-t-s", material=STEEL_MM, projection=True, damping=0.01, **arm_arguments)
    assert part.report.dofs == arm.report.dofs and part.provenance["source"] == "Mesh"
    largest = arm.frequencies.max() ** 2
    assert np.abs(part.frequencies**2 - arm.frequencies**2).max() < 1e-9 * largest
    assert np.array_equal(part.node_indices, arm.node_indices) and np.allclose(part.nodes, arm.nodes, rtol=0, atol=1e-15)
    assert part.invariants.m == pytest.approx(arm.invariants.m, rel=1e-12)
    assert np.allclose(part.invariants.P_u, arm.invariants.P_u, rtol=1e-9, atol=1e-12)


def test_solids_of_all_types_have_the_mass_of_the_block():
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    points, cells = box((4, 2, 2))
    tets = cells[:, [[0, 1, 3, 4], [1, 2, 3, 6], [1, 3, 4, 6], [1, 4, 5, 6], [3, 4, 6, 7]]].reshape(-1, 4)
    wedges = cells[:, [[0, 1, 3, 4, 5, 7], [1, 2, 3, 5, 6, 7]]].reshape(-1, 6)
    for name, corner in [("hexahedron", cells), ("tetra", tets), ("wedge", wedges)]:
        for quadratic in (False, True):
            p, c, kind = (*with_middles(points, corner), QUADRATIC[name]) if quadratic else (points, corner, name)
            # meshio 5.3 knows the name wedge15 but cannot hold such cells
            given = ff.Mesh(p, [(kind, c)]) if kind == "wedge15" else meshio.Mesh(p, [(kind, c)])
            part = ff.reduce(given, interfaces=ENDS, **QUICK)
            assert part.invariants.m == pytest.approx(0.006 * 7850, rel=1e-12), kind
            assert part.report.from_elements.centre == pytest.approx([0.3, 0.05, 0.05], rel=1e-9), kind
            assert part.report.elements == len(corner)


QUADRATIC = {"hexahedron": "hexahedron20", "tetra": "tetra10", "wedge": "wedge15"}
EDGES = {
    8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
}


def with_middles(points, cells):
    """Nodes in the middle of edges, in the order of VTK."""
    found, extra, columns = {}, [], []
    for a, b in EDGES[cells.shape[1]]:
        column = []
        for i, j in np.sort(cells[:, [a, b]], axis=1):
            if (i, j) not in found:
                found[i, j] = len(points) + len(extra)
                extra.append(0.5 * (points[i] + points[j]))
            column.append(found[i, j])
        columns.append(column)
    return np.vstack([points, extra]), np.column_stack([cells, *columns])


def test_pyvista_meshes_with_wedges_of_either_hand():
    pyvista = pytest.importorskip("pyvista", reason="pyvista is not installed")
    points, cells = box((4, 2, 2))
    wedges = cells[:, [[0, 1, 3, 4, 5, 7], [1, 2, 3, 5, 6, 7]]].reshape(-1, 6)
    wedges[::2] = wedges[::2][:, [0, 2, 1, 3, 5, 4]]  # as VTK has them
    grid = pyvista.UnstructuredGrid({pyvista.CellType.WEDGE: wedges}, points)
    part = ff.reduce(grid, interfaces=ENDS, **QUICK)
    assert part.invariants.m == pytest.approx(0.006 * 7850, rel=1e-12)
    p, c = with_middles(points, wedges)
    part = ff.reduce(pyvista.UnstructuredGrid({pyvista.CellType.QUADRATIC_WEDGE: c}, p), interfaces=ENDS, **QUICK)
    assert part.invariants.m == pytest.approx(0.006 * 7850, rel=1e-12)
    hexahedra = pyvista.UnstructuredGrid({pyvista.CellType.HEXAHEDRON: cells}, points)
    same = ff.reduce(ff.Mesh(points, [("hex8", cells)]), interfaces=ENDS, **QUICK)
    assert np.array_equal(ff.reduce(hexahedra, interfaces=ENDS, **QUICK).body.K, same.body.K)
    image = pyvista.ImageData(dimensions=(5, 3, 3), spacing=(0.15, 0.05, 0.05))
    for voxels in (image, image.cast_to_unstructured_grid()):
        assert ff.reduce(voxels, interfaces=ENDS, **QUICK).frequencies == pytest.approx(same.frequencies, rel=1e-6)
    with pytest.raises(ff.InputError, match="found list, expected a file, a floatframe.Mesh, a meshio"):
        ff.reduce([image], interfaces=ENDS, **QUICK)


def test_sets_of_meshio(tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    points, cells = box()
    ends = np.array([[0, 1, 4, 3], [1, 2, 5, 4]])  # two quadrilaterals at x = 0
    sets = {"FACE": [[], [0, 1]], "gmsh:bounding_entities": [[0], [0]]}
    given = meshio.Mesh(
        points, [("hexahedron", cells), ("quad", ends)], point_sets={"TIP": np.flatnonzero(points[:, 0] > 0.5)}, cell_sets=sets
    )
    part = ff.reduce(given, interfaces={"F": ff.set("FACE"), "T": ff.set("TIP")}, **QUICK)
    assert [i.nodes for i in part.report.interfaces] == [6, 18 - 9]
    assert part.report.elements == len(cells)  # quadrilaterals of a solid are no shells
    with pytest.raises(ff.InputError, match="FACE"):
        ff.reduce(given, interfaces={"F": ff.set("FACES")}, **QUICK)


def test_shells_and_beams():
    x = np.linspace(0.0, 1.0, 11)
    line = ff.Mesh(np.column_stack([x, 0 * x, 0 * x]), [("beam2", np.column_stack([np.arange(10), np.arange(1, 11)]))])
    section = ff.BeamSection(1e-4, 1e-9, 2e-9, 3e-9, reference=(0, 1, 0))
    part = ff.reduce(line, section=section, interfaces={"ROOT": ff.node(0)}, reference="node:ROOT", **QUICK)
    first = 1.8751040687**2 / (2 * np.pi) * (2e11 * 1e-9 / (7850 * 1e-4)) ** 0.5
    assert part.report.normal_modes[0].frequency == pytest.approx(first, rel=1e-3)
    points, cells = box((4, 4, 1), (1.0, 1.0, 0.01))
    plate = ff.Mesh(points[points[:, 2] == 0], [("quad4", np.unique(cells[:, :4] // 2, axis=0))])
    held = {"A": ff.plane([0, 0, 0], "x")}
    part = ff.reduce(plate, thickness=0.01, interfaces=held, **QUICK)
    assert part.invariants.m == pytest.approx(78.5)
    with pytest.raises(ff.InputError, match="thickness is missing"):
        ff.reduce(plate, interfaces=held, **QUICK)
    with pytest.raises(ff.InputError, match="section is missing"):
        ff.reduce(line, interfaces={"ROOT": ff.node(0)}, **QUICK)


def test_units_of_meshes(part):
    points, cells = box()
    mm = ff.Mesh(1000 * points, [("hex8i", cells)])
    ends = {"A": ff.plane([0, 0, 0], "x"), "B": ff.plane([600, 0, 0], "x")}
    other = ff.reduce(mm, units="mm-t-s", interfaces=ends, **(QUICK | {"material": ff.Material(2e5, 0.3, 7.85e-9)}))
    assert other.frequencies == pytest.approx(part.frequencies, rel=1e-9)
    assert other.invariants.m == pytest.approx(part.invariants.m, rel=1e-12) and np.allclose(other.nodes, part.nodes)


def test_views_share_memory_and_outlive_the_part(arm_arguments):
    part = ff.reduce(mesh(), interfaces=ENDS, **QUICK)
    n, nm = len(part.nodes), part.body.modes
    assert part.mode_shapes.shape == (n, 3, nm) and part.triangles.shape[1] == 3 and part.lines.shape == (0, 2)
    assert np.shares_memory(part.mode_shapes, part.mode_shapes) and np.shares_memory(part.invariants.S, part.body.invariants.S)
    kept = [part.nodes, part.mode_shapes, part.triangles, part.node_indices, part.invariants.Sij[0][0], part.body.K]
    kept += list(part.body.nodes["B"])
    before = [a.copy() for a in kept]
    gone = weakref.ref(part)
    del part
    gc.collect()
    assert gone() is None
    _ = [np.full(a.size, 7, dtype=a.dtype) for a in before for _ in range(20)]  # memory that is free is written over
    assert all(np.array_equal(a, b) for a, b in zip(kept, before, strict=True))
    for a in kept:
        assert not a.flags.owndata
        with pytest.raises(ValueError, match="read-only"):
            a[...] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            a.flags.writeable = True
    del kept
    gc.collect()


def test_modes_of_the_surface_are_those_of_nodes(arm):
    p = arm.body.projection
    assert np.array_equal(arm.nodes, p.p[arm.node_indices]) and np.array_equal(arm.mode_shapes, p.X[arm.node_indices])
    y = 1e-4 * np.arange(1, arm.body.modes + 1)
    motion = ([[1, 0, 0], [0, 0, -1], [0, 1, 0]], y, [1, 2, 3], 10 * y)
    for coordinates in ("absolute", "relative"):
        M, Qv = arm.body.inertia(*motion, method="projection", coordinates=coordinates)
        N, Rv = arm.body.inertia(*motion, method="preprocessing", coordinates=coordinates)
        assert np.abs(M - N).max() < 1e-12 * np.abs(M).max() and np.abs(Qv - Rv).max() < 1e-12 * np.abs(Qv).max()


def test_the_report(arm):
    r = arm.report
    assert r.modes == arm.body.modes and r.from_elements.mass == pytest.approx(r.from_invariants.mass, rel=1e-12)
    assert r.from_invariants.J_origin == pytest.approx(arm.invariants.inertia_about_origin)
    assert [i.name for i in r.interfaces] == ["BUSH_F", "BUSH_R", "BALL"] and list(arm.body.nodes)[3] == "DAMP"
    assert r.normal_modes[0].effective_mass.shape == (6,) and list(r.seconds)[0] == "read"
    html = r._repr_html_()
    assert "BUSH_F" in html and f"{r.normal_modes[0].frequency:.3f}" in html and html.count("<table>") == html.count("</table>")
    named = ff.reduce(mesh(), interfaces={"<b>": ENDS["A"], "B": ENDS["B"]}, **QUICK)
    assert "<b>" not in named.report._repr_html_().replace("<p><b>", "")


def test_copies_pickles_and_sid(part, tmp_path):
    other = pickle.loads(pickle.dumps(part))
    assert np.array_equal(other.mode_shapes, part.mode_shapes) and repr(other) == repr(part)
    assert copy.deepcopy(part) is part
    body = pickle.loads(pickle.dumps(part.body))
    assert np.array_equal(body.K, part.body.K)
    part.save_sid(tmp_path / "part.SID_FEM")
    assert str(part.body.modes) in str(ff.info(tmp_path / "part.SID_FEM"))
    assert os.listdir(tmp_path) == ["part.SID_FEM"]
    for write in (part.save, part.save_sid):
        with pytest.raises(ff.OutputError):
            write(tmp_path / "missing" / "file")


def test_a_part_as_a_picture(part):
    pyvista = pytest.importorskip("pyvista", reason="pyvista is not installed")
    picture = part.to_pyvista(mode=1, scale=0.5)
    assert isinstance(picture, pyvista.PolyData) and picture.n_cells == len(part.triangles)
    assert np.allclose(picture.points, part.nodes + 0.5 * part.mode_shapes[:, :, 1], atol=1e-7)
    largest = np.linalg.norm(part.to_pyvista(0).point_data["displacement"], axis=1).max()
    assert largest == pytest.approx(0.06)
    assert part.to_pyvista().volume == pytest.approx(0.006, rel=1e-6)
    for mode in (-1, part.body.modes, "first", True, 1.5):
        with pytest.raises(ff.InputError):
            part.to_pyvista(mode)
    with pytest.raises(ff.InputError):
        part.to_pyvista(0, scale=np.nan)


def test_progress_is_told_and_other_threads_go_on(part):
    stages, ticks, done = [], [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    points, cells = box((12, 6, 6))
    ff.reduce(
        ff.Mesh(points, [("hex8i", cells)]), interfaces=ENDS, progress=lambda s, t: stages.append((s, t)), **QUICK
    )
    done.set()
    thread.join()
    assert stages[0][0] == "model" and all(t >= 0 for _, t in stages)
    assert max(np.diff(ticks)) < 0.5
    text = io.StringIO()
    with redirect_stderr(text):
        ff.reduce(mesh(), interfaces=ENDS, progress=True, **QUICK)
    assert " s  assembly" in text.getvalue()


def test_control_c_and_errors_of_the_progress_end_it():
    def wrong(stage, seconds):
        raise KeyError(stage)

    with pytest.raises(KeyError):
        ff.reduce(ARM, units="mm-t-s", material=STEEL_MM, interfaces={"A": ff.set("BALL")}, progress=wrong)
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() - start < 20:
            ff.reduce(ARM, units="mm-t-s", material=STEEL_MM, interfaces={"A": ff.set("BALL")})


def test_density_of_materials_without_one(tmp_path):
    deck = tmp_path / "tet.inp"
    deck.write_text(
        "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=A\n1,1,2,3,4\n"
        "*MATERIAL,NAME=STEEL\n*ELASTIC\n2e11,0.3\n*SOLID SECTION,ELSET=A,MATERIAL=STEEL\n"
    )
    assert ff.info(deck)["materials"][0]["density"] is None
    assert ff.info(deck, density=6000.0)["mass"] == pytest.approx(1000.0)
    assert ff.info(deck, density={"STEEL": np.float64(600.0)})["mass"] == pytest.approx(100.0)
    with pytest.raises(ff.InputError, match="no density"):
        ff.reduce(deck, units="m-kg-s", method="free_free")
    for bad in ("7", True, {1: 2.0}, [7.0], {"STEEL": None}, float("nan"), -1.0):
        with pytest.raises(ff.InputError):
            ff.info(deck, density=bad)


def test_converted_files_are_those_of_the_command_line(tmp_path):
    for name in ("arm.inp", "arm.msh", "arm.vtu"):
        text = ff.convert(ARM, tmp_path / name, material=STEEL_MM, modes=3)
        options = ["--material", "200000.0,0.3,7.85e-09", "--modes", "3"]
        command = [ff.program(), "convert", str(ARM), tmp_path / "c" / name, *options]
        (tmp_path / "c").mkdir(exist_ok=True)
        printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        assert (tmp_path / name).read_bytes() == (tmp_path / "c" / name).read_bytes()
        assert text == printed.replace(f"{tmp_path}/c/", f"{tmp_path}/")
    assert ff.info(tmp_path / "arm.inp")["nodes"] == ff.info(ARM)["nodes"]


def test_a_file_is_not_converted_into_itself_nor_into_anything(tmp_path):
    deck = tmp_path / "part.inp"
    ff.convert(ARM, deck, material=STEEL_MM)
    before = deck.read_bytes()
    with pytest.raises(ff.InputError, match="part.inp"):
        ff.convert(deck, deck)
    assert deck.read_bytes() == before
    with pytest.raises(ff.InputError, match=r"modes: found -1, expected a whole number from 0 to 100000"):
        ff.convert(ARM, deck, modes=-1)
    with pytest.raises(ff.InputError, match="docx"):
        ff.convert(ARM, tmp_path / "part.docx")
    with pytest.raises(ff.InputError, match="has no material|material"):
        ff.convert(ARM, deck)
    with pytest.raises(ff.OutputError):
        ff.convert(ARM, tmp_path / "nowhere" / "part.inp", material=STEEL_MM)
