"""Models that tests control."""

import floatframe as ff
import numpy as np


def cart_pole(angle=0.0):
    """A cart that a force pushes along x, with a pole that stands upright on it."""
    m = ff.Model("cart_pole")
    m.points.update(c=[0, 0, 0], top=[0, 0, 1])
    m.bodies.add("cart", rigid={"mass": 1, "centre_of_mass": "c", "inertia": [0.01, 0.01, 0.01]})
    m.bodies.add("pole", rigid={"mass": 0.2, "centre_of_mass": [0, 0, 0.5], "inertia": [0.02, 0.02, 1e-4]})
    m.joints.add("slide", type="prismatic", child="cart", at="c", axis="x")
    m.joints.add("hinge", type="revolute", parent="cart", child="pole", at="c", axis="y", position=angle)
    m.inputs.add("F", unit="N")
    m.forces.add("push", type="force", body="cart", direction="x", magnitude={"input": "F"})
    for name, joint in (("x", "slide"), ("angle", "hinge")):
        m.outputs.add(name, joint_position=joint)
        m.outputs.add(f"{name}.rate", joint_velocity=joint)
    m.simulation.update(step=1e-3, duration=3)
    return m


def follower(force=None, angle=0.0):
    """A bar on a hinge, with a force across it whose direction stays: its stiffness depends on the force."""
    m = ff.Model("follower")
    m.data["gravity"] = [0, 0, 0]
    m.points.update(a=[0, 0, 0], b=[1, 0, 0])
    m.bodies.add("bar", rigid={"mass": 1, "centre_of_mass": [0.5, 0, 0], "inertia": [0.01, 0.08, 0.08]})
    m.joints.add("hinge", type="revolute", child="bar", at="a", axis="y", position=angle)
    m.inputs.add("F", **({} if force is None else {"initial": force}))
    m.forces.add("pull", type="force", body="bar", at="b", direction="x", magnitude={"input": "F"})
    m.outputs.add("angle", joint_position="hinge")
    return m


def soft_beam():
    """A beam of 2 mm that falls and bends by half its length."""
    m = ff.Model("soft_beam")
    m.points.update(a=[0, 0, 0], b=[1, 0, 0])
    bar = {"from": "a", "to": "b", "elements": 4, "section": {"round": 0.002}}
    m.bodies.add("beam", flexible={"material": {"young": 7e7, "poisson": 0.3, "density": 7800}, "bars": {"b": bar}, "clamped": ["a"],
                                   "static_modes": [{"point": "b", "dofs": ["z"]}]})
    m.joints.add("hinge", type="revolute", child="beam", at="a", axis="y")
    m.outputs.add("z", position={"body": "beam", "at": "b"})
    m.simulation.update(step=1e-3, duration=1)
    return m


def four_bar():
    """A crank of 0.2 m, a coupler of 0.5 m, a rocker of 0.4 m on a ground of 0.5 m."""
    m = ff.Model("four_bar")
    m.points.update(a=[0, 0, 0], b=[0, 0, 0.2], c=[0.5, 0, 0.4], d=[0.5, 0, 0])
    for name, first, last in (("crank", "a", "b"), ("coupler", "b", "c"), ("rocker", "d", "c")):
        centre = 0.5 * (np.array(m.points[first]) + np.array(m.points[last]))
        m.bodies.add(name, rigid={"mass": 1, "centre_of_mass": centre.tolist(), "inertia": [0.01, 0.02, 0.01]})
    for name, parent, child, at in (("a", "ground", "crank", "a"), ("b", "crank", "coupler", "b"), ("c", "coupler", "rocker", "c"),
                                    ("d", "ground", "rocker", "d")):
        m.joints.add(name, type="revolute", parent=parent, child=child, at=at, axis="y")
        m.outputs.add(f"{name}.angle", joint_position=name)
        m.outputs.add(f"{name}.rate", joint_velocity=name)
    m.simulation.update(step=1e-3, duration=1)
    return m
