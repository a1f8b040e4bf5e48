#!/usr/bin/env python3
"""Cost of Python: a step, a callback, an output, an input, a law inside the step; processor time, the minimum of fifteen rounds. The model is so small
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


STIFFNESS = 1e7  # [N/m^1.5] of a Hertz contact


def contacts():
    """Forces of a ball above a contact, and whether they are sampled."""
    depths = [0.0] + [1e-6 * 1.02**k for k in range(480)]
    table = [[-0.5 - d, -STIFFNESS * d**1.5] for d in reversed(depths)] + [[1.0, 0.0]]

    def force(z, v, t):
        return -STIFFNESS * max(0.0, -0.5 - z) ** 1.5

    def slopes(z, v, t):
        d = max(0.0, -0.5 - z)
        return -STIFFNESS * d**1.5, 1.5 * STIFFNESS * d**0.5, 0.0

    return {
        "table": ({"type": "joint_spring", "joint": "z", "spring": {"table": table}}, None),
        "force_law, slopes": ({"type": "force_law", "joint": "z", "law": slopes}, None),
        "force_law, F alone": ({"type": "force_law", "joint": "z", "law": force}, None),
        "sampled law": ({"type": "force", "body": "ball", "direction": "z", "magnitude": {"input": "F"}}, lambda t, z: -force(z, 0.0, t)),
    }


def bounces(name, force, sampled, step=1e-3):
    """A ball dropped from 0.5 m: the height it returns to, time and calls of the law per step."""
    calls = 0

    def counted(law):
        def call(*arguments):
            nonlocal calls
            calls += 1
            return law(*arguments)

        return call

    def simulation(wrap):
        model = ff.Model("ball")
        model.points.add("c", [0, 0, 0.5])
        model.bodies.add("ball", rigid={"mass": 1, "centre_of_mass": "c", "inertia": [1e-3] * 3})
        model.joints.add("z", type="prismatic", child="ball", at="c", axis="z")
        model.inputs.add("F")
        model.forces.add("contact", {**force, "law": wrap(force["law"])} if "law" in force else force)
        model.outputs.add("z", joint_position="z")
        sim = ff.Simulation(model, step=step)
        if sampled:
            sim.law("F", wrap(sampled), of=["z"])
        return sim

    steps, best, top = round(1.0 / step), float("inf"), -1.0
    for _ in range(ROUNDS):
        sim = simulation(lambda law: law)
        start = time.thread_time()
        for _ in range(steps):
            sim.step()
        best = min(best, time.thread_time() - start)
    sim = simulation(counted)
    for _ in range(steps):
        sim.step()
        top = max(top, sim.outputs["z"]) if sim.time > 0.4 else top
    print(f"{name:20} returns to {0.5 + top:7.4f} of 0.5 m; {best / steps * 1e6:6.2f} us, {calls / steps:5.2f} calls per step")


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
    for name, kind in contacts().items():
        bounces(name, *kind)


if __name__ == "__main__":
    main()
