# %% [markdown]
# # Inertia terms of one's own
#
# In absolute coordinates q = (r₀, u, v, w, y) a point of a flexible body is r = r₀ + A (r_u + X y) with A = [u v w], so its velocity is
# ṙ = B q̇, and M = ∫ Bᵀ B dm. Projection takes the sum over the nodes with the mass matrix of the elements; preprocessing takes 16
# integrals that were made once, and no longer sees the mesh. Qv = -∫ Bᵀ (dB/dt) q̇ dm is what velocities do. Here both are written in numpy
# and compared with the library.

# %%
import os
import timeit

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np


def box(n, size):
    """Points and hexahedra of a block."""
    axes = [np.linspace(0.0, s, k + 1) for s, k in zip(size, n)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    index = np.arange(len(points)).reshape([k + 1 for k in n])
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return points, np.stack([index[i : i + n[0], j : j + n[1], k : k + n[2]].ravel() for i, j, k in corners], axis=1)


def reduced(elements):
    points, cells = box((elements, 2, 2), (0.6, 0.05, 0.05))
    options = {"interfaces": {"A": ff.plane([0, 0, 0], "x"), "B": ff.plane([0.6, 0, 0], "x")}, "modes": 4, "free_check": False}
    return ff.reduce(ff.Mesh(points, [("hex8i", cells)]), material=ff.Material(2.1e11, 0.3, 7850.0), projection=True, **options)


# %% [markdown]
# Preprocessing: M and Qv by the formulas of docs/theory.md, section 5, letter for letter. Then projection.


# %%
def preprocessing(v, A, y, omega, ydot):
    M, AS, I = np.zeros((12 + len(y), 12 + len(y))), A @ v.S, np.eye(3)
    m = v.m_u + v.S @ y
    Sd = [np.array([v.Si[i][j] + y @ v.Sij[i][j] for j in range(3)]) for i in range(3)]
    M[:3, :3], M[:3, 12:] = v.m * I, AS
    for i in range(3):
        rows = slice(3 + 3 * i, 6 + 3 * i)
        M[:3, rows], M[rows, 12:] = m[i] * I, A @ Sd[i]
        for j in range(3):
            M[rows, 3 + 3 * j : 6 + 3 * j] = (v.P_u[i, j] + v.Si[j][i] @ y + Sd[i][j] @ y) * I
    M[12:, 12:] = sum((A.T @ A)[i, j] * v.Sij[i][j] for i in range(3) for j in range(3))
    dA = np.cross(omega, A.T).T  # dA/dt
    q_f = sum((A.T @ dA)[i, j] * v.Sij[i][j] @ ydot for i in range(3) for j in range(3))
    Qv = -2 * np.concatenate([dA @ v.S @ ydot, *(dA @ Sd[i] @ ydot for i in range(3)), q_f])
    return np.triu(M) + np.triu(M, 1).T, Qv


def projection(p, A, y, omega, ydot):
    """Bᵀ M_s B and -Bᵀ M_s (dB/dt) q̇ with B of every node, M_s the mass matrix of the elements."""
    places = p.p + p.X @ y  # in the body
    n = len(places)
    B = np.zeros((n, 3, 12 + len(y)))
    B[:, :, :3] = np.eye(3)
    for i in range(3):
        B[:, :, 3 + 3 * i : 6 + 3 * i] = places[:, i, None, None] * np.eye(3)
    B[:, :, 12:] = A @ p.X
    values, columns, starts = p.mass_rows
    MB = np.zeros_like(B)
    np.add.at(MB, np.repeat(np.arange(n), np.diff(starts)), values[:, None, None] * B[columns])
    Qv = -2 * np.tensordot(MB, p.X @ ydot @ np.cross(omega, A.T), axes=([0, 1], [0, 1]))
    return np.tensordot(B, MB, axes=([0, 1], [0, 1])), Qv


random = np.random.default_rng(1)
sizes = [4, 8] if os.environ.get("FLOATFRAME_SHORT") == "1" else [4, 8, 16, 32, 64]
times, worst = {"preprocessing": [], "projection": []}, 0.0
for elements in sizes:
    body = reduced(elements).body
    A, _ = np.linalg.qr(random.normal(size=(3, 3)))
    A *= np.linalg.det(A)
    y, ydot, omega = 1e-3 * random.normal(size=body.modes), random.normal(size=body.modes), random.normal(size=3)
    own = {
        "preprocessing": lambda: preprocessing(body.invariants, A, y, omega, ydot),
        "projection": lambda: projection(body.projection, A, y, omega, ydot),
    }
    for method in times:
        times[method].append(min(timeit.repeat(own[method], number=1, repeat=7)))
        M, Qv = body.inertia(A, y, omega, ydot, method=method, coordinates="absolute")
        worst = max(worst, *(np.abs(a - b).max() / np.abs(b).max() for a, b in zip(own[method](), (M, Qv))))

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
fig.colorbar(left.imshow(np.log10(np.abs(M) + 1e-12), cmap="viridis"), ax=left)
left.set(title="log₁₀ |M|: r₀, u, v, w, modes", xticks=[0, 3, 6, 9, 12], yticks=[0, 3, 6, 9, 12])
for method, seconds in times.items():
    right.semilogy([9 * (n + 1) for n in sizes], 1e3 * np.array(seconds), "o-", label=method)
    print(f"{method:14}" + "".join(f"{1e3 * s:9.3f} ms" for s in seconds))
right.set(xlabel="nodes", ylabel="time of M and Qv in numpy [ms]", xlim=0)
right.legend()
plt.show()
print(f"own M and Qv against the library, both methods, {len(sizes)} meshes: {worst:.1e} of the largest entries")
assert worst < 1e-12
