"""MuJoCo: rigid chains and the vehicle. Steps are made by `mj_step(model, data, n)`: the loop over the steps is in C."""
import time

import mujoco
import numpy as np

import models

VERSION = mujoco.__version__
INTEGRATORS = {"Euler": mujoco.mjtIntegrator.mjINT_EULER, "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
               "RK4": mujoco.mjtIntegrator.mjINT_RK4}  # the most accurate one last


class Rigid:
    """A model with a site "tip" whose path is recorded."""

    def __init__(self, text):
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def start(self):
        mujoco.mj_resetData(self.model, self.data)

    def run(self, record=None, step=1e-3, duration=1.0, integrator="RK4"):
        """Processor seconds of all steps, and with `record` [s] the tip (time, x, z) at that period."""
        self.model.opt.timestep, self.model.opt.integrator = step, INTEGRATORS[integrator]
        self.start()
        if record is None:
            before = time.process_time()
            mujoco.mj_step(self.model, self.data, round(duration / step))
            return time.process_time() - before, None
        rows = []
        for k in range(round(duration / record) + 1):
            if k:
                mujoco.mj_step(self.model, self.data, round(record / step))
            mujoco.mj_kinematics(self.model, self.data)
            rows.append([k * record, *self.data.site("tip").xpos[[0, 2]]])
        return None, np.array(rows)


class RigidChain(Rigid):
    def __init__(self, links):
        super().__init__(models.chain_mjcf(links, 1e-3))


class Vehicle(Rigid):
    def __init__(self):
        super().__init__(models.vehicle_mjcf())

    def start(self):
        super().start()
        self.data.qvel[:6] = models.PUSH
        for name in models.CORNERS_OF_CAR:
            self.data.qvel[self.model.joint(f"axle_{name}").dofadr[0]] = models.WHEEL["spin"]
