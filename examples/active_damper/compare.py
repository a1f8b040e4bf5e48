#!/usr/bin/env python3
"""Drives active_damper.yaml twice, without and with the skyhook controller, and compares the rides.

    python3 examples/active_damper/compare.py                      # in step with the wall clock, 1 ms
    python3 examples/active_damper/compare.py --lockstep           # reproducible, as fast as possible
"""
import argparse
import csv
import pathlib
import subprocess
import sys

import floatframe_link
import skyhook

HERE = pathlib.Path(__file__).resolve().parent


def write_table(path, rows):
    """All outputs at each instant; every number reads back to the same bits."""
    names = ["time"] + [n for n in rows[0] if n not in ("time", "sequence", "last")]
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(names)
        table.writerows([repr(row[n]) for n in names] for row in rows)


def ride(arguments, layout, settings, gain, keep=None):
    link = floatframe_link.Link(layout, ("127.0.0.1", 0))
    command = [arguments.program, "realtime", str(HERE / "active_damper.yaml"), *settings,
               "--input", "udp", "--output", "udp", "--send", f"127.0.0.1:{link.address[1]}",
               "--listen", "127.0.0.1:0", "--quiet"]
    if arguments.duration is not None:
        command += ["--duration", str(arguments.duration)]
    if arguments.lockstep:
        command += ["--lockstep", "--no-pace", "--timeout", "30"]
    model = subprocess.Popen(command)
    try:
        result = skyhook.control(link, gain, arguments.largest_force, arguments.patience, keep)
    finally:
        link.close()
        if model.poll() is None and sys.exc_info()[0] is not None:
            model.terminate()
        code = model.wait()
    if code != 0:
        sys.exit(f"{arguments.program} ended with exit code {code}")
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=floatframe_link.find_program())
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the model")
    parser.add_argument("--duration", type=float, help="[s]; default: that of the model")
    parser.add_argument("--gain", type=float, default=8000.0, help="of the skyhook [N s/m]")
    parser.add_argument("--largest-force", type=float, default=8000.0, help="[N]")
    parser.add_argument("--lockstep", action="store_true", help="reproducible: the model waits for each answer")
    parser.add_argument("--patience", type=float, default=60.0, help="longest wait for outputs [s]")
    parser.add_argument("--table", metavar="CSV", help="all outputs of the ride with the controller")
    arguments = parser.parse_args()
    settings = [word for setting in arguments.set for word in ("--set", setting)]
    layout = floatframe_link.read_layout(arguments.program, HERE / "active_damper.yaml", *settings)
    skyhook.heading()
    passive = ride(arguments, layout, settings, 0.0)
    skyhook.show("passive", passive)
    rows = []
    active = ride(arguments, layout, settings, arguments.gain, rows.append)
    if arguments.table:
        write_table(arguments.table, rows)
    skyhook.show("skyhook", active)
    change = active["acceleration_rms"] / passive["acceleration_rms"] - 1.0
    print(f"the rms acceleration of the chassis changes by {100 * change:+.1f} %")


if __name__ == "__main__":
    main()
