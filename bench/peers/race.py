#!/usr/bin/env python3
"""The race: the same chains in Floatframe and in other programs, checked first, then timed.

usage: bench/peers/race.py [--program FILE] [--rounds N] [--links LIST] [--rigid LIST] [--no-vehicle] [--no-write]

Creates an environment from requirements.txt (build/race-environment), runs everything on one thread, checks that the programs
agree before it compares times, writes bench/peers/record.json and fills the table of docs/performance.md, each model as soon as
it is done; records of models that are not run are kept.
With --no-write the table is only printed. --links 1,4 --rigid 4: only these chains.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = ROOT / "build" / "race"
ENVIRONMENT = ROOT / "build" / "race-environment"
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

FLEXIBLE = (1, 4, 16)
RIGID = (4, 16, 64)
# Two codes with the same mesh, modes and gravity converge to the same motion; allowed [m], of a path of metres.
AGREE = 1e-5
AGREE_CHECK = 1e-6   # one link against the integration of pendulum_check.py [m]
SLACK = 1.1          # equal error: at most this times that of Floatframe at 1 ms
REFERENCE_STEP = {"floatframe": 2e-5, "exudyn": 1e-4}
SAMPLES = 0.01       # [s] errors are the largest distance of the tip at these times in the first second


def enter_environment():
    """Runs this file again with the pinned packages, on one thread."""
    python = ENVIRONMENT / "bin" / "python"
    wanted = (HERE / "requirements.txt").read_text()
    stamp = ENVIRONMENT / "packages"
    if not stamp.is_file() or stamp.read_text() != wanted:
        subprocess.run([sys.executable, "-m", "venv", str(ENVIRONMENT)], check=True)
        subprocess.run([str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r",
                        str(HERE / "requirements.txt")], check=True)
        stamp.write_text(wanted)
    if pathlib.Path(sys.prefix) != ENVIRONMENT:
        os.execve(str(python), [str(python), "-B", *sys.argv], os.environ | {name: "1" for name in THREADS})


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def distance(a, b):
    """Largest distance of two paths in the plane, rows (time, x, z)."""
    import numpy as np
    if a.shape != b.shape or np.abs(a[:, 0] - b[:, 0]).max() > 1e-9:
        sys.exit("race.py: two codes did not record the same times")
    return float(np.hypot(a[:, 1] - b[:, 1], a[:, 2] - b[:, 2]).max())


def least(runners, rounds):
    """Minimum processor time of each [s], one run of each in turn; the first round is a warm-up and is not counted."""
    times = [[] for _ in runners]
    for k in range(rounds + 1):
        for i, run in enumerate(runners):
            seconds = run()
            if k:
                times[i].append(seconds)
    return [min(t) for t in times]


def finish(rows, rounds):
    """Times all rows; ratios to the first."""
    for row, seconds in zip(rows, least([row.pop("run") for row in rows], rounds)):
        row.update(cpu_s=seconds, us_per_step=1e6 * seconds * row["step_s"])
    for row in rows:
        row["ratio"] = row["cpu_s"] / rows[0]["cpu_s"]


def flexible_chain(links, program, rounds):
    import exudyn_peer
    import floatframe_peer
    import models
    print(f"flexible chain of {links} ...", file=sys.stderr, flush=True)
    models.write_deck(WORK / "link.inp")
    bar, brick = (floatframe_peer.Chain(program, WORK, f"{kind}_{links}", models.chain_yaml(links, kind))
                  for kind in ("bar", "brick"))
    peer, exact_peer = (exudyn_peer.FlexibleChain(links, gravity_on_nodes=exact) for exact in (False, True))

    def tip(chain, **options):
        path = chain.run(record=SAMPLES, **options)[1]
        return path[:, [0, 1, 3]] if path.shape[1] == 4 else path

    exact = {"brick": tip(brick, step=REFERENCE_STEP["floatframe"]), "bar": tip(bar, step=REFERENCE_STEP["floatframe"]),
             "exudyn": tip(peer, step=REFERENCE_STEP["exudyn"], tolerance=1e-9)}
    apart = distance(exact["brick"], tip(exact_peer, step=REFERENCE_STEP["exudyn"], tolerance=1e-9))
    if apart > AGREE:
        sys.exit(f"race.py: chain of {links}: the converged tips are {apart:.1e} m apart, allowed {AGREE:.1e}")
    if links == 1 and (check := distance(exact["brick"], exudyn_peer.check(exact["brick"][:, 0]))) > AGREE_CHECK:
        sys.exit(f"race.py: one link is {check:.1e} m from pendulum_check.py, allowed {AGREE_CHECK:.1e}")
    rows = []
    for kind, chain, what in (("brick", brick, "20 bricks of 20 nodes a link"), ("bar", bar, "40 beams a link")):
        rows.append({"code": "Floatframe", "setting": f"{what}; relative coordinates, preprocessing; tolerance 1e-9",
                     "step_s": 1e-3, "error_m": distance(tip(chain, step=1e-3), exact[kind]),
                     "run": lambda chain=chain: chain.run(step=1e-3)[0]})
    wanted = SLACK * rows[0]["error_m"]
    own = []
    for step in (1e-3, 2e-3):
        o = {"step": step, "tolerance": 1e-6}
        own.append((min(brick.run(**o)[0] for _ in range(2)), distance(tip(brick, **o), exact["brick"]), o))
    if good := [c for c in own if c[1] <= wanted]:
        _, error, o = min(good, key=lambda c: c[0])
        rows.append({"code": "Floatframe", "setting": "cheapest at equal error: bricks, tolerance 1e-6", "step_s": o["step"],
                     "error_m": error, "run": lambda o=o: brick.run(**o)[0]})
    default = {"step": 1e-3, "tolerance": 1e-8, "modified": False}
    candidates = []
    for options in [default] + [{"step": step, "tolerance": tolerance, "sparse": sparse}
                                for step in (1e-3, 2e-3) for tolerance in (1e-8, 1e-6, 1e-5, 1e-4)
                                for sparse in (False, True)]:
        try:
            path = tip(peer, **options)
            seconds = min(peer.run(duration=1.0, **options)[0] for _ in range(2))
        except Exception as problem:  # the solver did not converge: not a candidate
            print(f"  Exudyn {options}: {str(problem)[:80]}", file=sys.stderr)
            continue
        candidates.append((seconds, distance(path, exact["exudyn"]), options))
    good = [c for c in candidates if c[1] <= wanted]
    chosen = [("as it comes", c) for c in candidates if c[2] is default]
    chosen += [("cheapest at equal error", min(good, key=lambda c: c[0]))] if good else []
    for why, (_, error, o) in chosen:
        setting = (f"{why}: same mesh and modes; {'full' if o is default else 'modified'} Newton, relative tolerance "
                   f"{o['tolerance']:.0e}, {'sparse' if o.get('sparse') else 'dense'} solver")
        rows.append({"code": f"Exudyn {exudyn_peer.VERSION}", "setting": setting, "step_s": o["step"], "error_m": error,
                     "run": lambda o=o: peer.run(duration=1.0, **o)[0]})
    finish(rows, rounds)
    return {"model": f"flexible chain, N = {links}", "kind": "flexible", "apart_m": apart, "allowed_m": AGREE,
            "apart_bar_m": distance(exact["bar"], exact["brick"]),
            "apart_timed_m": distance(exact["brick"], exact["exudyn"]), "rows": rows}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "floatframe"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--links", default=",".join(map(str, FLEXIBLE)))
    parser.add_argument("--rigid", default=",".join(map(str, RIGID)))
    parser.add_argument("--no-vehicle", action="store_true")
    parser.add_argument("--no-write", action="store_true")
    arguments = parser.parse_args()
    program = pathlib.Path(arguments.program).resolve()
    if not program.is_file():
        sys.exit(f"race.py: {program} is not there; build it with `make build` or give another one with --program")
    enter_environment()
    sys.path.insert(0, str(HERE))
    import floatframe_peer
    import importlib.metadata
    WORK.mkdir(parents=True, exist_ok=True)
    packages = [line.split("==")[0] for line in (HERE / "requirements.txt").read_text().split()]
    record = {"date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"), "cpu": processor(),
              "build": floatframe_peer.build(program), "python": platform.python_version(), "rounds": arguments.rounds,
              "versions": {name: importlib.metadata.version(name) for name in packages}, "models": []}
    import race_rigid
    sys.path.insert(0, str(HERE.parent))
    import race_table
    races = [lambda n=int(n): flexible_chain(n, program, arguments.rounds) for n in arguments.links.split(",") if n]
    races += [lambda n=int(n): race_rigid.rigid_chain(n, program, arguments.rounds) for n in arguments.rigid.split(",") if n]
    if not arguments.no_vehicle:
        races.append(lambda: race_rigid.vehicle(program, arguments.rounds))
    for run in races:
        done = run() | {"date": record["date"][:10]}
        record["models"].append(done)
        if not arguments.no_write:
            keep(record, done)
            race_table.fill_page()
    print(race_table.text(record))


def keep(record, done):
    """Writes the record with this model at its previous position and the others unchanged."""
    file = HERE / "record.json"
    models = json.loads(file.read_text())["models"] if file.is_file() else []
    places = [k for k, model in enumerate(models) if model["model"] == done["model"]] or [len(models)]
    models[places[0]:places[0] + 1] = [done]
    file.write_text(json.dumps(record | {"models": models}, indent=2) + "\n")


if __name__ == "__main__":
    main()
