"""Meshes of pyvista as parts, results as meshes of pyvista."""

import floatframe as ff
import numpy as np
import pytest

pyvista = pytest.importorskip("pyvista")

STEEL = ff.Material(2.1e11, 0.3, 7850.0)
CLAMPED = """\
floatframe: 1
name: clamped
gravity: [0, 0, 0]
points: {a: [0, 0, 0], b: [0.5, 0, 0]}
bodies:
  bar:
    flexible:
      material: {young: 2.0e+11, poisson: 0.3, density: 7800}
      bars: {bar: {from: a, to: b, elements: 8, section: {round: 0.01}}}
      clamped: [a]
      normal_modes: 4
joints: {hold: {type: weld, parent: ground, child: bar, at: a}}
forces: {push: {type: force, body: bar, at: b, direction: [0, 0, 1], magnitude: 20}}
outputs: {tip: {position: {body: bar, at: b}}}
simulation: {step: 1.0e-3, duration: 0.05}
"""


def reduced(mesh, **options):
    x = np.asarray(mesh.points)[:, 0]
    return ff.reduce(mesh, material=STEEL, interfaces={"END": ff.nodes(x < x.min() + 1e-4)}, modes=3, free_check=False, **options)


def block():
    axes = [np.linspace(0.0, size, n + 1) for n, size in ((6, 0.6), (2, 0.1), (2, 0.1))]
    return pyvista.RectilinearGrid(*axes)


def test_grids_of_every_kind_are_the_same_part():
    rectilinear = block()
    image = pyvista.ImageData(dimensions=(7, 3, 3), spacing=(0.1, 0.05, 0.05))
    kinds = [rectilinear, rectilinear.cast_to_structured_grid(), image, rectilinear.cast_to_unstructured_grid()]
    parts = [reduced(mesh) for mesh in kinds]
    for part in parts:
        assert part.invariants.m == pytest.approx(7850.0 * 0.006, rel=1e-6)
        np.testing.assert_allclose(part.frequencies, parts[0].frequencies, rtol=1e-6)


def test_a_surface_is_a_shell_if_it_has_a_thickness():
    plate = pyvista.Plane(i_size=0.4, j_size=0.1, i_resolution=8, j_resolution=2)
    assert reduced(plate, thickness=2e-3).invariants.m == pytest.approx(7850.0 * 0.4 * 0.1 * 2e-3, rel=1e-6)
    with pytest.raises(ff.InputError, match="thickness is missing"):
        reduced(plate)


@pytest.mark.parametrize("made_of", ["text", "data"])
def test_a_result_at_an_instant(made_of):
    if made_of == "text":
        model = ff.Model.from_yaml(CLAMPED)
    else:
        yaml = pytest.importorskip("yaml")
        model = ff.Model.from_dict(yaml.safe_load(CLAMPED))
    res = ff.run(model)
    for time in (None, 0.02):
        at = -1 if time is None else int(np.argmin(np.abs(res.time - time)))
        grid = res.to_pyvista(time)
        tip = np.array([res[f"tip.{axis}"][at] for axis in "xyz"])
        named = np.linalg.norm(np.asarray(grid.points) - tip, axis=1).min()
        assert named < 1e-9
        assert np.abs(grid.point_data["displacement"]).max() == pytest.approx(tip[2], rel=0.05)
        assert np.nanmax(grid.point_data["von_mises"]) > 1e6
    assert res.to_pyvista(0.0).n_points == grid.n_points
    with pytest.raises(ff.InputError, match="time"):
        res.to_pyvista(np.nan)


def test_a_result_of_an_example():
    res = ff.run(ff.Model.load(ff.example("flexible_pendulum")), duration=0.05)
    assert res.to_pyvista().n_cells > 10
