#!/usr/bin/env python3
"""Records benchmark runs and compares them as ratios.

usage: bench/history.py record [--program FILE] [--no-counts] [--no-scaling] [--growth] [--note TEXT]
       bench/history.py compare [NEW [OLD]] [--program FILE] [--no-counts] [--fail-above RATIO]
       bench/history.py list

record   runs `floatframe bench chain`, `bench iltis`, `bench scaling`, floatframe_benchmarks (if it is built next to
         the program) and bench/count_instructions.py and writes
         bench/history/<date>_<commit>.json
compare  prints new/old for every figure that both have. NEW and OLD are recorded files, or parts of their names; without
         them the newest is compared with the one before it. NEW = `run` measures now and writes nothing.

Times are compared in units of one dense Cholesky factorisation (98 x 98) measured in the same run, because seconds of
two machines, or of one machine on two days, are not comparable; instruction counts as they are. With --fail-above
the exit code is 1 if a step of any case has more than RATIO times the instructions it had.
"""
import argparse
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
HISTORY = ROOT / "bench" / "history"


def fail(message):
    print(f"history.py: {message}", file=sys.stderr)
    sys.exit(2)


def git(*arguments):
    done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def measure(program, counts, scaling, growth):
    """One recorded run."""
    program = pathlib.Path(program).resolve()
    if not program.is_file():
        fail(f"{program} is not there; build it with `make build` or give another one with --program")
    run = {"date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
           "commit": git("rev-parse", "--short=10", "HEAD") or "unknown",
           "changed_files": bool(git("status", "--porcelain", "--untracked-files=no", "--", "src", "cmake")),
           "subject": git("log", "-1", "--format=%s")}
    with tempfile.TemporaryDirectory(prefix="floatframe-history-") as folder:
        benches = ["chain", "iltis"] + (["scaling"] if scaling else [])
        for bench in benches:
            file = pathlib.Path(folder) / f"{bench}.json"
            print(f"floatframe bench {bench} ...", file=sys.stderr)
            done = subprocess.run([str(program), "bench", bench, "--json", str(file)], cwd=ROOT, check=False,
                                  stdout=subprocess.DEVNULL)
            if done.returncode and not file.exists():
                fail(f"`floatframe bench {bench}` failed with exit code {done.returncode}")
            run[bench] = json.loads(file.read_text())
        kernels = program.with_name("floatframe_benchmarks")
        if scaling and kernels.is_file():
            print("floatframe_benchmarks ...", file=sys.stderr)
            done = subprocess.run([str(kernels), "--benchmark_format=json", "--benchmark_min_time=0.05"], cwd=ROOT,
                                  capture_output=True, text=True, check=False)
            if done.returncode:
                fail(f"floatframe_benchmarks failed with exit code {done.returncode}")
            run["kernels"] = [{"name": b["name"], "us": b["cpu_time"] * {"ns": 1e-3, "us": 1.0, "ms": 1e3}[b["time_unit"]]}
                              for b in json.loads(done.stdout)["benchmarks"]]
        if counts:
            file = pathlib.Path(folder) / "counts.json"
            command = [str(ROOT / "bench" / "count_instructions.py"), "--json", str(file)]
            print("bench/count_instructions.py ...", file=sys.stderr)
            done = subprocess.run([sys.executable, "-B", *command, *(["--growth"] if growth else [])], check=False,
                                  stdout=subprocess.DEVNULL)
            if not file.exists():
                fail("the instructions could not be counted; --no-counts leaves them out")
            run["instructions"] = json.loads(file.read_text())
    run["build"], run["cpu"] = run["chain"]["build"], run["chain"]["cpu"]
    run["dense_llt_98_us"] = run["chain"]["dense_llt_98_us"]
    return run


def figures(run):
    """name -> (kind, value); kind "LLT" or "instructions"."""
    found = {}

    def short(row):
        return f"{row['coordinates'][:3].capitalize()}+{'P' if row['inertia'] == 'preprocessing' else 'B'}"

    for row in run.get("chain", {}).get("rows", []):
        if row["failure"] is None:
            found[f"chain {row['links']} links, {row['modes']} modes, {short(row)}: a step"] = (
                "LLT", row["us_per_step_min"] / run["chain"]["dense_llt_98_us"])
    for row in run.get("iltis", {}).get("rows", []):
        found[f"Iltis {row['elements_per_bar']} elements per bar, {short(row)}: a step"] = (
            "LLT", 1e6 * row["cpu_s_min"] / row["steps"] / run["iltis"]["dense_llt_98_us"])
    if "iltis" in run:
        found["Iltis Rel+P: one full iteration"] = (
            "LLT", run["iltis"]["rel_p_iteration_us"] / run["iltis"]["dense_llt_98_us"])
    for row in run.get("scaling", {}).get("rows", []):
        if row["failure"] is None:
            found[f"{row['sweep']} {row['value']}, {short(row)}: an iteration"] = (
                "LLT", row["us_per_iteration_min"] / run["scaling"]["dense_llt_98_us"])
    for name, case in run.get("instructions", {}).get("cases", {}).items():
        found[f"{name}: a step"] = ("instructions", case["instructions_per_step"])
    return found


