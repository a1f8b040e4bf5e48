"""Roads: OpenCRG files that PyOpenCRG wrote or that are written here, read by both and compared; roads of models; what is refused."""

import struct
import warnings

import floatframe as ff
import numpy as np
import pytest

FORMATS = ("KRBI", "KDBI", "LRFI", "LDFI")
BORDERS = ("none", "zero", "keep", "repeat", "reflect")
CLOSE = {"rtol": 0.0, "atol": 1e-8}


@pytest.fixture(scope="module")
def crg():
    """PyOpenCRG: double precision, from the tools of ASAM for Matlab; it shares no code with our reader."""
    return pytest.importorskip("pyopencrg")


def exact(values, fmt):
    """Numbers that the format holds exactly: both sum up the same headings, to the end that the header gives."""
    values = np.asarray(values)
    return values.astype(np.float32).astype(np.float64) if fmt[0] == "K" else np.round(values, 4)


def curved(crg, fmt, *, uneven=False, slope=True):
    """40 m: straight, clothoid, arc; slope, banking and a grid of bumps."""
    rng = np.random.default_rng(3)
    steps, h = 160, 0.25
    s = h * np.arange(steps)
    heading = 0.3 + 0.5 * 0.02 * np.clip(s - 8.0, 0.0, 8.0) ** 2 / 8.0 + 0.02 * np.clip(s - 16.0, 0.0, None)
    v = np.array([-2.0, -1.5, -0.5, 0.25, 1.0, 2.25]) if uneven else np.linspace(-2.0, 2.0, 9)
    u = h * np.arange(steps + 1)
    return crg.CrgRoad(
        0.03 * rng.standard_normal((steps + 1, v.size)),
        u_inc=h,
        v=v,
        u_start=5.0,
        heading=exact(heading, fmt),
        slope=exact(0.05 * np.sin(s / 9.0), fmt) if slope else 0.0,
        banking=exact(0.04 * np.cos(u / 7.0), fmt) if slope else 0.0,
        x_start=12.5,
        y_start=-3.0,
        z_start=0.75,
    )


