#!/usr/bin/env python3
"""The small car of the examples against formulas by hand, those of its README. Set FLOATFRAME_BINARY."""
import cmath
import json
import os
import pathlib
import subprocess
import unittest
from math import acos, degrees, hypot, radians

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
CAR = pathlib.Path(__file__).resolve().parents[2] / "examples" / "small_car" / "small_car.yaml"
G = 9.81
# (mass, x) of chassis, rack, and both front and rear corners: arm, strut, knuckle, rim; arm, rim.
MASSES = ((860, 0), (2, 0.87), (2 * 36, 1.0), (2 * 16, -1.3), (2 * 16, -1.4))
BASE, FRONT, REAR, TRAIL = 2.4, 1.0, -1.4, 0.02
TYRE, RADIUS = 1.8e5, 0.28
MASS = sum(m for m, _ in MASSES)
REAR_MASS = sum(m * (FRONT - x) for m, x in MASSES) / BASE
FRONT_MASS = MASS - REAR_MASS


def program(*arguments):
    done = subprocess.run([BINARY, *map(str, arguments), "--json"], capture_output=True, text=True, timeout=280, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


def strut(angle):
    """Height of the wheel centre and length of the spring over the angle of the arm: the arm is a circle, and the line of the
    strut, fixed in the knuckle, passes through its top. Points of the front view are y + i z."""
    hinge, ball, top, low, wheel = 0.35 + 0.2j, 0.66 + 0.2j, 0.56 + 0.8j, 0.63 + 0.35j, 0.72 + 0.28j
    along = (top - low) / abs(top - low)
    across = along / 1j
    offset = ((low - ball) * across.conjugate()).real
    now = hinge + (ball - hinge) * cmath.exp(1j * angle)
    turned = cmath.phase(top - now) - acos(offset / abs(top - now)) - cmath.phase(across)
    turn = cmath.exp(1j * turned)
    return (now + (wheel - ball) * turn).imag, abs(now + (low - ball) * turn - top)


def front_wheel_rate():
    """d/dz of the spring's force at the wheel, F dl/dz."""
    h = 1e-4

    def force(angle):
        (z1, l1), (_, l), (z2, l2) = strut(angle - h), strut(angle), strut(angle + h)
        return (-2590 + 22000 * (l - hypot(0.07, 0.45))) * (l2 - l1) / (z2 - z1)
    return (force(h) - force(-h)) / (strut(h)[0] - strut(-h)[0])


def rear_wheel_rate():
    return 26000 * (0.3 / 0.35)**2


def roll_per_g():
    """Both axles in series with their tyres, all masses about the axis through the roll centres [deg]."""
    h = 1e-4
    arm = h / (strut(h)[0] - strut(0)[0])                       # angle of the arm over the travel [1/m]
    front = front_wheel_rate() * 1.44**2 / 2 + 800 * (1.44 * arm)**2
    rear = rear_wheel_rate() * 1.42**2 / 2 + 500 * (1.42 / 0.35)**2
    stiffness = sum(1 / (1 / c + 1 / (TYRE * t * t / 2)) for c, t in ((front, 1.44), (rear, 1.42)))
    pole = 0.56 - 0.6 * 0.45 / 0.07                             # y of the instant centre of the knuckle, at z = 0.2
    centre = 0.72 * 0.2 / (0.72 - pole)                         # roll centre of the front axle; that of trailing arms is on the road
    at = centre * 1.4 / BASE                                    # roll axis below the centre of mass
    # Wheels and arms lean with the body, or less by the camber of the strut, about their contacts.
    lean = 1 - 0.72 / (0.72 - pole)
    moment = G * (862 * (0.55 - at) + 2 * 32 * 0.28 + 2 * 30 * 0.28 * lean + 2 * 4 * 0.2 + 2 * 2 * 0.8)
    gyroscopic = G * (2 * 0.95 + 2 * 1.0 * lean) / RADIUS       # of wheels that turn while the car yaws: sum J/R per acceleration
    return degrees((moment + gyroscopic) / (stiffness - moment))


def understeer():
    """Of tyres with a constant cornering stiffness: F_f/C_f - F_r/C_r per acceleration, with the trail t that moves the forces
    to the rear, and the rack that yields to F_f t [deg s2/m]."""
    front = (FRONT_MASS * BASE + MASS * TRAIL) / BASE
    rear = MASS - front
    return degrees(front / 9.0e4 - rear / 1.0e5 + front * TRAIL / (0.13**2 * 2e7))


def stopping_distance(speed, torque):
    """Until the torque is there (0.2 s by 10 s^3 - 15 s^4 + 6 s^5: half of it on average), then evenly; the wheels turn with the car. Rolling resistance
    0.012."""
    inertia = MASS + (2 * 1.0 + 2 * 0.95) / RADIUS**2
    brake, rolling = torque / RADIUS / inertia, 0.012 * MASS * G / inertia
    ramp = 0.2
    v1 = speed - (0.5 * brake + rolling) * ramp
    return speed * ramp - (brake / 7 + rolling / 2) * ramp**2 + v1**2 / (2 * (brake + rolling))


class SmallCar(unittest.TestCase):
    def test_static_loads(self):
        for tyre in "linear", "tmeasy", "mf":
            forces = {f["name"]: f for f in program("statics", CAR, "--set", f"tyre={tyre}")["forces"]}
            for axle, mass in ("front", FRONT_MASS), ("rear", REAR_MASS):
                for side in "left", "right":
                    self.assertAlmostEqual(forces[f"{axle}_{side}.{tyre}"]["force"], mass * G / 2, delta=2)
        self.assertAlmostEqual(FRONT_MASS * G / 2, 2830, delta=1)
        self.assertAlmostEqual(REAR_MASS * G / 2, 2066, delta=1)

    def test_wheel_rates(self):
        found = program("vehicle", CAR, "--rig", "k-and-c", "--travel", "0.02")
        middle = min(found["travel"], key=lambda point: abs(point["travel_m"]))
        for axle, rate in ("front", front_wheel_rate()), ("rear", rear_wheel_rate()):
            self.assertAlmostEqual(middle[axle]["left"]["rate_N_m"], rate, delta=0.005 * rate)
            for point in found["travel"]:  # the track rod is parallel to the arm
                self.assertAlmostEqual(point[axle]["left"]["toe_deg"], 0, delta=1e-6)
        # Bars act in roll alone.
        rolled = min(found["roll"], key=lambda point: abs(point["travel_m"]))
        for axle in "front", "rear":
            self.assertGreater(rolled[axle]["left"]["rate_N_m"], 1.3 * middle[axle]["left"]["rate_N_m"])

    def test_steady_circle(self):
        found = program("vehicle", CAR, "--manoeuvre", "steady-circle", "--speed", "40km/h")["points"][0]
        self.assertAlmostEqual(found["understeer_gradient_deg_s2_m"], understeer(), delta=0.04 * understeer())
        self.assertAlmostEqual(G * found["roll_gradient_deg_s2_m"], roll_per_g(), delta=0.02 * roll_per_g())

    def test_stop(self):
        found = program("vehicle", CAR, "--manoeuvre", "straight-stop", "--speed", "72km/h", "--torque", "1500")
        by_hand = stopping_distance(20, 1500)
        self.assertAlmostEqual(found["distance_m"], by_hand, delta=0.02 * by_hand)


if __name__ == "__main__":
    unittest.main(verbosity=2)
