#!/usr/bin/env python3
"""Midspan of a simply supported beam below a force at constant speed: the series of Fryba, Vibration of Solids and Structures under
Moving Loads, chapter 1, for a beam at rest when the force enters. Writes reference.csv."""
import math

LENGTH, SPEED, FORCE = 2.0, 10.0, 10.0
EI, MASS = 2.1e11 * 0.05 * 0.02**3 / 12.0, 7850.0 * 0.02 * 0.05
FIRST = (math.pi / LENGTH) ** 2 * math.sqrt(EI / MASS)


def midspan(t):
    w = 0.0
    for n in range(1, 2000, 2):
        k = n * math.pi / LENGTH
        omega, drive = k * k * math.sqrt(EI / MASS), k * SPEED
        w += math.sin(n * math.pi / 2) * (math.sin(drive * t) - drive / omega * math.sin(omega * t)) / (omega**2 - drive**2)
    return 2.0 * FORCE / (MASS * LENGTH) * w


with open("reference.csv", "w", encoding="utf-8") as out:
    out.write("t,z,travel\n")
    for row in range(24):
        t = row * 20 * 2.0 * math.pi / FIRST / 200
        out.write(f"{t:.15g},{-midspan(t):.12g},{SPEED * t:.15g}\n")
