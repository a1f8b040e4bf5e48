"""Pinocchio: rigid chains. It has algorithms but no integrator: the Runge-Kutta steps are implemented here, in Python.

The time is that of four calls of `aba` (the accelerations by the articulated-body algorithm) per step, along the compared
motion. The loop of Python around them, measured with a model of one joint, is subtracted; the cost of adding the stages is not
counted.
"""
import time

import numpy as np
import pinocchio as pin

import models

VERSION = pin.__version__


def chain(links):
    model = pin.Model()
    model.gravity.linear = np.array([0.0, 0.0, -models.GRAVITY])
    inertia = pin.Inertia(models.MASS, np.array([models.LENGTH / 2, 0.0, 0.0]), np.diag(models.LINK_INERTIA))
    joint = 0
    for i in range(links):
        place = pin.SE3(np.eye(3), np.array([models.LENGTH if i else 0.0, 0.0, 0.0]))
        joint = model.addJoint(joint, pin.JointModelRY(), place, f"hinge_{i + 1}")
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    return model


class RigidChain:
    def __init__(self, links):
        self.model, self.one = chain(links), chain(1)
        self.links = links

    def run(self, record=None, step=1e-3, duration=1.0):
        """Processor seconds of the calls, and with `record` [s] the tip (time, x, z) at that period."""
        steps = round(duration / step)
        if record is None:
            times = []
            for model in (self.model, self.one):
                data, q, v = model.createData(), np.zeros(model.nv), np.zeros(model.nv)
                aba, force = pin.aba, np.zeros(model.nv)
                before = time.process_time()
                for _ in range(4 * steps):
                    aba(model, data, q, v, force)
                times.append(time.process_time() - before)
            return times[0] - times[1], None
        model, data = self.model, self.model.createData()
        q, v, force, rows = np.zeros(model.nv), np.zeros(model.nv), np.zeros(model.nv), []
        for k in range(steps + 1):
            if k % round(record / step) == 0:
                pin.forwardKinematics(model, data, q)
                tip = data.oMi[self.links].act(np.array([models.LENGTH, 0.0, 0.0]))
                rows.append([k * step, tip[0], tip[2]])
            a1 = pin.aba(model, data, q, v, force).copy()
            v2 = v + 0.5 * step * a1
            a2 = pin.aba(model, data, q + 0.5 * step * v, v2, force).copy()
            v3 = v + 0.5 * step * a2
            a3 = pin.aba(model, data, q + 0.5 * step * v2, v3, force).copy()
            v4 = v + step * a3
            a4 = pin.aba(model, data, q + step * v3, v4, force).copy()
            q, v = q + step / 6 * (v + 2 * v2 + 2 * v3 + v4), v + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        return None, np.array(rows)
