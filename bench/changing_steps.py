#!/usr/bin/env python3
"""What steps of changing size do to an undamped oscillator under generalised-alpha: the factor by which two steps, h and r h in turn, multiply
its motion, the largest over all frequencies. 1: it does not grow. The equations are (a) to (c) of src/floatframe/integrator/augmented_lagrangian.hpp.

Usage: python3 bench/changing_steps.py
"""
import numpy as np

RATIOS, RADII = (1 / 2, 1 / 3, 1 / 5, 1 / 10, 1 / 20), (1.0, 0.8, 0.6, 0.4, 0.0)
FREQUENCIES = np.logspace(-2, 4, 300)  # times the longer step


def step(radius, h, omega):
    """Of (x, v, a_alg, a), with a = -omega^2 x at the end of the step."""
    trapezoidal = radius >= 1
    am = 0 if trapezoidal else (2 * radius - 1) / (radius + 1)
    af = 0 if trapezoidal else radius / (radius + 1)
    gamma = 0.5 + af - am
    beta = 0.25 * (gamma + 0.5) ** 2
    x, v, a_alg, a = np.eye(4)
    base = 1 / (beta * h * h)
    known = -base * (x + h * v + h * h * (0.5 - beta) * a_alg)
    end = (af * a - am * a_alg - (1 - am) * known) / ((1 - am) * base + (1 - af) * omega**2)
    a_alg_end = base * end + known
    return np.array([end, v + h * ((1 - gamma) * a_alg + gamma * a_alg_end), a_alg_end, -(omega**2) * end])


def growth(radius, ratio, omega):
    scale = np.diag([1, 1 / omega, 1 / omega**2, 1 / omega**2])
    pair = step(radius, ratio, omega) @ step(radius, 1.0, omega)
    return np.abs(np.linalg.eigvals(np.linalg.inv(scale) @ pair @ scale)).max()


def main():
    print("spectral_radius" + "".join(f"{f'r = 1/{round(1 / r)}':>10}" for r in RATIOS))
    for radius in RADII:
        print(f"{radius:15}" + "".join(f"{max(growth(radius, r, w) for w in FREQUENCIES):10.2f}" for r in RATIOS))


if __name__ == "__main__":
    main()
