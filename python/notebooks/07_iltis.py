# %% [markdown]
# # The Iltis and Table 1
#
# The vehicle of the paper: twelve flexible suspension parts, 8 s over ramp, plateau and stairs at steps of 10 ms. It compares two sets
# of coordinates (absolute, relative) and two ways to the inertia terms (projection over the nodes, preprocessing to integrals). The
# motion must not depend on the choice, the time does: projection grows with the mesh, preprocessing does not.

# %%
import itertools
import os

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
duration = 1.0 if short else 8.0
meshes = (5, 10) if short else (5, 10, 50, 100)
# Table 1 of the paper: processor seconds of the manoeuvre by elements per bar (5, 10, 50, 100).
paper = {
    ("absolute", "projection"): (4.19, 4.48, 7.58, 12.59),
    ("absolute", "preprocessing"): (3.85,) * 4,
    ("relative", "projection"): (1.11, 1.48, 4.32, 8.21),
    ("relative", "preprocessing"): (0.79,) * 4,
}
ways = list(itertools.product(("absolute", "relative"), ("projection", "preprocessing")))

# %%
heights, seconds = {}, {way: [] for way in ways}
for ne in meshes:
    model = ff.Model.load(ff.example("iltis"), ne=ne)
    for coordinates, inertia in ways:
        res = ff.run(model, step=0.01, duration=duration, coordinates=coordinates, inertia=inertia)
        assert res.summary["status"] == "completed", res.summary["message"]
        seconds[coordinates, inertia].append(res.summary["cpu_s"])
        heights[coordinates, inertia, ne] = res["chassis.z"]
time = res.time

# %%
fig, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.6), layout="constrained")
for coordinates, line in (("absolute", "-"), ("relative", "--")):
    left.plot(time, heights[coordinates, "preprocessing", meshes[-1]], line, label=coordinates)
left.set(xlabel="time [s]", ylabel="height of the chassis [m]")
left.legend()
for way, colour in zip(ways, ("C0", "C1", "C2", "C3")):
    right.plot(meshes, np.array(seconds[way]) * 8.0 / duration, "o-", color=colour, label=" + ".join(way))
    right.plot((5, 10, 50, 100), paper[way], ":", color=colour)
right.set(xlabel="elements of a bar", ylabel="processor time of 8 s [s]", yscale="log", title="dotted: the paper, whose machine is not stated")
fig.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize="small")
plt.show()

# %% [markdown]
# Both inertia methods solve the same equations; so do both formulations, to the error of the steps. On the stairs, whose edges fall
# into the middle of steps, that of 10 ms is large: the formulations are compared up to there.

# %%
before = time <= 4.0
ne = meshes[-1]
methods = max(
    np.abs(heights[c, "projection", n] - heights[c, "preprocessing", n])[before].max() for c in ("absolute", "relative") for n in meshes
)
formulations = np.abs(heights["absolute", "preprocessing", ne] - heights["relative", "preprocessing", ne])[before].max()
print("processor time [s]                " + "".join(f"{f'ne = {n}':>10}" for n in meshes))
for way in ways:
    print(f"{' + '.join(way):34}" + "".join(f"{s:10.4f}" for s in seconds[way]))
print(f"height of the chassis up to 4 s: inertia methods differ by {1e3 * methods:.1e} mm, formulations by {1e3 * formulations:.4f} mm")
assert methods < 1e-6
assert formulations < 1e-4
