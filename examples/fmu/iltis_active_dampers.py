#!/usr/bin/env python3
"""The Iltis with active dampers as an FMU, driven by FMPy: a skyhook controller closes the loop once a millisecond.

    pip install fmpy
    python3 examples/fmu/iltis_active_dampers.py                 # without and with the controller, both versions of FMI
    python3 examples/fmu/iltis_active_dampers.py --fmi 3 --compare ride.csv

The model, the law and its judgement are those of ../active_damper, where the controller is another process and talks over UDP.
`--compare` takes a table of that example (compare.py --lockstep --table ride.csv) and prints the largest difference of each
output at equal instants.
"""
import argparse
import csv
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE.parent / "active_damper" / "active_damper.yaml"
CORNERS = ("front_left", "front_right", "rear_left", "rear_right")


def find_program():
    built = HERE.parents[1] / "build" / "floatframe"
    return str(built) if built.is_file() else shutil.which("floatframe") or str(built)


class Vehicle:
    """An instance of the FMU, initialised. FMI 2 and FMI 3 differ in names alone."""

    def __init__(self, fmu, folder):
        import fmpy
        import fmpy.fmi2
        import fmpy.fmi3

        description = fmpy.read_model_description(fmu)
        self.third = description.fmiVersion.startswith("3")
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.outputs = [v.name for v in description.modelVariables if v.causality == "output"]
        self.step = float(description.defaultExperiment.stepSize)
        self.duration = float(description.defaultExperiment.stopTime)
        kind = fmpy.fmi3.FMU3Slave if self.third else fmpy.fmi2.FMU2Slave
        self.fmu = kind(
            guid=description.guid,
            unzipDirectory=fmpy.extract(fmu, folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="iltis",
        )
        self.fmu.instantiate()
        if self.third:
            self.fmu.enterInitializationMode(startTime=0.0)
        else:
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, names):
        references = [self.reference[n] for n in names]
        return list(self.fmu.getFloat64(references) if self.third else self.fmu.getReal(references))

    def set(self, values):
        references, numbers = [self.reference[n] for n in values], list(values.values())
        if self.third:
            self.fmu.setFloat64(references, numbers)
        else:
            self.fmu.setReal(references, numbers)

    def do_step(self, time):
        self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=self.step)

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()


def ride(fmu, gain, largest_force, duration):
    """Drives; returns all outputs at each instant, and the judgement of the ride. As over UDP in lockstep, the controller answers
    the outputs before each step, those of the start first; the last instant is not judged."""
    folder = tempfile.mkdtemp(prefix="floatframe_fmu_")
    try:
        vehicle = Vehicle(fmu, folder)
        rows, az2, pitch2, tyre, force2 = [], 0.0, 0.0, math.inf, 0.0
        steps = round((duration or vehicle.duration) / vehicle.step)
        for k in range(steps + 1):
            values = dict(zip(vehicle.outputs, vehicle.get(vehicle.outputs)))
            rows.append({"time": k * vehicle.step, **values})
            if k == steps:
                break
            wanted = {c: gain * values[f"{c}.vz"] for c in CORNERS}
            vehicle.set({c: min(max(f, -largest_force), largest_force) for c, f in wanted.items()})
            az2 += values["chassis.az"] ** 2
            pitch2 += values["chassis.pitch"] ** 2
            tyre = min(tyre, values["front_left.tyre"], values["rear_left.tyre"])
            force2 += values["front_left.actuator"] ** 2
            vehicle.do_step(k * vehicle.step)
        vehicle.close()
        return rows, {
            "acceleration_rms": math.sqrt(az2 / steps),
            "pitch_rms": math.sqrt(pitch2 / steps),
            "smallest_tyre_force": tyre,
            "actuator_rms": math.sqrt(force2 / steps),
        }
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def show(title, judged, steps):
    print(
        f"{title:18} {judged['acceleration_rms']:8.3f} m/s2 {1e3 * judged['pitch_rms']:9.2f} mrad "
        f"{judged['smallest_tyre_force']:9.0f} N {judged['actuator_rms']:9.0f} N {steps:9d}"
    )


def compare(rows, table):
    """Largest difference of each output at equal instants."""
    with open(table, newline="", encoding="utf-8") as file:
        other = {round(float(row["time"]), 9): row for row in csv.DictReader(file)}
    pairs = [(row, other[round(row["time"], 9)]) for row in rows if round(row["time"], 9) in other]
    print(f"{len(pairs)} equal instants with {table}")
    for name in rows[0]:
        if name != "time":
            print(f"  {name:24} {max((abs(a[name] - float(b[name])) for a, b in pairs), default=math.nan):.3g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=find_program())
    parser.add_argument("--fmi", choices=["2", "3"], help="default: both")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the model")
    parser.add_argument("--duration", type=float, help="[s]; default: that of the model")
    parser.add_argument("--gain", type=float, default=8000.0, help="of the skyhook [N s/m]")
    parser.add_argument("--largest-force", type=float, default=8000.0, help="[N]")
    parser.add_argument("--compare", metavar="CSV", help="a table of compare.py --lockstep --table")
    arguments = parser.parse_args()
    settings = [word for setting in arguments.set for word in ("--set", setting)]
    print(f"{'':18} {'chassis az, rms':>13} {'pitch, rms':>13} {'least tyre':>11} {'actuator':>11} {'steps':>9}")
    with tempfile.TemporaryDirectory(prefix="floatframe_fmu_") as folder:
        for version in [arguments.fmi] if arguments.fmi else ["2", "3"]:
            fmu = str(pathlib.Path(folder) / f"iltis{version}.fmu")
            command = [arguments.program, "fmu", str(MODEL), "-o", fmu, "--fmi", version, "--quiet", *settings]
            done = subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
            if done.returncode != 0:
                sys.exit(f"{arguments.program} ended with exit code {done.returncode}")
            limits = (arguments.largest_force, arguments.duration)
            rows, judged = ride(fmu, 0.0, *limits)
            show(f"passive, FMI {version}", judged, len(rows) - 1)
            rows, judged = ride(fmu, arguments.gain, *limits)
            show(f"skyhook, FMI {version}", judged, len(rows) - 1)
            if arguments.compare:
                compare(rows, arguments.compare)


if __name__ == "__main__":
    main()
