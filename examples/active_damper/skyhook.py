#!/usr/bin/env python3
"""A skyhook controller for active_damper.yaml: each actuator acts as if the chassis hung on a damper from the sky.

    force = gain * vertical velocity of the chassis where the actuator is fixed

The force pulls the chassis down while it rises and pushes it up while it falls. Run it beside
`floatframe realtime`, or let compare.py start both.
"""
import argparse
import math
import pathlib

import floatframe_link

CORNERS = ("front_left", "front_right", "rear_left", "rear_right")


def control(link, gain, largest_force, patience, keep=None):
    """Answers outputs until the last packet; returns the judgement of the ride. `keep` is called with all outputs."""
    count, az2, pitch2, tyre, force2 = 0, 0.0, 0.0, math.inf, 0.0
    while True:
        outputs = link.receive(patience)
        if outputs is None:
            raise TimeoutError(f"no outputs came for {patience:g} s")
        if keep:
            keep(outputs)
        if outputs["last"]:
            break
        forces = {}
        for corner in CORNERS:
            wanted = gain * outputs[f"{corner}.vz"]
            forces[corner] = min(max(wanted, -largest_force), largest_force)
        link.send(forces)
        count += 1
        az2 += outputs["chassis.az"] ** 2
        pitch2 += outputs["chassis.pitch"] ** 2
        tyre = min(tyre, outputs["front_left.tyre"], outputs["rear_left.tyre"])
        force2 += outputs["front_left.actuator"] ** 2
    count = max(count, 1)
    return {"packets": count, "time": outputs["time"], "acceleration_rms": math.sqrt(az2 / count),
            "pitch_rms": math.sqrt(pitch2 / count), "smallest_tyre_force": tyre,
            "actuator_rms": math.sqrt(force2 / count)}


def show(title, ride):
    print(f"{title:10} {ride['acceleration_rms']:8.3f} m/s2 {1e3 * ride['pitch_rms']:9.2f} mrad "
          f"{ride['smallest_tyre_force']:9.0f} N {ride['actuator_rms']:9.0f} N {ride['packets']:9d}")


def heading():
    print(f"{'':10} {'chassis az, rms':>13} {'pitch, rms':>13} {'least tyre':>11} {'actuator':>11} {'packets':>9}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=floatframe_link.find_program(), help="asked for the layout")
    parser.add_argument("--model", default=str(pathlib.Path(__file__).resolve().parent / "active_damper.yaml"))
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="as given to the model")
    parser.add_argument("--gain", type=float, default=8000.0, help="of the skyhook [N s/m]; 0: passive")
    parser.add_argument("--largest-force", type=float, default=8000.0, help="[N]")
    parser.add_argument("--port", type=int, default=47101, help="where the outputs come in")
    parser.add_argument("--patience", type=float, default=60.0, help="longest wait for outputs [s]")
    arguments = parser.parse_args()
    settings = [word for setting in arguments.set for word in ("--set", setting)]
    layout = floatframe_link.read_layout(arguments.program, arguments.model, *settings)
    link = floatframe_link.Link(layout, ("127.0.0.1", arguments.port))
    print(f"waiting for outputs at 127.0.0.1:{link.address[1]}", flush=True)
    ride = control(link, arguments.gain, arguments.largest_force, arguments.patience)
    heading()
    show("skyhook" if arguments.gain else "passive", ride)


if __name__ == "__main__":
    main()
