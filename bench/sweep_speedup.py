#!/usr/bin/env python3
"""Speed-up of a study by two runs at a time over one, with two independent studies as calibration.

    bench/sweep_speedup.py [--program build/floatframe] [--runs 64] [--repeat 3] [--duration S] [--mpi]
                           [--against PROGRAM]

Each repetition times, in sequence: all runs one at a time; two at a time; two simultaneous studies with half of the runs each,
one at a time (the capacity of the machine for two programs that share nothing); with --mpi all runs in two MPI processes. The
ratios are those of the wall times to that of one at a time. `processors` is the processor time divided by the wall time: below
2 in the parallel columns the machine was loaded by other work, and the ratio partly reflects that load. "per processor" is the
ratio of processor times, which shows the mutual slowdown of workers independent of the load: 1 if there is none. The tables of
all variants are compared byte for byte.

--against times another build of the program in turn with this one, one run at a time: the effect of a change. With --duration
1.3 a run of the Iltis takes about 0.05 s, so that the overhead per run becomes visible.

Finally a study with two runs at a time is monitored externally (/proc/<pid>/schedstat): for the program and each of its
processes the time it ran, the time it was ready without a processor, which is due to the machine, and the remaining time, in
which it waited for another process. The estimate for two free processors is the sum of all processor times over the time of all
but the workers, half of that of the two workers (runs are distributed one by one, so that both get the same), and the longest
waiting of a worker, less the time for which the processes it waited for had no processor.
"""
import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]


def processor_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(commands, environment=None):
    """Wall time and processor time of commands started together."""
    before, start = processor_time(), time.perf_counter()
    processes = [subprocess.Popen(command, stdout=subprocess.DEVNULL, env=environment) for command in commands]
    codes = [process.wait() for process in processes]
    wall = time.perf_counter() - start
    if any(codes):
        sys.exit(f"a study failed: {commands}")
    return wall, processor_time() - before


def descendants(pid):
    try:
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:  # the process has just ended
        return []
    return [pid] + [found for child in children for found in descendants(int(child))]


def watched(command):
    """Per process: name, seconds on a processor, ready without a processor, and alive; sampled every 5 ms."""
    study = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    start = time.perf_counter()
    seen = {}
    while study.poll() is None:
        for pid in descendants(study.pid):
            try:
                ran, ready, _ = pathlib.Path(f"/proc/{pid}/schedstat").read_text().split()
                name = pathlib.Path(f"/proc/{pid}/comm").read_text().strip()
            except (OSError, ValueError):
                continue
            now = time.perf_counter() - start
            first = seen[pid][3] if pid in seen else now
            seen[pid] = (name, int(ran) * 1e-9, int(ready) * 1e-9, first, now)
        time.sleep(0.005)
    return [(name, ran, ready, last - first) for name, ran, ready, first, last in seen.values()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "floatframe"))
    parser.add_argument("--model", default=str(ROOT / "examples" / "iltis" / "iltis.yaml"))
    parser.add_argument("--runs", type=int, default=64)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--duration", help="of each run [s]; default: that of the model file")
    parser.add_argument("--against", help="another build of the program, to be compared with")
    parser.add_argument("--mpi", action="store_true", help="also two MPI processes")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

    with tempfile.TemporaryDirectory(prefix="floatframe-speedup-") as scratch:
        folder = pathlib.Path(scratch)
        speeds = [3.0 + 3.0 * k / (arguments.runs - 1) for k in range(arguments.runs)]
        # Odd and even runs: both halves take the same time.
        plans = {"all": speeds, "even": speeds[::2], "odd": speeds[1::2]}
        for name, values in plans.items():
            (folder / f"{name}.csv").write_text("speed\n" + "".join(f"{v!r}\n" for v in values))

        def sweep(plan, threads, out, *launcher, what=program):
            command = [*launcher, what, "sweep", arguments.model, "--table", str(folder / f"{plan}.csv"), "--fresh",
                       "--quiet", "--threads", str(threads), "--out", str(folder / out)]
            return command + (["--duration", arguments.duration] if arguments.duration else [])

        variants = {"1 at a time": [sweep("all", 1, "one")], "2 at a time": [sweep("all", 2, "two")],
                    "2 studies": [sweep("even", 1, "even"), sweep("odd", 1, "odd")]}
        if arguments.against:
            variants["the other"] = [sweep("all", 1, "other", what=str(pathlib.Path(arguments.against).resolve()))]
        if arguments.mpi:
            mpirun = shutil.which("mpirun") or sys.exit("mpirun is not installed")
            variants["2 MPI processes"] = [sweep("all", 1, "mpi", mpirun, "-n", "2", "--oversubscribe")]
        times = {name: [] for name in variants}
        processor_times = {name: [] for name in variants}
        print(f"{arguments.runs} runs of {pathlib.Path(arguments.model).name}; "
              + subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip())
        print(f"{'load':>6}" + "".join(f"  {name + ' [s]':>20}  {'processors':>10}" for name in variants))
        for _ in range(arguments.repeat):
            line = f"{os.getloadavg()[0]:6.2f}"
            for name, commands in variants.items():
                wall, processor = timed(commands, environment)
                times[name].append(wall)
                processor_times[name].append(processor)
                line += f"  {wall:20.3f}  {processor / wall:10.2f}"
            print(line, flush=True)
        tables = {out: (folder / out / "sweep.csv").read_bytes() for out in
                  ["one", "two"] + (["mpi"] if arguments.mpi else []) + (["other"] if arguments.against else [])}
        if len(set(tables.values())) != 1:
            sys.exit("the tables differ")
        print("tables: the same bytes")
        one, one_processor = times["1 at a time"], processor_times["1 at a time"]
        print(f"a run: {min(one_processor) / arguments.runs:.4f} s of processor time, with reading and building its model")
        for name in list(variants)[1:]:
            if name == "the other":
                continue
            ratios = [a / b for a, b in zip(one, times[name])]
            print(f"{name:>16}: {min(one) / min(times[name]):.2f} times faster than one at a time (quickest), "
                  f"{statistics.median(ratios):.2f} (median of pairs); per processor "
                  f"{min(one_processor) / min(processor_times[name]):.2f}")
        if arguments.against:
            other, other_processor = times["the other"], processor_times["the other"]
            print(f"this program / the other, one at a time: processor time {min(one_processor) / min(other_processor):.3f} "
                  f"(quickest), {statistics.median(a / b for a, b in zip(one_processor, other_processor)):.3f} (median of "
                  f"pairs); wall time {min(one) / min(other):.3f}, "
                  f"{statistics.median(a / b for a, b in zip(one, other)):.3f}")
        processes = sorted(watched(variants["2 at a time"][0]), key=lambda p: -p[1])
        print("one study, two runs at a time, process by process [s]:   ran   ready   waited")
        for name, ran, ready, alive in processes:
            print(f"{name:>46}  {ran:11.3f}  {ready:6.3f}  {max(0.0, alive - ran - ready):7.3f}")
        workers = processes[:2]
        total = sum(ran for _, ran, _, _ in processes)
        parallel = sum(ran for _, ran, _, _ in workers)
        kept_waiting = sum(ready for _, _, ready, _ in processes[2:])
        waited = max(0.0, max(alive - ran - ready for _, ran, ready, alive in workers) - kept_waiting)
        print(f"two free processors: about {total / (total - parallel + 0.5 * parallel + waited):.2f} times faster than 1")


if __name__ == "__main__":
    main()
