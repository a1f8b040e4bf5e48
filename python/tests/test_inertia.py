"""Inertia integrals, M and Qv through Python against the reference bodies of tests/data/inertia, in both methods and
formulations."""

import copy
import gc
import json
import pickle
import weakref
from pathlib import Path

import floatframe as ff
import numpy as np
import pytest

DATA = Path(__file__).resolve().parents[2] / "tests" / "data" / "inertia"
NAMES = sorted(path.stem for path in DATA.glob("*.json"))
TOLERANCE = 1e-12  # of the largest entry, as in tests/inertia


def error(a, b):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape
    return np.abs(a - b).max(initial=0.0) / max(np.abs(b).max(initial=0.0), 1e-300)


def invariants_of(j):
    return ff.Invariants(j["m"], j["m_bar_u"], j["P_bar_u"], j["S"], j["S_i"], j["S_ij"])


def difference(v, j):
    pairs = [(v.m, j["m"]), (v.m_u, j["m_bar_u"]), (v.P_u, j["P_bar_u"]), (v.S, j["S"]), (v.Si, j["S_i"]), (v.Sij, j["S_ij"])]
    pairs.append((v.inertia_about_origin, j["J_bar_u"]))
    return max(error(a, b) for a, b in pairs)


def check_terms(body, file, outputs, method):
    s = file["state"]
    state = {"A": s["A"], "y": s["y"], "omega": s["omega"], "ydot": s["ydot"], "r0": s["r0"], "method": method}
    M, Qv = body.inertia(**state, coordinates="absolute")
    assert error(M, outputs["absolute"]["M"]) < TOLERANCE
    assert error(Qv, outputs["absolute"]["Qv"]) < TOLERANCE
    qdot = np.array(outputs["absolute"]["qdot"])
    assert 0.5 * qdot @ M @ qdot == pytest.approx(outputs["kinetic_energy"], rel=TOLERANCE)
    M, Qv = body.inertia(**state, coordinates="relative")
    assert error(M, outputs["relative"]["M"]) < TOLERANCE
    assert error(Qv, outputs["relative"]["Qv_sddot_material_paper"]) < TOLERANCE
    qdot = np.array(outputs["relative"]["qdot"])
    assert 0.5 * qdot @ M @ qdot == pytest.approx(outputs["kinetic_energy"], rel=TOLERANCE)


@pytest.fixture(params=NAMES)
def file(request):
    return json.loads((DATA / f"{request.param}.json").read_text())


def shapes(file):
    return np.array(file["X_translation"]).reshape(-1, 3, file["n_modes"])


def test_reference_bodies_are_there():
    assert len(NAMES) == 7


def test_preprocessing_from_the_integrals_of_the_file(file):
    for part in [file, *([file["isoparametric_approximation"]] if "isoparametric_approximation" in file else [])]:
        v = invariants_of(part["invariants"])
        assert difference(v, part["invariants"]) < 1e-15
        check_terms(ff.Body(v), file, part["outputs"], "preprocessing")


def test_projection_of_nodes_and_their_mass_matrix(file):
    part = file.get("isoparametric_approximation", file)
    projection = ff.Projection(file["nodes"], shapes(file), file["M_scalar_isoparametric"])
    v = projection.invariants()
    assert difference(v, part["invariants"]) < TOLERANCE
    body = ff.Body(v, projection=projection)
    check_terms(body, file, part["outputs"], "projection")
    check_terms(body, file, part["outputs"], "preprocessing")


@pytest.mark.parametrize("name", ["hex8", "tet4"])
def test_from_elements(name):
    file = json.loads((DATA / f"{name}.json").read_text())
    mesh = ff.Mesh(file["nodes"], [(name, [e["nodes"] for e in file["elements"]])])
    material = ff.Material(file["E"], file["nu"], file["rho"])
    v = ff.Invariants.of_mesh(mesh, shapes(file), material=material)
    assert difference(v, file["invariants"]) < TOLERANCE
    projection = ff.Projection.of_mesh(mesh, shapes(file), material=material)
    body = ff.Body(v, K=file["K_modal"], projection=projection)
    check_terms(body, file, file["outputs"], "projection")
    assert error(body.K, file["K_modal"]) == 0.0
    values, columns, starts = projection.mass_rows
    dense = np.zeros((len(file["nodes"]),) * 2)
    dense[np.repeat(np.arange(len(dense)), np.diff(starts)), columns] = values
    assert error(dense, file["M_scalar_isoparametric"]) < TOLERANCE


