# %% [markdown]
# # Pendulum
#
# A slender rod swings about a hinge, released at 150° from hanging. The equation is I d²φ/dt² = -m g l sin φ, and its period
# grows with the amplitude: T = 2π √(I / (m g l)) / agm(1, cos(φ₀/2)), with the arithmetic-geometric mean agm. Nothing dissipates,
# so the sum of kinetic and potential energy stays.

# %%
import os

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
m, L, g = 2.0, 0.6, 9.81  # [kg], [m], [m/s2]
start = np.radians(150)  # from hanging

# %% [markdown]
# The rod lies along -z in the design configuration, so that the coordinate of the hinge is the angle from hanging.

# %%
model = ff.Model("pendulum")
model.data["gravity"] = [0, 0, -g]
model.points.add("hinge", [0, 0, 0])
model.points.add("end", [0, 0, -L])
model.bodies.add("rod", rigid={"mass": m, "centre_of_mass": [0, 0, -L / 2], "inertia": [m * L**2 / 12, m * L**2 / 12, 1e-4]})
model.joints.add("hinge", type="revolute", parent="ground", child="rod", at="hinge", axis="y", position=start)
model.outputs.add("angle", joint_position="hinge")
model.outputs.add("rate", joint_velocity="hinge")
model.simulation.update(step=1e-3, duration=3 if short else 8)
res = ff.run(model)

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
left.plot(res.time, np.degrees(res["angle"]))
left.set(xlabel="time [s]", ylabel="angle from hanging [°]")
right.plot(np.degrees(res["angle"]), res["rate"])
right.set(xlabel="angle from hanging [°]", ylabel="rate [rad/s]")
plt.show()

# %% [markdown]
# The period, measured between two passages through the lowest place in the same direction, against the formula.


# %%
def agm(a, b):
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, np.sqrt(a * b)
    return a


angle, t = res["angle"], res.time
k = np.flatnonzero((angle[:-1] < 0) & (angle[1:] >= 0))
crossings = t[k] - angle[k] * (t[k + 1] - t[k]) / (angle[k + 1] - angle[k])
inertia = m * L**2 / 3
small = 2 * np.pi * np.sqrt(inertia / (m * g * L / 2))
period = small / agm(1.0, np.cos(start / 2))
energy = 0.5 * inertia * res["rate"] ** 2 - m * g * L / 2 * np.cos(angle)
if len(crossings) > 1:
    measured = (crossings[-1] - crossings[0]) / (len(crossings) - 1)
else:  # a short run: three quarters of a period pass until the first one
    measured = crossings[0] / 0.75
print(f"period: {measured:.6f} s, formula {period:.6f} s, of small swings {small:.6f} s")
print(f"energy: stays to {np.ptp(energy):.1e} of {m * g * L:.2f} J between the lowest and the highest place")
assert abs(measured / period - 1) < 1e-5
assert np.ptp(energy) < 1e-5 * m * g * L
