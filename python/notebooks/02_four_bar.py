# %% [markdown]
# # Four-bar linkage
#
# A crank drives a rocker through a coupler: a closed loop of three bodies. A linkage drawn in space must not prescribe a
# direction twice: crank hinge 5, universal joint 4, ball 3 and rocker hinge 5 conditions leave 18 - 17 = 1 degree of freedom,
# which a motor with a given motion takes. Where the rocker is then follows from geometry alone, by two circles.

# %%
import os

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
a, b, c, d = 0.10, 0.35, 0.25, 0.40  # crank, coupler, rocker, ground [m]
speed = 2 * np.pi  # of the crank [rad/s]


def rocker_pin(crank_angle):
    """Intersection of the circles about crank pin and rocker hinge; angles about y, from x towards -z."""
    x, z = a * np.cos(crank_angle), -a * np.sin(crank_angle)
    ex, ez = d - x, -z
    r = np.hypot(ex, ez)
    s = (b**2 - c**2 + r**2) / (2 * r)  # along the line between the centres, and off it
    h = np.sqrt(b**2 - s**2)
    return x + (s * ex - h * ez) / r, z + (s * ez + h * ex) / r


# %%
model = ff.Model("four_bar")
A, D, B = [0, 0, 0], [d, 0, 0], [a, 0, 0]
x, z = rocker_pin(0.0)
C = [float(x), 0, float(z)]
for name, place in {"A": A, "B": B, "C": C, "D": D}.items():
    model.points.add(name, place)
for name, p, q in [("crank", A, B), ("coupler", B, C), ("rocker", C, D)]:
    length = float(np.linalg.norm(np.subtract(p, q)))
    J = length**3 / 12  # of 1 kg/m
    centre = [(u + v) / 2 for u, v in zip(p, q)]
    model.bodies.add(name, rigid={"mass": length, "centre_of_mass": centre, "inertia": [J, J, J]})
motion = {"polynomial": [0, speed]}
model.joints.add("motor", type="revolute", parent="ground", child="crank", at="A", axis="y", motion=motion)
model.joints.add("crank_pin", type="universal", parent="crank", child="coupler", at="B", axis="y", axis_2="z")
model.joints.add("rocker_hinge", type="revolute", parent="ground", child="rocker", at="D", axis="y")
model.joints.add("rocker_pin", type="spherical", parent="rocker", child="coupler", at="C")
for body, point in [("crank", "B"), ("rocker", "C")]:
    model.outputs.add(point, position={"body": body, "at": point})
model.outputs.add("torque", motion_force="motor")
model.simulation.update(step=2e-3, duration=0.3 if short else 1.0)
relative = ff.run(model, coordinates="relative")
absolute = ff.run(model, coordinates="absolute")

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
for k in np.linspace(0, len(relative.time) - 1, 9).astype(int):
    xs = [0, relative["B.x"][k], relative["C.x"][k], d]
    zs = [0, relative["B.z"][k], relative["C.z"][k], 0]
    left.plot(xs, zs, "o-", color=plt.cm.viridis(k / len(relative.time)), lw=1, ms=3)
left.set(aspect="equal", xlabel="x [m]", ylabel="z [m]")
right.plot(relative.time, relative["torque"], label="relative coordinates")
right.plot(absolute.time, absolute["torque"], "--", label="absolute coordinates")
right.set(xlabel="time [s]", ylabel="torque of the motor [N m]")
right.legend()
plt.show()

# %% [markdown]
# Geometry gives the place of the pin; the second formulation, with other coordinates, gives the same torque.

# %%
x, z = rocker_pin(speed * relative.time)
places = np.hypot(relative["C.x"] - x, relative["C.z"] - z).max()
later = relative.time > 0.02
torque = np.abs(relative["torque"] - absolute["torque"])[later].max() / np.abs(relative["torque"]).max()
print(f"degrees of freedom left to the motor: {18 - 5 - 4 - 3 - 5}")
print(f"pin of the rocker: off the circles by at most {places:.1e} m")
print(f"torque of the motor: at most {np.abs(relative['torque']).max():.3f} N m; the formulations differ by {torque:.1e} of it")
assert places < 1e-7
assert torque < 1e-3
