"""One flexible link of the race, integrated independently of all programs.

Lagrange's equations of a body that rotates about its clamped end, with the full mass matrix of the mesh: angle a and the
amplitudes q of the eight modes of models.py, by an explicit method of order eight with step control (scipy). With u = x + Phi q
in the body frame and S the rotation by 90 degrees in the plane,
  T = (u' S' M S u w^2 + 2 w q.' Phi' M S u + q.' Phi' M Phi q.) / 2,   w the rate of a.
"""
import numpy as np
from scipy.integrate import solve_ivp

import models


def tip(modes, mass, stiffness, times):
    """Rows (time, x, y) of the tip, gravity along -y; modes: displacements of all nodes, one column per mode."""
    positions, _ = models.link_mesh()
    x, n, k = positions.ravel(), len(positions), modes.shape[1]

    def turned(v):
        u = v.reshape(n, 3, -1)
        return np.stack([-u[:, 1], u[:, 0], 0 * u[:, 0]], axis=1).reshape(v.shape)

    sx, smodes = turned(x), turned(modes)
    m, c = modes.T @ mass @ modes, modes.T @ stiffness @ modes
    i0, i1, i2 = sx @ (mass @ sx), smodes.T @ (mass @ sx), smodes.T @ (mass @ smodes)
    h0, h1 = modes.T @ (mass @ sx), modes.T @ (mass @ smodes)
    unit = [np.tile(e, n) for e in np.eye(3)[:2]]
    s0, s1 = [e @ (mass @ x) for e in unit], [modes.T @ (mass @ e) for e in unit]

    def rates(_, y):
        q, w, v = y[1:k + 1], y[k + 1], y[k + 2:]
        cos, sin = np.cos(y[0]), np.sin(y[0])
        sx_, sy_ = s0[0] + s1[0] @ q, s0[1] + s1[1] @ q
        inertia_slope = 2 * (i1 + i2 @ q)
        full, force = np.empty((k + 1, k + 1)), np.empty(k + 1)
        full[0, 0] = i0 + 2 * i1 @ q + q @ i2 @ q
        full[0, 1:] = full[1:, 0] = h0 + h1 @ q
        full[1:, 1:] = m
        force[0] = -models.GRAVITY * (cos * sx_ - sin * sy_) - inertia_slope @ v * w - v @ h1 @ v
        force[1:] = (-models.GRAVITY * (sin * s1[0] + cos * s1[1]) - w * (h1 - h1.T) @ v
                     + 0.5 * w * w * inertia_slope - c @ q)
        return np.concatenate([[w], v, np.linalg.solve(full, force)])

    y = solve_ivp(rates, (0, times[-1]), np.zeros(2 * k + 2), method="DOP853", t_eval=times, rtol=1e-8, atol=1e-11).y
    end = modes.reshape(n, 3, k)[models.faces(positions)[1]].mean(axis=0) @ y[1:k + 1]
    px, py, cos, sin = models.LENGTH + end[0], end[1], np.cos(y[0]), np.sin(y[0])
    return np.stack([times, cos * px - sin * py, sin * px + cos * py], axis=1)
