#!/usr/bin/env python3
"""Drives active_damper.yaml twice, without and with the skyhook controller, and compares the rides.

    python3 examples/active_damper/compare.py                      # in step with the wall clock, 1 ms
    python3 examples/active_damper/compare.py --lockstep           # reproducible, as fast as possible
"""
import argparse
import pathlib
import subprocess
import sys

import floatframe_link
import skyhook

HERE = pathlib.Path(__file__).resolve().parent


def ride(arguments, layout, settings, gain):
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
        result = skyhook.control(link, gain, arguments.largest_force, arguments.patience)
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
    arguments = parser.parse_args()
    settings = [word for setting in arguments.set for word in ("--set", setting)]
    layout = floatframe_link.read_layout(arguments.program, HERE / "active_damper.yaml", *settings)
    skyhook.heading()
    passive = ride(arguments, layout, settings, 0.0)
    skyhook.show("passive", passive)
    active = ride(arguments, layout, settings, arguments.gain)
    skyhook.show("skyhook", active)
    change = active["acceleration_rms"] / passive["acceleration_rms"] - 1.0
    print(f"the rms acceleration of the chassis changes by {100 * change:+.1f} %")


if __name__ == "__main__":
    main()
