#!/usr/bin/env python3
"""Cost of Python: a step, a callback, an output, an input; processor time, the minimum of fifteen rounds. The model is so small
that its steps do not dominate: in C++ the same step takes about 0.95 us where this prints 1.16 us.

Usage: PYTHONPATH=build/python python3 bench/python_overhead.py
"""
import time

import floatframe as ff

ROUNDS, CALLS = 15, 20000


def pendulum():
    model = ff.Model("pendulum")
    model.points.update(hinge=[0, 0, 0], end=[0.6, 0, 0])
    model.bodies.add("lever", rigid={"mass": 2, "centre_of_mass": [0.3, 0, 0], "inertia": [0.001, 0.06, 0.06]})
    model.inputs.add("torque", initial=0)
    model.joints.add("hinge", type="revolute", parent="ground", child="lever", at="hinge", axis="y")
    model.forces.add("motor", type="joint_spring", joint="hinge", damper=0.05, actuator={"input": "torque"})
    model.outputs.add("end.z", position={"body": "lever", "at": "end"}, axis="z")
    model.simulation.update(step=1e-3, duration=CALLS * 1e-3)
    return model


def least(call):
    """Microseconds of processor time of a call."""
    best = float("inf")
    for _ in range(ROUNDS):
        start = time.thread_time()
        for _ in range(CALLS):
            call()
        best = min(best, time.thread_time() - start)
    return best / CALLS * 1e6


def main():
    model = pendulum()
    sim = ff.Simulation(model)
    outputs, inputs = sim.outputs, sim.inputs
    print(ff.build_info()["build"], "on", ff.build_info()["processor"])
    print(f"sim.step()                 {least(sim.step):6.2f} us")
    sim.on_step(lambda time, outputs, inputs: None)
    print(f"with on_step               {least(sim.step):6.2f} us")
    sim.on_step(None)
    sim.law("torque", lambda time, z: 0.0, of=["end.z"])
    print(f"with a law of one output   {least(sim.step):6.2f} us")
    print(f"outputs[name]              {least(lambda: outputs['end.z']):6.2f} us")
    print(f"inputs[name] = value       {least(lambda: inputs.__setitem__('torque', 1.0)):6.2f} us")


if __name__ == "__main__":
    main()
