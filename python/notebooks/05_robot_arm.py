# %% [markdown]
# # Flexible robot arm with a controller
#
# A motor turns a slender aluminium arm with a load at its end; the controller, a function of Python that is called in each step, sees
# the angle and the rate of the motor only. It moves by 60° in 0.4 s, once at constant speed and once as s = 10 τ³ - 15 τ⁴ + 6 τ⁵, which starts
# and ends without acceleration. The abrupt move rings the vibration of the arm with its controller; what frequency and damping that must have
# follows from the eigenvalues of the same arm with a spring and a damper in place of the controller.

# %%
import os

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

L, load = 0.8, 0.5  # [m], [kg]
kp, kd = 6000.0, 40.0  # [N m/rad], [N m s/rad]
goal, T = np.radians(60), 0.4  # [rad], [s]
step, duration = 1e-4, 0.8 if os.environ.get("FLOATFRAME_SHORT") == "1" else 1.2


def arm(controller):
    """The arm in the horizontal plane; with an input for a controller, or with spring and damper."""
    model = ff.Model("robot_arm")
    model.data["gravity"] = [0, 0, 0]
    model.data["points"] = {"shoulder": [0, 0, 0], "hand": [L, 0, 0]}
    bar = {"from": "shoulder", "to": "hand", "elements": 8, "section": {"round": 0.02}, "reference": "y"}
    flexible = {"material": {"young": 70e9, "poisson": 0.3, "density": 2700}, "bars": {"bar": bar}, "clamped": ["shoulder"]}
    flexible |= {"static_modes": [{"point": "hand", "dofs": ["y", "z", "ry", "rz"]}], "normal_modes": 2}
    model.bodies.add("arm", flexible=flexible)
    model.bodies.add("load", rigid={"mass": load, "centre_of_mass": "hand", "inertia": [5e-4, 5e-4, 5e-4]})
    model.bodies.add("rotor", rigid={"mass": 2.0, "centre_of_mass": "shoulder", "inertia": [0.1, 0.1, 0.1]})
    model.joints.add("motor", type="revolute", parent="ground", child="rotor", at="shoulder", axis="z")
    model.joints.add("hub", type="weld", parent="rotor", child="arm", at="shoulder")
    model.joints.add("grip", type="weld", parent="arm", child="load", at="hand")
    if controller:
        model.inputs.add("torque", unit="N m")
        model.forces.add("drive", type="joint_spring", joint="motor", actuator={"input": "torque"})
    else:
        model.forces.add("drive", type="joint_spring", joint="motor", spring=kp, damper=kd)
    model.data["outputs"] = {"angle": {"joint_position": "motor"}, "rate": {"joint_velocity": "motor"}}
    model.outputs.add("hand", position={"body": "arm", "at": "hand"})
    return model


def smooth(t):
    tau = min(t / T, 1.0)
    return goal * (10 * tau**3 - 15 * tau**4 + 6 * tau**5), goal * 30 * tau**2 * (1 - tau) ** 2 / T


commands = {"abrupt": lambda t: (goal * min(t / T, 1.0), goal / T if t < T else 0.0), "smooth": smooth}


def move(command):
    """Time, angle of the motor, deflection of the hand across the arm."""
    sim = ff.Simulation(arm(controller=True), step=step)
    angle, rate = (list(sim.outputs).index(name) for name in ("angle", "rate"))

    def controller(time, outputs, inputs):
        wanted, wanted_rate = command(time)
        inputs[0] = kp * (wanted - outputs[angle]) + kd * (wanted_rate - outputs[rate])

    sim.on_step(controller)
    rows = []
    while sim.time < duration - step / 2:
        sim.step()
        phi, x, y = (sim.outputs[name] for name in ("angle", "hand.x", "hand.y"))
        rows.append((sim.time, phi, y * np.cos(phi) - x * np.sin(phi), x, y))
    return np.array(rows).T


# %%
runs = {name: move(command) for name, command in commands.items()}
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
for name, (t, phi, bend, *_) in runs.items():
    left.plot(t, np.degrees(phi), label=name)
    right.plot(t, 1e3 * bend, label=name)
for axes, what in ((left, "angle of the motor [°]"), (right, "deflection of the hand [mm]")):
    axes.set(xlabel="time [s]", ylabel=what)
left.legend()
plt.show()

# %% [markdown]
# The deflection after the abrupt move, fitted by the eigenvalues: if it is right, what is left of the fit is small.

# %%
modes = [m for m in ff.modes(arm(controller=False)) if m.damping > 1e-6]  # those out of the plane are not damped
t, phi, bend, x, y = runs["abrupt"]
late = t > T + 0.05
decay = np.concatenate([[np.exp(m.eigenvalue * t[late]).real, np.exp(m.eigenvalue * t[late]).imag] for m in modes[:3]])
fit = np.linalg.lstsq(decay.T, bend[late], rcond=None)[0] @ decay
misfit = np.abs(fit - bend[late]).max() / np.abs(bend[late]).max()
peaks = {name: 1e3 * np.abs(run[2]).max() for name, run in runs.items()}
end = np.hypot(runs["smooth"][3][-1] - L * np.cos(goal), runs["smooth"][4][-1] - L * np.sin(goal))
print(", ".join(f"{m.frequency:.3f} Hz with damping {m.damping:.3f}" for m in modes[:3]), "by the eigenvalues")
print(f"vibration after the abrupt move fitted by these: off by {100 * misfit:.2f} % of its largest deflection")
print(f"largest deflection: abrupt {peaks['abrupt']:.2f} mm, smooth {peaks['smooth']:.2f} mm")
print(f"hand after the smooth move: {1e3 * end:.4f} mm from (L cos 60°, L sin 60°)")
assert misfit < 0.02 and end < 2e-3 * L and peaks["smooth"] < 0.6 * peaks["abrupt"]
