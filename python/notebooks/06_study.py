# %% [markdown]
# # A parameter study
#
# How strong should the damper of a car be? A quarter car - body, wheel, strut, tyre - drives over a random road of class C. Weak
# dampers let it swing, strong ones pass on the road: the effective acceleration of the body has a minimum. The system is linear as long as the
# tyre touches (with weak dampers it leaves the road at times), so theory has the answer as well: a_eff² = ∫ |H(f)|² S(f) df with the frequency
# response H of two masses and the spectrum S(f) = G₀ n₀² v / f² of the road.

# %%
import os

import floatframe as ff
import matplotlib.pyplot as plt
import numpy as np

short = os.environ.get("FLOATFRAME_SHORT") == "1"
m, mw, k, kt, ct, v = 300.0, 40.0, 2e4, 2e5, 100.0, 20.0
dampings = np.array([500.0, 1500.0, 3500.0]) if short else np.array([300.0, 500, 750, 1000, 1250, 1500, 2000, 2500, 3500, 5000])
model = ff.Model.load(ff.example("quarter_car"), duration=30 if short else 105)
table = ff.sweep(model, damping=dampings, speed=[v], measure=["body.az:rms", "tyre:min"], processes=2)
table = table[["damping", "status", "body.az rms [m/s2]", "tyre min [N]"]]

# %% [markdown]
# The same by theory: (-ω² M + i ω C + K) z = (kt + i ω ct) (0, 1)ᵀ for a road of unit height, a = -ω² z₁. The road holds wavelengths between
# 0.35 and 91 m.


# %%
def effective(c, G0=256e-6, n0=0.1):
    f = np.linspace(0.011 * v, 2.83 * v, 20000)
    w = 2 * np.pi * f
    strut, tyre = k + 1j * w * c, kt + 1j * w * ct
    det = (strut - w**2 * m) * (strut + tyre - w**2 * mw) - strut**2
    response = w**2 * strut * tyre / det
    return np.sqrt(np.trapezoid(np.abs(response) ** 2 * G0 * n0**2 * v / f**2, f))


theory = np.array([effective(c) for c in dampings])
simulated = table["body.az rms [m/s2]"].to_numpy()
fine = np.geomspace(dampings[0], dampings[-1], 200)
curve = np.array([effective(c) for c in fine])
fig, ax = plt.subplots(figsize=(6.5, 3.4), layout="constrained")
ax.plot(fine, curve, label="theory, all roads of class C")
ax.plot(dampings, simulated, "o", label=f"{len(table)} runs on one of them")
ax.set(xlabel="damping of the strut [N s/m]", ylabel="effective acceleration of the body [m/s²]", xscale="log")
ax.legend()
plt.show()

best = fine[np.argmin(curve)]
print(table.to_string(index=False))
print(f"best damping by theory: {best:.0f} N s/m with {curve.min():.3f} m/s2; runs: {dampings[np.argmin(simulated)]:.0f} N s/m")
print(f"runs differ from theory by at most {100 * np.abs(simulated / theory - 1).max():.1f} %")
assert np.abs(simulated / theory - 1).max() < (0.08 if short else 0.04)
assert 0.5 < dampings[np.argmin(simulated)] / best < 2
