#!/usr/bin/env python3
"""An antilock brake outside of the model: it reads the speed sensors of the four wheels and answers with four brake torques.

    reference speed = the fastest wheel, or the last reference less 12 m/s2: what the vehicle cannot do
    slip of a wheel = 1 - rate * radius / reference speed
    torque          = what the driver asks for, but falls fast above a slip of 0.15 and rises slowly below 0.10

It starts `floatframe realtime` on handling.yaml in lock step, sends and receives packets over UDP, and prints how the vehicle stopped.
`--without`: the driver's torque as it is, with locked wheels. Packets: docs/realtime.md; standard library only.
"""
import argparse
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "active_damper"))
import floatframe_link  # noqa: E402

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
RADIUS = 0.36                                           # of a rolling wheel [m]
ASKED = dict(zip(WHEELS, (3000.0, 3000.0, 1800.0, 1800.0)))   # by the driver: locks every wheel [N m]
RELEASE, BUILD, PREVENT = 40e3, 8e3, 12.0                 # [N m/s], [N m/s], [m/s2]
SLOW = 1.5                                               # below this wheels may lock [m/s]


class AntilockBrake:
    def __init__(self):
        self.reference, self.time = 0.0, 0.0
        self.torque = dict.fromkeys(WHEELS, 0.0)

    def answer(self, outputs):
        """Torques of the brakes from the rates of the wheels, once a step."""
        step, self.time = outputs["time"] - self.time, outputs["time"]
        speeds = {wheel: outputs[f"{wheel}.rate"] * RADIUS for wheel in WHEELS}
        self.reference = max(*speeds.values(), self.reference - PREVENT * step)
        for wheel, speed in speeds.items():
            slip = 1.0 - speed / self.reference if self.reference > SLOW else 0.0
            rate = -RELEASE if slip > 0.15 else BUILD if slip < 0.10 else 0.0
            self.torque[wheel] = min(max(self.torque[wheel] + rate * step, 0.0), ASKED[wheel])
        return {f"{wheel}.brake": torque for wheel, torque in self.torque.items()}


def stop(program, model, settings=(), antilock=True, duration=10.0):
    """Drives until the vehicle stands; returns time, distance, least rate of a wheel over that of rolling, packets."""
    options = [word for setting in settings for word in ("--set", setting)]
    layout = floatframe_link.read_layout(program, model, *options)
    link = floatframe_link.Link(layout, ("127.0.0.1", 0))
    run = subprocess.Popen([program, "realtime", str(model), *options, "--duration", str(duration), "--input", "udp", "--output", "udp",
                            "--listen", "127.0.0.1:0", "--send", f"127.0.0.1:{link.address[1]}", "--lockstep", "--no-pace", "--quiet"])
    brake = AntilockBrake()
    start, least, packets = None, 1.0, 0
    try:
        while True:
            outputs = link.receive(20.0)
            if outputs is None:
                raise TimeoutError("no outputs came for 20 s")
            if outputs["last"]:
                raise RuntimeError(f"the vehicle still has {outputs['speed']:.1f} m/s after {outputs['time']:g} s")
            start = outputs["chassis.x"] if start is None else start
            if outputs["speed"] > 2.0 * SLOW:
                least = min(least, *(outputs[f"{wheel}.rate"] * RADIUS / outputs["speed"] for wheel in WHEELS))
            if outputs["speed"] < 0.01:
                break
            wanted = brake.answer(outputs)
            link.send(wanted if antilock else {f"{wheel}.brake": torque for wheel, torque in ASKED.items()})
            packets += 1
    finally:
        run.kill()
        run.wait()
        link.close()
    return {"time": outputs["time"], "distance": outputs["chassis.x"] - start, "least": least, "packets": packets}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=floatframe_link.find_program())
    parser.add_argument("--model", default=str(HERE / "handling.yaml"))
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="as given to the model")
    parser.add_argument("--without", action="store_true", help="the driver's torque as it is")
    arguments = parser.parse_args()
    found = stop(arguments.program, arguments.model, arguments.set, not arguments.without)
    print(f"stands after {found['time']:.2f} s and {found['distance']:.1f} m, {found['packets']} packets; above {2.0 * SLOW:g} m/s the slowest "
          f"wheel turned at {100.0 * abs(found['least']):.0f} % of the speed")


if __name__ == "__main__":
    main()
