# %% [markdown]
# # From finite elements to a flexible body
#
# A bar of hexahedra, clamped at one end, is reduced by Craig and Bampton: static modes that move its tip, and vibrations with both
# ends held. What the full model deforms to under loads at the tip the static modes hold exactly, and low frequencies come with
# the vibrations: u = X y. Beam theory gives δ = F L³/(3 E I) (1 + shear) and ω₁ = 1.8751² √(E I / (ρ A L⁴)).

# %%
import os
import tempfile

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
L, b, h = 1.0, 0.04, 0.02  # [m]
E, nu, rho = 2.1e11, 0.3, 7850.0


def box(n, size):
    """Points and hexahedra of a block."""
    axes = [np.linspace(0.0, s, k + 1) for s, k in zip(size, n)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    index = np.arange(len(points)).reshape([k + 1 for k in n])
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return points, np.stack([index[i : i + n[0], j : j + n[1], k : k + n[2]].ravel() for i, j, k in corners], axis=1)


points, cells = box((40, 4, 2), (L, b, h))
mesh = ff.Mesh(points, [("hex8i", cells)])
ends = {"ROOT": ff.plane([0, 0, 0], "x"), "TIP": ff.plane([L, 0, 0], "x")}
part = ff.reduce(mesh, material=ff.Material(E, nu, rho), interfaces=ends, modes=6, reference="node:ROOT")
part.report

# %% [markdown]
# The reduced body by itself: K y = X_tipᵀ F gives the deflection, K x = ω² M x the frequencies of the clamped bar.

# %%
K, Sij = part.body.K, part.invariants.Sij
M = sum(Sij[i][i] for i in range(3))
tip = part.body.nodes["TIP"]
force = np.array([0.0, 0.0, 100.0])
deflection = (tip.X @ np.linalg.solve(K, tip.X.T @ force))[2]
G, A, I = E / (2 * (1 + nu)), b * h, b * h**3 / 12
beam = force[2] * (L**3 / (3 * E * I) + L / (5 / 6 * G * A))
frequency = np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K)).real.min()) / (2 * np.pi)
euler = 1.8751041**2 * np.sqrt(E * I / (rho * A * L**4)) / (2 * np.pi)

# %% [markdown]
# In a model it is a body like any other: clamped to the ground, it falls under its weight and swings. Its modes are the static and the normal ones
# made orthogonal: vibrations with `ROOT` held, where the body frame is.

# %%
with tempfile.TemporaryDirectory() as folder:
    part.save(os.path.join(folder, "bar.ffb"))
    model = ff.Model("cantilever", folder=folder)
    model.bodies.add("bar", flexible="bar.ffb")
    model.joints.add("clamp", type="weld", parent="ground", child="bar", child_node="ROOT")
    model.outputs.add("tip", position={"body": "bar", "node": "TIP"}, axis="z")
    model.simulation.update(step=2e-4, duration=0.3 if short else 1.0)
    modes = ff.modes(model)
    res = ff.run(model)
z = res["tip"]

# %%
edge = np.flatnonzero((np.abs(part.nodes[:, 1]) < 1e-9) & (np.abs(part.nodes[:, 2]) < 1e-9))
edge = edge[np.argsort(part.nodes[edge, 0])]
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
bending = [k for k in range(part.body.modes) if np.abs(part.mode_shapes[edge, 2, k]).max() > 0.9 * np.abs(part.mode_shapes[:, :, k]).max()]
for k in bending[:4]:
    w = part.mode_shapes[edge, 2, k]
    left.plot(part.nodes[edge, 0], w / w[np.abs(w).argmax()], label=f"{part.frequencies[k]:.1f} Hz")
left.set(xlabel="x [m]", ylabel="displacement along z, scaled", title="modes that bend about y")
left.legend(fontsize="small")
right.plot(res.time, 1e3 * z)
right.set(xlabel="time [s]", ylabel="height of the tip [mm]", title="released under its weight")
plt.show()

# %%
passages = np.flatnonzero((z[:-1] < z.mean()) & (z[1:] >= z.mean()))
measured = (len(passages) - 1) / (res.time[passages[-1]] - res.time[passages[0]])
print(f"{part.report.dofs} degrees of freedom of the elements, {part.body.modes} modes; {part.invariants.m:.4f} kg, {rho * A * L:.4f} kg by hand")
print(f"deflection under {force[2]:.0f} N at the tip: {1e3 * deflection:.4f} mm, beam theory {1e3 * beam:.4f} mm")
print(f"first frequency: {frequency:.3f} Hz of the body, {modes[0].frequency:.3f} Hz of the model, {measured:.3f} Hz in the run, beam theory {euler:.3f} Hz")
assert abs(part.invariants.m / (rho * A * L) - 1) < 1e-9
assert abs(deflection / beam - 1) < 0.01
assert abs(frequency / euler - 1) < 0.01
assert abs(modes[0].frequency / frequency - 1) < 1e-6
assert abs(measured / frequency - 1) < 0.01
