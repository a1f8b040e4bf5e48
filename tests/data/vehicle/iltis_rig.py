#!/usr/bin/env python3
"""Writes iltis_rig.csv: the front left wheel of the Iltis over its height and the rack, by the lengths of its links alone.

Chassis at rest, x forward, y left, z up, origin at the centre of mass of the chassis; the hardpoints are those of
examples/iltis/suspension.yaml. Arm and upper link turn about axes along x, and their balls P and Q stay in the plane of the
wheel centre. So for an angle of the arm Q is where two circles meet: about the hinge of the link with its length, about P
with the distance of the balls on the stub axle. The stub axle follows the line P Q and turns about it by the angle q at
which the track rod has its length. The angle of the arm is that at which the wheel centre has the height asked for.

Columns [m, rad]: rack (its displacement, to the left), height, x, y (of the wheel centre, from the design configuration),
steer (positive: to the left), camber (positive: top outwards), contact (y of the lowest point of a wheel of the radius 0.356 m).
"""
from math import asin, atan2, cos, hypot, sin, sqrt
from pathlib import Path

ARM, BALL = (0.970, 0.259, -0.268), (0.970, 0.572, -0.341)
LINK, LINK_BALL = (0.970, 0.1585, 0.030), (0.970, 0.488, -0.039)
ROD, ROD_BALL = (0.830, 0.070, 0.030), (0.830, 0.448, -0.039)
CENTRE, RADIUS = (0.970, 0.615, -0.214), 0.356


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return sqrt(dot(a, a))


def about_x(v, c, s):
    return (v[0], c * v[1] - s * v[2], s * v[1] + c * v[2])


def about_line(v, u, c, s):
    """Rodrigues: v turned about the unit vector u."""
    w, along = cross(u, v), dot(u, v)
    return tuple(c * x + s * y + (1.0 - c) * along * z for x, y, z in zip(v, w, u))


def wheel(arm_angle, rack):
    """Wheel centre and the unit vector of its axis, to the left."""
    arm = about_x(minus(BALL, ARM), cos(arm_angle), sin(arm_angle))
    P = tuple(a + b for a, b in zip(ARM, arm))
    # Two circles in the plane x = 0.970; of both points the outer one.
    dy, dz = P[1] - LINK[1], P[2] - LINK[2]
    d = hypot(dy, dz)
    r1, r2 = length(minus(LINK_BALL, LINK)), length(minus(LINK_BALL, BALL))
    along = (d * d + r1 * r1 - r2 * r2) / (2.0 * d)
    across = sqrt(r1 * r1 - along * along)
    Q = (0.970, LINK[1] + (along * dy - across * dz) / d, LINK[2] + (along * dz + across * dy) / d)
    u0, u = minus(LINK_BALL, BALL), minus(Q, P)
    turn = atan2(u[2], u[1]) - atan2(u0[2], u0[1])
    c, s = cos(turn), sin(turn)
    axis = tuple(x / r2 for x in u)
    # |P + R(q) b - inner|^2 = rod^2, linear in cos q and sin q.
    b = about_x(minus(ROD_BALL, BALL), c, s)
    inner = minus((ROD[0], ROD[1] + rack, ROD[2]), P)
    rod = length(minus(ROD_BALL, ROD))
    along = dot(b, axis)
    A = dot(inner, b) - along * dot(inner, axis)
    B = dot(inner, cross(axis, b))
    C = 0.5 * (dot(b, b) + dot(inner, inner) - rod * rod) - along * dot(inner, axis)
    # Of the two angles the small one.
    middle, half = atan2(B, A), atan2(sqrt(A * A + B * B - C * C), C)
    q = min((middle - half, middle + half), key=abs)
    place = lambda v: about_line(about_x(v, c, s), axis, cos(q), sin(q))
    return tuple(p + v for p, v in zip(P, place(minus(CENTRE, BALL)))), place((0.0, 1.0, 0.0))


def at_height(height, rack):
    """By the rule of the secant, which ends at rounding."""
    a, b = -0.01 + 3.0 * height, 0.01 + 3.0 * height
    rest = lambda angle: wheel(angle, rack)[0][2] - CENTRE[2] - height
    fa, fb = rest(a), rest(b)
    for _ in range(60):
        if fb == fa or abs(fb) < 1e-16:
            break
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        fb = rest(b)
    assert abs(fb) < 1e-14
    return wheel(b, rack)


def row(height, rack):
    c, n = at_height(height, rack)
    up = (-n[2] * n[0], -n[2] * n[1], 1.0 - n[2] * n[2])
    contact = c[1] - RADIUS * up[1] / length(up)
    return [rack, height, c[0] - CENTRE[0], c[1] - CENTRE[1], atan2(-n[0], n[1]), -asin(n[2]), contact]


if __name__ == "__main__":
    lines = ["rack,height,x,y,steer,camber,contact"]
    for rack in (-0.03, -0.01, 0.0, 0.01, 0.03):
        for k in range(-6, 7, 2):
            lines.append(",".join(f"{x + 0.0:.14g}" for x in row(0.01 * k, rack)))
    Path(__file__).with_name("iltis_rig.csv").write_text("\n".join(lines) + "\n")