def read_by_both(crg, path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of values that are missing within a section
        return ff.Road.read(path), crg.read(str(path))


def places(road, count=4000, beyond=0.0, seed=1):
    rng = np.random.default_rng(seed)
    u = rng.uniform(road.u_start - beyond, road.u_end + beyond, count)
    return u, rng.uniform(road.v_min - 0.4 * beyond, road.v_max + 0.4 * beyond, count)


@pytest.mark.parametrize("fmt", FORMATS)
@pytest.mark.parametrize("uneven", [False, True])
def test_every_format_at_places_along_and_in_the_plane(crg, fmt, uneven, tmp_path):
    path = tmp_path / "road.crg"
    curved(crg, fmt, uneven=uneven).save(str(path), fmt=fmt)
    ours, theirs = read_by_both(crg, path)
    assert ours.notes == []
    u, v = places(theirs)
    x, y = theirs.uv_to_xy(u, v)
    np.testing.assert_allclose(ours.height(x, y), theirs.uv_to_z(u, v), **CLOSE)
    np.testing.assert_allclose(ours.height(x, y), theirs.xy_to_z(x, y), **CLOSE)
    normal = np.array(theirs.xy_to_normal(x, y))[-3:]
    slope = np.array(ours.slope(x, y))
    np.testing.assert_allclose(slope, -normal[:2] / normal[2], rtol=0.0, atol=1e-6)


@pytest.mark.parametrize("fmt", ["KRBI"])
@pytest.mark.parametrize("u_mode", range(5))
@pytest.mark.parametrize("v_mode", range(5))
def test_borders(crg, fmt, u_mode, v_mode, tmp_path):
    path = tmp_path / "road.crg"
    road = curved(crg, fmt, slope=False)
    road.set_option("border_mode_u", u_mode)
    road.set_option("border_mode_v", v_mode)
    road.set_option("border_offset_u", 0.125)
    road.set_option("border_offset_v", -0.25)
    road.save(str(path), fmt=fmt)
    ours, theirs = read_by_both(crg, path)
    # Not so far beside the line that a place has several u.
    u, v = places(theirs, beyond=15.0)
    x, y = theirs.uv_to_xy(u, v)
    expected = theirs.xy_to_z(x, y)
    assert np.isnan(expected).any() == (0 in (u_mode, v_mode))
    # Where a border jumps the last digit of u and v decides.
    at = np.array(theirs.xy_to_uv(x, y))
    edge = np.array([[theirs.u_start, theirs.u_end], [theirs.v_min, theirs.v_max]])
    clear = (np.abs(at[:, :, None] - edge[:, None, :]) > 1e-6).all(axis=(0, 2))
    # Zero in one direction and an offset in the other, beyond both: ASAM's tools disagree, in C they add the offsets.
    if 1 in (u_mode, v_mode):
        clear &= ((at >= edge[:, :1]) & (at <= edge[:, 1:])).any(axis=0)
    assert clear.sum() > 1500
    found = ours.height(x, y)
    np.testing.assert_allclose(found[clear], expected[clear], **CLOSE)
    given = ff.Road.read(path, border_u=BORDERS[u_mode], border_v=BORDERS[v_mode])
    np.testing.assert_array_equal(given.height(x, y), found)


@pytest.mark.parametrize("fmt", FORMATS)
def test_missing_heights(crg, fmt, tmp_path):
    """At the borders both take the last one of the cross section. Within one PyOpenCRG, as the tools for Matlab, draws a straight
    line; ours is the right neighbour, as the library of ASAM in C has it."""
    path = tmp_path / "road.crg"
    road = curved(crg, fmt)
    z = road.z
    rng = np.random.default_rng(8)
    for row in range(z.shape[0]):
        z[row, : rng.integers(0, 4)] = np.nan
        z[row, 9 - rng.integers(0, 4) :] = np.nan
    road.z = z
    road.save(str(path), fmt=fmt)
    ours, theirs = read_by_both(crg, path)
    assert len(ours.notes) == 1 and f"{np.isnan(z).sum()} heights are missing" in ours.notes[0]
    u, v = places(theirs, beyond=1.0)
    x, y = theirs.uv_to_xy(u, v)
    np.testing.assert_allclose(ours.height(x, y), theirs.fill_nan(2).xy_to_z(x, y), **CLOSE)

    z[:, 4] = np.nan
    road.z = z
    road.save(str(path), fmt=fmt)
    ours, theirs = read_by_both(crg, path)
    filled = theirs.z
    for row in filled:
        for k in np.flatnonzero(np.isnan(row)):
            if k > 0:
                row[k] = row[k - 1]
        for k in np.flatnonzero(np.isnan(row))[::-1]:
            row[k] = row[k + 1]
    theirs.z = filled
    np.testing.assert_allclose(ours.height(x, y), theirs.xy_to_z(x, y), **CLOSE)


def binary_file(path, fmt, columns, rows):
    """Written by hand: no end, no increment of v, numbers padded with NaN to blocks of 80 bytes."""
    names = "".join(f"D:long section at v = {v},m\n" for v in columns)
    header = f"$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 0.5\nREFERENCE_LINE_START_PHI = 0.4\n$\n$KD_Definition\n#:{fmt}\n{names}$\n$$$$\n"
    code, block = (">f", 20) if fmt == "KRBI" else (">d", 10)
    numbers = [z for row in rows for z in row]
    numbers += [float("nan")] * (-len(numbers) % block)
    path.write_bytes(header.encode() + b"".join(struct.pack(code, z) for z in numbers))


@pytest.mark.parametrize("fmt", ["KRBI", "KDBI"])
def test_binary_files_of_others(crg, fmt, tmp_path):
    path = tmp_path / "road.crg"
    rng = np.random.default_rng(2)
    rows = rng.standard_normal((7, 4))
    rows[2, 0] = rows[5, 3] = np.nan
    binary_file(path, fmt, [-1.5, -0.25, 0.5, 2.0], rows)
    ours, theirs = read_by_both(crg, path)
    theirs = theirs.fill_nan(2)
    u, v = places(theirs, 500, beyond=0.5)
    x, y = theirs.uv_to_xy(u, v)
    np.testing.assert_allclose(ours.height(x, y), theirs.uv_to_z(u, v), **CLOSE)


def test_at_the_origin_as_by_the_modifiers_of_others(crg, tmp_path):
    """`begin: origin` is what others do to every file whose header does not say otherwise, but for the height of the grid there."""
    path = tmp_path / "road.crg"
    curved(crg, "KDBI").save(str(path), fmt="KDBI")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        moved = crg.read(str(path), apply_mods=True)
    ours = ff.Road.read(path, begin="origin")
    u, v = places(moved)
    x, y = moved.uv_to_xy(u, v)
    difference = ours.height(x, y) - moved.uv_to_z(u, v)
    np.testing.assert_allclose(difference, difference[0], **CLOSE)


def test_roads_of_a_model():
    model = ff.Model.from_dict(
        {
            "bodies": {"box": {"rigid": {"mass": 1, "centre_of_mass": [0, 0, 0], "inertia": [1, 1, 1]}}},
            "roads": {
                "r": {
                    "profile": [[0, 0], [10, 1]],
                    "height": "x * y",
                    "friction": 0.9,
                    "patches": [{"x": [2, 4], "y": [-1, 1], "friction": 0.3}],
                }
            },
        }
    )
    road = ff.Road.of(model, "r")
    assert repr(road) == "Road('r')" and road.notes == []
    x = np.array([[1.0], [3.0]])
    np.testing.assert_allclose(road.height(x, [0.5, 2.0]), 0.1 * x + x * [0.5, 2.0], rtol=1e-15)
    along, across = road.slope(3.0, 0.5)
    assert float(along) == pytest.approx(0.6, abs=1e-15) and float(across) == 3.0
    np.testing.assert_array_equal(road.friction(x, [0.5, 2.0]), [[0.9, 0.9], [0.3, 0.9]])


def test_what_is_refused(tmp_path):
    model = ff.Model.load(ff.example("iltis"))
    with pytest.raises(ff.UnknownNameError, match="'stairs', 'bump', 'flat'"):
        ff.Road.of(model, "hill")
    with pytest.raises(ff.InputError, match="does not exist"):
        ff.Road.read(tmp_path / "none.crg")
    road = ff.Road.of(model, "stairs")
    with pytest.raises(ff.InputError, match="x: found"):
        road.height("far", 0.0)
    with pytest.raises(ff.InputError, match="not finite"):
        road.height(np.inf, 0.0)
    with pytest.raises(ff.InputError, match="broadcast"):
        road.height([1.0, 2.0], [1.0, 2.0, 3.0])
    (tmp_path / "bad.crg").write_text("$CT\n")
    with pytest.raises(ff.InputError, match="within the header"):
        ff.Road.read(tmp_path / "bad.crg")
    with pytest.raises(ff.InputError, match="border_u: found 'soft'"):
        ff.Road.read(tmp_path / "bad.crg", border_u="soft")
