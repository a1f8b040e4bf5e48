"""Models, runs and results: the same bits as the command line's, in memory that is shared."""

import os
import pathlib
import signal
import subprocess
import threading
import time

import floatframe as ff
import numpy as np
import pytest


@pytest.fixture(scope="module")
def iltis():
    return ff.Model.load(ff.example("iltis"))


@pytest.mark.parametrize("example, options", [("iltis", {"step": 0.01}), ("flexible_pendulum", {}),
                                              ("slider_crank", {"coordinates": "absolute", "inertia": "projection"})])
def test_results_are_those_of_the_command_line(tmp_path, example, options):
    arguments = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    subprocess.run([ff.program(), "run", ff.example(example), "--quiet", "--no-report", "--out", tmp_path, *arguments], check=True)
    res = ff.run(ff.Model.load(ff.example(example)), **options)
    text = (tmp_path / "results.csv").read_text()
    assert res.to_csv() == text
    table = np.loadtxt(text.splitlines(), delimiter=",", skiprows=1)
    assert np.array_equal(res.table, table)  # every bit
    header = text.splitlines()[0].split(",")
    assert header == [f"{name} [{unit}]" if unit else name for name, unit in res.units.items()]


def test_verify_estimates_the_error():
    pendulum = ff.Model.load(ff.example("flexible_pendulum"))
    plain, res = (ff.run(pendulum, step=5e-5, duration=0.1, verify=verify) for verify in (False, True))
    assert np.array_equal(plain.table, res.table) and "verification" not in plain.summary
    tip = {o["name"]: o for o in res.summary["verification"]["outputs"]}["tip.y"]
    assert tip["order"] == pytest.approx(2, abs=0.1)
    fine = ff.run(pendulum, step=5e-5 / 16, duration=0.1)["tip.y"][::16]
    assert tip["error"] == pytest.approx(np.abs(fine - res["tip.y"]).max(), rel=0.05)


def test_parameters_are_those_of_set(iltis):
    fast = ff.Model.load(ff.example("iltis"), speed=10)
    slow = ff.Model.load(ff.example("iltis"), speed=np.float64(3))
    one, other = (ff.run(m, step=0.02, duration=1)["chassis.z"] for m in (fast, slow))
    assert not np.array_equal(one, other)


def test_arrays_share_the_memory_of_the_result(iltis):
    res = ff.run(iltis, step=0.02, duration=0.2)
    res["chassis.z"][3] = 7.0
    assert res["chassis.z"][3] == 7.0 and res.table[3, list(res).index("chassis.z")] == 7.0
    assert "7" in res.to_csv().splitlines()[4].split(",")
    assert np.shares_memory(res.time, res.table)


def test_a_view_outlives_its_result(iltis):
    views = []
    for _ in range(20):
        res = ff.run(iltis, step=0.02, duration=0.4)
        views.append((res["chassis.z"], res["chassis.z"].copy()))
        del res
    assert all(np.array_equal(view, copy) for view, copy in views)


def test_pandas(iltis):
    res = ff.run(iltis, step=0.02, duration=0.2)
    table = res.to_pandas()
    assert table.shape == (11, len(res) - 1) and table.index.name == "time"
    assert np.array_equal(table["chassis.z"], res["chassis.z"])
    assert not np.shares_memory(table["chassis.z"].to_numpy(), res.table)


def test_summary(iltis):
    summary = ff.run(iltis, step=0.02, duration=0.2).summary
    assert (summary["status"], summary["steps"]) == ("completed", 10)


def test_unknown_output(iltis):
    res = ff.run(iltis, step=0.02, duration=0.02)
    with pytest.raises(KeyError, match="found no output 'chassis.w', expected one of time, "):
        res["chassis.w"]


def test_errors_have_places(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("bodies:\n  arm:\n    mass: -1\n    colour: red\n")
    with pytest.raises(ff.InputError) as caught:
        ff.Model.load(path)
    entries = caught.value.errors
    assert len(entries) >= 2 and all(e.file == str(path) for e in entries)
    assert any(e.line == 4 and e.column > 0 and "colour" in e.message for e in entries)
    assert str(entries[0]).startswith(f"{path}:")
    assert isinstance(caught.value, (ff.Error, ValueError))


@pytest.mark.parametrize("options", [{"step": -1}, {"step": float("nan")}, {"duration": -1}, {"step": float("inf")},
                                     {"coordinates": "polar"}, {"inertia": ""}])
def test_bad_options(iltis, options):
    with pytest.raises(ValueError, match="found"):
        ff.run(iltis, **options)


def test_missing_file():
    with pytest.raises(ff.InputError, match="does not exist"):
        ff.Model.load("nowhere.yaml")


def test_control_c(iltis):
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        ff.run(iltis, step=1e-5)
    assert time.perf_counter() - start < 10  # of minutes


def test_progress_and_an_exception_in_it(iltis):
    seen = []
    ff.run(iltis, step=1e-3, progress=seen.append)
    assert seen[-1] == 1.0 and seen == sorted(seen)

    def broken(fraction):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        ff.run(iltis, step=1e-5, progress=broken)


def test_threads_go_on_during_a_run(iltis):
    results = {}

    def work(step):
        results[step] = ff.run(iltis, step=step)["chassis.z"]

    steps = [0.01, 0.02, 0.005, 0.01]
    threads = [threading.Thread(target=work, args=(s,)) for s in steps]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert np.array_equal(results[0.01], ff.run(iltis, step=0.01)["chassis.z"])


def test_build_info():
    info = ff.build_info()
    assert info["version"] == ff.__version__ and info["instruction_set"] in ("x86-64", "x86-64-v3", "generic")
    assert isinstance(info["mumps"], bool) and pathlib.Path(info["library"]).is_file()


def test_example_that_is_not_there():
    with pytest.raises(ff.InputError, match="found the example 'ilits', expected one of .*iltis"):
        ff.example("ilits")