@pytest.fixture
def body():
    return tetrahedra()


def tetrahedra():
    file = json.loads((DATA / "tet4.json").read_text())
    projection = ff.Projection(file["nodes"], shapes(file), file["M_scalar_isoparametric"])
    return ff.Body(projection.invariants(), K=file["K_modal"], projection=projection)


def motion(body, **changes):
    nm = body.modes
    given = {"A": np.eye(3), "y": np.full(nm, 1e-3), "omega": [1.0, 2.0, 3.0], "ydot": np.ones(nm)}
    return body.inertia(**(given | changes))


def test_a_rigid_body_is_that_of_the_formulas():
    J = np.diag([1.0, 2.0, 2.5])
    body = ff.Body(ff.Invariants.rigid(2.0, [0.0, 0.0, 0.0], J))
    M, Qv = body.inertia(np.eye(3), [], [0.1, 0.2, 0.3], [])
    assert M == pytest.approx(np.diag([2.0, 2.0, 2.0, 1.0, 2.0, 2.5]))
    omega = np.array([0.1, 0.2, 0.3])
    assert Qv == pytest.approx(np.concatenate([np.zeros(3), -np.cross(omega, J @ omega)]))
    assert body.modes == 0 and body.K.shape == (0, 0) and body.invariants.S.shape == (3, 0)


def test_views_share_memory_and_outlive_their_owners():
    body = tetrahedra()
    v = body.invariants
    assert np.shares_memory(v.S, v.S) and np.shares_memory(v.Sij[0][1], body.invariants.Sij[0][1])
    kept = [v.S, v.Sij[1][2], v.m_u, v.P_u, body.K, body.projection.p, body.projection.X, *body.projection.mass_rows]
    before = [a.copy() for a in kept]
    gone = weakref.ref(body)
    del v, body
    gc.collect()
    assert gone() is None
    _ = [np.full(a.size, 7, dtype=a.dtype) for a in before for _ in range(20)]  # memory that is free is written over
    assert all(np.array_equal(a, b) for a, b in zip(kept, before, strict=True))
    for a in kept:
        with pytest.raises(ValueError, match="read-only"):
            a[...] = 0


def test_results_are_arrays_of_their_own(body):
    M, Qv = motion(body)
    M[0, 0] = Qv[0] = -1.0
    again, _ = motion(body)
    assert again[0, 0] == body.invariants.m


def test_copies_and_pickles(body):
    for other in (pickle.loads(pickle.dumps(body)), copy.deepcopy(body), copy.copy(body)):
        for method in ("projection", "preprocessing"):
            for a, b in zip(motion(other, method=method), motion(body, method=method), strict=True):
                assert np.array_equal(a, b)
    v = pickle.loads(pickle.dumps(body.invariants))
    assert np.array_equal(v.Sij, body.invariants.Sij) and v.m == body.invariants.m


@pytest.mark.parametrize(
    "changes",
    [
        {"A": np.eye(4)},
        {"A": np.ones(9)},
        {"A": np.full((3, 3), np.nan)},
        {"A": 2 * np.eye(3)},
        {"A": np.diag([1.0, 1.0, -1.0])},
        {"A": np.eye(3) * 1j},
        {"A": None},
        {"A": "rotation"},
        {"y": []},
        {"y": np.ones(99)},
        {"y": np.ones((2, 2))},
        {"y": [[1.0], [2.0, 3.0]]},
        {"ydot": [np.inf] * 6},
        {"ydot": object()},
        {"omega": [1.0, 2.0]},
        {"omega": ["a", "b", "c"]},
        {"omega": np.array([1, 2, 3], dtype=object)},
        {"omega": np.zeros(3, dtype="datetime64[s]")},
        {"r0": [0.0, 0.0, np.nan]},
        {"method": "magic"},
        {"method": 3},
        {"coordinates": None},
        {"coordinates": ["relative"]},
        {"geometric_stiffening": True},  # no displacements of second order
        {"geometric_stiffening": 1},
    ],
)
def test_motions_that_are_none(body, changes):
    with pytest.raises(ff.Error):
        motion(body, **changes)


