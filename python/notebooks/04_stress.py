# %% [markdown]
# # Modes and stress
#
# A steel plate with a hole is pulled. Beside the hole the stress is Kt times that of the section that is left, Kt = 3 - 3.14 d/w +
# 3.667 (d/w)² - 1.527 (d/w)³ for a hole of diameter d in a plate of width w. The reduced part knows its stress as modes times
# amplitudes, so a run shows it at any place for the price of a product; what forces at interfaces do, static modes hold exactly.

# %%
import os
import tempfile

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
w, d, L, thick = 0.10, 0.02, 0.30, 0.005  # width, hole, length, thickness [m]
F = 10e3  # [N]
around, out, along = (32, 8, 5) if short else (64, 16, 10)  # elements

# %% [markdown]
# The mesh: rings from the hole to a square, strips to both ends, two layers; nodes that fall together become one.

# %%
theta = 2 * np.pi * np.arange(around + 1) / around
circle = d / 2 * np.array([np.cos(theta), np.sin(theta)])
corner = np.maximum(np.abs(np.cos(theta)), np.abs(np.sin(theta)))
square = w / 2 * np.array([np.cos(theta), np.sin(theta)]) / corner
s = np.linspace(0, 1, out + 1) ** 1.7  # fine at the hole
patches = [circle[:, :, None] * (1 - s) + square[:, :, None] * s]
sides = np.unique(np.round(square[1][np.isclose(square[0], w / 2)], 12))
for side in (-1, 1):
    xs = np.linspace(w / 2, L / 2, along + 1)
    patches.append(np.array(np.meshgrid(side * xs, side * sides, indexing="ij")))
points, cells = [], []
for patch in patches:
    n, m = patch.shape[1:]
    flat = patch.reshape(2, -1).T
    index = np.arange(3 * n * m).reshape(3, n, m) + sum(map(len, points))
    points.append(np.vstack([np.column_stack([flat, np.full(len(flat), z)]) for z in (-thick / 2, 0, thick / 2)]))
    quad = [(slice(None, -1), slice(None, -1)), (slice(1, None), slice(None, -1)), (slice(1, None), slice(1, None)), (slice(None, -1), slice(1, None))]
    corners = [index[layer][i, j].ravel() for layer in (0, 1) for i, j in quad], [index[layer][i, j].ravel() for layer in (1, 2) for i, j in quad]
    cells += [np.stack(c, axis=1) for c in corners]
_, first, same = np.unique(np.round(np.vstack(points), 9), axis=0, return_index=True, return_inverse=True)
points, cells = np.vstack(points)[first], same.ravel()[np.vstack(cells)]
a, b, c, e = (points[cells[:, k]] for k in (0, 1, 3, 4))
turned = np.einsum("ij,ij->i", np.cross(b - a, c - a), e - a) < 0
cells[turned] = cells[turned][:, [4, 5, 6, 7, 0, 1, 2, 3]]
ends = {"LEFT": ff.plane([-L / 2, 0, 0], "x"), "RIGHT": ff.plane([L / 2, 0, 0], "x")}
steel = ff.Material(2.1e11, 0.3, 7850.0)
part = ff.reduce(ff.Mesh(points, [("hex8i", cells)]), material=steel, interfaces=ends, modes=4, reference="node:LEFT", damping=0.02)

# %% [markdown]
# One end is held, the other pulled by a force that is there at once: stress swings about its static value. (It does not begin at zero exactly: the
# wave of the first microseconds is not among the modes.) Then the same from the equilibrium.

# %%
places = np.unique(np.round(points[(np.abs(points[:, 0]) < 1e-9) & (points[:, 1] > 0), 1], 9))
with tempfile.TemporaryDirectory() as folder:
    part.save(os.path.join(folder, "plate.ffb"))
    model = ff.Model("plate", folder=folder)
    model.data["gravity"] = [0, 0, 0]
    model.bodies.add("plate", flexible="plate.ffb")
    model.joints.add("clamp", type="weld", parent="ground", child="plate", child_node="LEFT")
    model.forces.add("pull", type="force", body="plate", node="RIGHT", direction="x", magnitude=F)
    for k, y in enumerate(places):
        model.outputs.add(f"s{k}", stress={"body": "plate", "at": [0, y, thick / 2]}, component="xx")
    model.simulation.update(step=2e-6, duration=4e-4 if short else 1e-3)
    res = ff.run(model)
    model.simulation.update(start="equilibrium", duration=1e-5)
    static = ff.run(model)
stress = np.array([static[f"s{k}"][0] for k in range(len(places))])

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
left.plot(1e3 * places, 1e-6 * stress, "o-", ms=3)
left.axhline(1e-6 * F / ((w - d) * thick), color="gray", ls=":", label="mean of the section")
left.set(xlabel="place across the plate, from the middle of the hole [mm]", ylabel="stress along the pull [MPa]", ylim=0)
left.legend()
right.plot(1e3 * res.time, 1e-6 * res["s0"], label="beside the hole")
right.axhline(1e-6 * stress[0], color="gray", ls=":", label="at rest")
right.set(xlabel="time [ms]", ylabel="stress [MPa]")
right.legend()
plt.show()

# %% [markdown]
# The formula for the largest stress; and what the section carries together must be the force.

# %%
ratio = d / w
Kt = 3 - 3.14 * ratio + 3.667 * ratio**2 - 1.527 * ratio**3
nominal = F / ((w - d) * thick)
carried = 2 * thick * np.trapezoid(stress, places)
print(f"{part.report.nodes} nodes, {part.body.modes} modes, {len(places)} gauges")
print(f"stress beside the hole: {1e-6 * stress[0]:.2f} MPa, {stress[0] / nominal:.3f} of the mean; formula {Kt:.3f}")
print(f"carried by the section: {1e-3 * carried:.3f} kN of {1e-3 * F:.3f} kN")
print(f"suddenly pulled: {res['s0'].max() / stress[0]:.2f} times the stress at rest")
assert abs(stress[0] / nominal / Kt - 1) < (0.1 if short else 0.05)
assert abs(carried / F - 1) < (0.05 if short else 0.02)
