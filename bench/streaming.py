#!/usr/bin/env python3
"""Cost of writing results to disk during a run, and the memory use of a long run.

    bench/streaming.py [--program build/floatframe] [--repeat 5] [--long 600]

Each run is made twice: into `results.csv`, and with `results.csv` a link to /dev/null. A device cannot be read back, so the
rows are then kept in memory and written at the end, as one text. Prints the processor time of the whole program and of its
steps alone (minimum of the repeated runs, taken in turns) and the largest resident memory (VmHWM)."""
import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile
import time

TREE = pathlib.Path(__file__).resolve().parents[1]


def peak_memory(process):
    """VmHWM [kB]; 0 if the process has just ended."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0
    found = re.search(r"VmHWM:\s*(\d+) kB", status)
    return int(found.group(1)) if found else 0


def measured(program, folder, arguments, streamed):
    """Processor time of the program and of its steps [s], largest resident memory [MB]."""
    out = pathlib.Path(folder) / ("streamed" if streamed else "kept")
    out.mkdir(exist_ok=True)
    results = out / "results.csv"
    results.unlink(missing_ok=True)
    if not streamed:
        results.symlink_to("/dev/null")
    process = subprocess.Popen([program, "run", *arguments, "--out", str(out), "--quiet"])
    peak = 0  # polled: the system's figure for an ended child includes memory of this program
    while (ended := os.wait4(process.pid, os.WNOHANG))[0] == 0:
        peak = max(peak, peak_memory(process.pid))
        time.sleep(0.005)
    _, status, usage = ended
    if status != 0:
        raise SystemExit(f"the run ended with the status {status}")
    summary = json.loads((out / "summary.json").read_text())
    size = results.stat().st_size if streamed else 0
    return usage.ru_utime + usage.ru_stime, summary["cpu_s"], 1.024e-3 * peak, size, summary["steps"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(TREE / "build" / "floatframe"))
    parser.add_argument("--model", default=str(TREE / "examples" / "iltis" / "iltis.yaml"))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--long", type=float, default=600.0, help="duration of the long run [s]; 0: none")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    with tempfile.TemporaryDirectory(prefix="floatframe_streaming_") as folder:
        runs = {True: [], False: []}
        for _ in range(arguments.repeat):
            for streamed in (True, False):
                runs[streamed].append(measured(program, folder, [arguments.model], streamed))
        best = {streamed: [min(run[k] for run in of) for k in range(3)] for streamed, of in runs.items()}
        steps = runs[True][0][4]
        print(f"{pathlib.Path(arguments.model).name}, {steps} steps, least of {arguments.repeat}")
        print(f"  program    {best[True][0]:8.3f} s streamed, {best[False][0]:8.3f} s kept, ratio "
              f"{best[True][0] / best[False][0]:.3f}")
        print(f"  steps      {best[True][1]:8.3f} s streamed, {best[False][1]:8.3f} s kept, ratio "
              f"{best[True][1] / best[False][1]:.3f}")
        if arguments.long > 0.0:
            print(f"{arguments.long:g} s at 1 ms")
            for streamed in (True, False):
                total, cpu, memory, size, steps = measured(
                    program, folder, [arguments.model, "--step", "0.001", "--duration", f"{arguments.long:g}"], streamed)
                print(f"  {'streamed' if streamed else 'kept    '}   {memory:8.1f} MB, {total:.1f} s, of which steps "
                      f"{cpu:.1f} s, {steps} steps" + (f", results.csv {size / 1e6:.0f} MB" if streamed else ""))
            total, cpu, memory, _, _ = measured(program, folder, [arguments.model, "--step", "0.001", "--duration", "6"], True)
            print(f"  streamed   {memory:8.1f} MB for 6 s")


if __name__ == "__main__":
    main()