def test_other_layouts_and_types_are_taken(body):
    M, Qv = motion(body, A=np.asfortranarray(np.eye(3)), omega=np.array([1, 9, 2, 9, 3])[::2], y=[1e-3] * body.modes)
    expected = motion(body)
    assert np.array_equal(M, expected[0]) and np.array_equal(Qv, expected[1])
    single = motion(body, omega=np.array([1, 2, 3], dtype=np.float32).astype(">f4"))
    assert np.array_equal(single[0], expected[0])


@pytest.mark.parametrize(
    "arguments",
    [
        (1.0, [0, 0, 0], np.eye(3), np.zeros((3, 2))),
        (1.0, [0, 0, 0], np.eye(3), np.zeros((2, 3)), np.zeros((3, 3, 2)), np.zeros((3, 3, 2, 2))),
        (1.0, [0, 0, 0], np.eye(3), np.zeros((3, 2)), np.zeros((3, 3, 1)), np.zeros((3, 3, 2, 2))),
        (1.0, [0, 0, 0], np.eye(3), np.zeros((3, 2)), np.zeros((3, 3, 2)), np.zeros((3, 3, 2, 3))),
        (-1.0, [0, 0, 0], np.eye(3)),
        (np.nan, [0, 0, 0], np.eye(3)),
        ("1", [0, 0, 0], np.eye(3)),
        (1.0, [0, 0], np.eye(3)),
        (1.0, [0, 0, 0], np.full((3, 3), np.inf)),
        (1.0, None, None),
    ],
)
def test_integrals_of_wrong_shapes(arguments):
    with pytest.raises(ff.InputError):
        ff.Invariants(*arguments)


def test_integrals_that_no_body_has(body):
    v = body.invariants
    with pytest.raises(ff.InputError, match="P_u"):
        ff.Body(ff.Invariants(v.m, v.m_u, -np.eye(3), v.S, v.Si, v.Sij))
    with pytest.raises(ff.InputError, match="K"):
        ff.Body(v, K=-np.eye(v.modes))
    with pytest.raises(ff.InputError, match="projection: expected as many modes"):
        ff.Body(ff.Invariants.rigid(1.0, [0, 0, 0], np.eye(3)), projection=body.projection)
    with pytest.raises(ff.InputError):
        ff.Body("invariants")


def test_a_body_without_nodes_has_no_projection():
    body = ff.Body(ff.Invariants.rigid(2.0, [0, 0, 0], np.eye(3)))
    with pytest.raises(ff.InputError, match="ProjectionData"):
        body.inertia(np.eye(3), [], [0, 0, 0], [], method="projection")


def test_points_with_masses_that_are_none():
    X = np.zeros((2, 3, 1))
    for p, shapes_, M in [
        (np.zeros((2, 2)), X, np.eye(2)),
        (np.zeros((2, 3)), X[:1], np.eye(2)),
        (np.zeros((2, 3)), X, np.eye(3)),
        (np.zeros((0, 3)), np.zeros((0, 3, 1)), np.zeros((0, 0))),
        (np.zeros((2, 3)), X, "masses"),
    ]:
        with pytest.raises(ff.InputError):
            ff.Projection(p, shapes_, M)


def test_classes_of_the_library_are_not_made_empty():
    for name in ("Invariants", "Projection", "Body", "FeModel", "Part"):
        with pytest.raises(TypeError):
            getattr(ff._core, name)()
        with pytest.raises(TypeError):
            bare = object.__new__(getattr(ff._core, name))
            bare.modes  # noqa: B018