def recorded():
    return sorted(HISTORY.glob("*.json"))


def load(name, default):
    if name is None:
        if len(recorded()) < default:
            fail(f"bench/history holds {len(recorded())} recorded runs, this needs {default}; make one with `record`")
        return recorded()[-default]
    if pathlib.Path(name).is_file():
        return pathlib.Path(name)
    matching = [file for file in recorded() if name in file.name]
    if len(matching) != 1:
        fail(f"found '{name}', expected a file or a part of the name of one recorded run: "
             f"{', '.join(file.stem for file in recorded()) or 'none so far'}")
    return matching[0]


def compare(arguments):
    if arguments.new == "run":
        new = measure(arguments.program, not arguments.no_counts, False, False)
        old = json.loads(load(arguments.old, 1).read_text())
    else:
        new = json.loads(load(arguments.new, 1).read_text())
        old = json.loads(load(arguments.old, 2).read_text())
    for name, run in (("new", new), ("old", old)):
        print(f"{name}: {run['date'][:10]} {run['commit']}{' with changes' if run['changed_files'] else ''}, "
              f"{run['build']}, {run['cpu']}, LLT {run['dense_llt_98_us']:.2f} us")
    ours, theirs = figures(new), figures(old)
    common = [name for name in ours if name in theirs]
    if not common:
        fail("the two runs have no figure in common")
    width = max(map(len, common))
    print(f"\n{'':{width}}  {'new':>12}  {'old':>12}  new/old")
    worst = 0.0
    for name in common:
        kind, value = ours[name]
        before = theirs[name][1]
        ratio = value / before
        form = "12.4f" if kind == "LLT" else "12,.0f"
        # Times of a shared machine differ by some per cent from run to run, counts of one compiler do not.
        mark = "  faster" if ratio < (0.9 if kind == "LLT" else 0.99) else "  slower" if ratio > (
            1.1 if kind == "LLT" else 1.01) else ""
        print(f"{name:{width}}  {value:{form}}  {before:{form}}  {ratio:7.3f}{mark}")
        if kind == "instructions":
            worst = max(worst, ratio)
    if arguments.fail_above and worst > arguments.fail_above:
        print(f"\nA step has {worst:.3f} times the instructions it had; at most {arguments.fail_above:g} is allowed.")
        return 1
    return 0


def record(arguments):
    run = measure(arguments.program, not arguments.no_counts, not arguments.no_scaling, arguments.growth)
    if arguments.note:
        run["note"] = arguments.note
    HISTORY.mkdir(parents=True, exist_ok=True)
    file = HISTORY / f"{run['date'][:10]}_{run['commit']}.json"
    file.write_text(json.dumps(run, indent=1) + "\n")
    print(file.relative_to(ROOT))
    return 0


def show_list():
    for file in recorded():
        run = json.loads(file.read_text())
        found = figures(run)
        chain = found.get("chain 4 links, 8 modes, Rel+P: a step", ("", float("nan")))[1]
        count = found.get("chain of 4, relative, preprocessing: a step", ("", float("nan")))[1]
        print(f"{file.stem}  chain of 4 Rel+P {chain:.3f} LLT, {count:,.0f} instructions per step  {run['build']}  "
              f"{run['subject']}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("record", "compare"):
        command = commands.add_parser(name)
        command.add_argument("--program", default=str(ROOT / "build" / "floatframe"), help="default build/floatframe")
        command.add_argument("--no-counts", action="store_true", help="leave out the instruction counts")
        if name == "record":
            command.add_argument("--no-scaling", action="store_true", help="leave out `bench scaling`")
            command.add_argument("--growth", action="store_true", help="count instructions of the growth cases too")
            command.add_argument("--note", help="a remark to keep with the run")
        else:
            command.add_argument("new", nargs="?")
            command.add_argument("old", nargs="?")
            command.add_argument("--fail-above", type=float, metavar="RATIO")
    commands.add_parser("list")
    arguments = parser.parse_args()
    if arguments.command == "record":
        return record(arguments)
    return compare(arguments) if arguments.command == "compare" else show_list()


if __name__ == "__main__":
    sys.exit(main())
