"""What left the range of the method is told: by runs, by simulations, in the words of the command line."""

import subprocess
import warnings

import floatframe as ff
import numpy as np
import pytest
from cart import soft_beam

BUMP = {"flexible": False, "road": "bump", "speed": 10}


def told(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = call()
    return result, [w for w in caught if issubclass(w.category, ff.RunWarning)]


def test_a_run_tells_what_the_command_line_tells(tmp_path):
    model = ff.Model.load(ff.example("iltis"), **BUMP)
    res, caught = told(lambda: ff.run(model, duration=1.6))
    settings = [word for name, value in BUMP.items() for word in ("--set", f"{name}={str(value).lower()}")]
    done = subprocess.run([ff.program(), "run", ff.example("iltis"), *settings, "--duration", "1.6", "--quiet", "--no-report", "--out", tmp_path],
                          capture_output=True, text=True, check=False)
    sentences = [line.partition("warning: ")[2] for line in done.stderr.splitlines() if "warning: " in line]
    assert sentences and [str(w.message) for w in caught] == sentences
    assert all(w.filename == __file__ for w in caught)
    assert all(w.message.limit in repr(res) for w in caught)


def test_a_run_that_fails_is_told():
    res, caught = told(lambda: ff.run(soft_beam(), max_iterations=1, min_step=1e-3))
    assert res.summary["status"] == "failed" and "failed" in repr(res)
    assert caught[0].message.limit == "failed" and res.summary["message"] in str(caught[0].message)


def test_a_quiet_run_is_quiet():
    res, caught = told(lambda: ff.run(ff.Model.load(ff.example("slider_crank")), duration=0.05))
    assert not caught and "warning" not in repr(res)


def test_a_simulation_tells_what_its_run_tells():
    res, of_run = told(lambda: ff.run(soft_beam()))

    def stepped():
        sim = ff.Simulation(soft_beam())
        for _ in range(1000):
            sim.step()
        return sim

    sim, caught = told(stepped)
    assert of_run and {w.message.limit for w in caught} <= {w.message.limit for w in of_run}
    assert "displacement" in {w.message.limit for w in caught} and all(w.filename == __file__ for w in caught)
    assert {w.message.limit for w in of_run} == set(repr(sim).rpartition(": ")[2][:-1].split(", "))
    assert sim.outputs["z.z"] == res["z.z"][-1]
    assert sorted(sim.warnings)[0] == sorted(res.summary["warnings"])[0] or len(sim.warnings) == len(res.summary["warnings"])


def test_watching_changes_no_bit_and_can_be_left():
    sims = [ff.Simulation(soft_beam(), watch=watch) for watch in (True, False)]
    for k in range(200):
        for sim in sims:
            sim.step()
        assert k % 50 or sims[0].warnings is not None  # asked in between
        assert np.array_equal(sims[0].outputs.array, sims[1].outputs.array)
    assert sims[0].warnings and sims[1].warnings == []


def test_a_warning_can_be_an_error():
    with warnings.catch_warnings():
        warnings.simplefilter("error", ff.RunWarning)
        with pytest.raises(ff.RunWarning, match="beam"):
            ff.run(soft_beam())
        sim = ff.Simulation(soft_beam())
        with pytest.raises(ff.RunWarning):
            for _ in range(1000):
                sim.step()


def test_energy_of_a_sampled_spring_is_watched():
    """A stiff law that is held over steps gains energy: no closed balance without the work of its input."""
    m = soft_beam()
    sim = ff.Simulation(m)
    saved = sim.save()
    for _ in range(300):
        sim.step()
    before = len(sim.warnings)
    sim.restore(saved)  # what has left the range is not forgotten
    assert before and len(sim.warnings) == before
