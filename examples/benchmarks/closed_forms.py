#!/usr/bin/env python3
"""Closed forms of the benchmarks of couplings, constraints and friction: writes the reference.csv and events.csv of each folder.

  python3 examples/benchmarks/closed_forms.py            writes them
  python3 examples/benchmarks/closed_forms.py --check    compares them with the files instead

Symbols are the parameters of the model files. Nothing here comes from a run.
"""
import math
import pathlib
import sys
from math import atan, atan2, cos, floor, pi, sin, sqrt, tan

HERE = pathlib.Path(__file__).resolve().parent
g = 9.81


def grid(step, end):
    return [k * step for k in range(round(end / step) + 1)]


def root(f, low, high):
    """Bisection: the sign of f changes between low and high."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (f(middle) > 0) == (f(low) > 0) else (low, middle)
    return 0.5 * (low + high)


def gear_train():
    """Ja w2' = -i T + k s, Jl w3' = -k s with the twist s = q3 - q2 and Ja = i^2 J1 + J2; w1 = -i w2."""
    J1, J2, Jl, k, T, i = 0.002, 0.01, 0.4, 900, 3, 2.5
    Ja = i * i * J1 + J2
    w = sqrt(k * (1 / Ja + 1 / Jl))
    yield ["twist", "motor", "load", "mesh", "housing"]
    for t in grid(0.05, 0.2):
        twist = i * T / (Ja * w * w) * (1 - cos(w * t))
        load = -k * i * T / (Ja * Jl * w * w) * (t - sin(w * t) / w)
        wheel = (-i * T * t - Jl * load) / Ja
        mesh = J1 * i * (i * T - k * twist) / Ja - T
        yield [t, twist, -i * wheel, load, mesh, i * mesh]


def planetary_gear():
    """Willis: z_s (w_s - w_c) + z_r (w_r - w_c) = 0, b = z_r/z_s. T on the sun, -L on the carrier, the ring driven."""
    Js, Jr, Jc, T, L, b = 0.001, 0.02, 0.3, 2, 5, 72 / 24
    yield ["sun", "carrier", "torque", "ring"]
    sun = 0.0
    for t in grid(0.5, 2):
        ring, ring_rate = (12 * t, 12) if t < 1 else (12, 0)
        # J_s w_s' = T + f, J_c w_c' = -L - (1 + b) f, w_s' = (1 + b) w_c' - b w_r'
        f = (-T / Js - (1 + b) * L / Jc - b * ring_rate) / (1 / Js + (1 + b) ** 2 / Jc)
        rate = (T + f) / Js
        sun = rate * t if t < 1 else speed_at_1 + rate * (t - 1)
        if t < 1:
            speed_at_1 = rate
        yield [t, sun, (sun + b * ring) / (1 + b), f, Jr * ring_rate - b * f]


def differential():
    """A car axle in a turn. One freedom: the wheels turn (R -+ b/2)/r times as fast as the axle goes round, the cage R/r times."""
    R, b, r, m, Ja, Jw, Jc, T = 5, 1.5, 0.3, 200, 60, 1.2, 0.1, 240
    inner, outer, cage = -(R - b / 2) / r, -(R + b / 2) / r, -R / r  # turns per turn of the axle
    inertia = m * R * R + Ja + 20 * ((R - b / 2) ** 2 + (R + b / 2) ** 2) + 2 * 0.7 + 10 * R * R + 0.1
    inertia += Jw * (inner**2 + outer**2) + Jc * cage**2
    turn = T * cage / inertia
    shafts = 0.5 * (T - Jc * cage * turn)  # J_c w_c' = T - 2 f
    yield ["turn", "inner", "outer", "cage", "shafts", "road_inside"]
    for t in grid(0.5, 2):
        yield [t, turn * t, inner * turn * t, outer * turn * t, cage * turn * t, shafts, Jw * inner * turn - shafts]


def rack_and_pinion():
    m, J, r, a = 4, 0.005, 0.05, 30 * pi / 180
    rate = g * sin(a) / (1 + J / (m * r * r))
    yield ["rack", "pinion", "teeth"]
    for t in grid(0.25, 1):
        yield [t, 0.5 * rate * t * t, -0.5 * rate * t * t / r, m * (rate - g * sin(a))]


def screw_jack():
    """m z'' = -m g + f, J q'' = -p f, z = p q; friction of more than m g p holds the load."""
    m, J, p = 1000, 0.05, 0.006 / (2 * pi)
    rate = -m * g * p * p / (m * p * p + J)
    yield ["free", "turn", "thread", "held"]
    for t in grid(0.25, 1):
        yield [t, 0.5 * rate * t * t, 0.5 * rate * t * t / p, m * (rate + g), 0]


def belt_drive():
    """J1 q1'' = T - r1 F, J2 q2'' = r2 F, F = k s with s = r1 q1 - r2 q2."""
    r1, r2, J1, J2, k, T = 0.08, 0.05, 0.02, 0.004, 2.0e4, 5
    w = sqrt(k * (r1 * r1 / J1 + r2 * r2 / J2))
    yield ["engine", "fan", "strands"]
    for t in grid(0.05, 0.2):
        s = r1 * T / (J1 * w * w) * (1 - cos(w * t))
        twice = r1 * T / (J1 * w * w) * (0.5 * t * t - (1 - cos(w * t)) / (w * w))  # s, integrated twice
        yield [t, (0.5 * T * t * t - r1 * k * twice) / J1, r2 * k * twice / J2, -r1 * k * s]


RISES = {  # lift and its second derivative over a width of 1
    "cycloidal": (lambda u: u - sin(2 * pi * u) / (2 * pi), lambda u: 2 * pi * sin(2 * pi * u)),
    "harmonic": (lambda u: 0.5 * (1 - cos(pi * u)), lambda u: 0.5 * pi * pi * cos(pi * u)),
    "polynomial": (lambda u: u**3 * (10 - 15 * u + 6 * u * u), lambda u: 60 * u - 180 * u * u + 120 * u**3),
}


def lift(law, x, h):
    """Lift and its second derivative: up over pi/2, a dwell to 3 pi/4, down to 5 pi/4, a dwell."""
    s, ss = RISES[law]
    width, x = pi / 2, x % (2 * pi)
    if x < width:
        return h * s(x / width), h * ss(x / width) / width**2
    if 0.75 * pi < x < 1.25 * pi:
        u = (x - 0.75 * pi) / width
        return h * (1 - s(u)), -h * ss(u) / width**2
    return (h, 0.0) if x < pi else (0.0, 0.0)


def cam():
    """Followers of constant speed W: acceleration s''(x) W^2; the spring presses with preload + k s."""
    W, h, m, k, preload = 10 * pi, 0.01, 0.4, 3000, 60
    yield ["cycloidal", "harmonic", "polynomial", "lift", "force"]
    for j in (1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 18, 20, 22, 24, 30, 38):  # not where accelerations jump
        t = 0.005 * j
        rates = [lift(law, W * t, h)[1] * W * W for law in RISES]
        s = lift("cycloidal", W * t, h)[0]
        yield [t, *rates, lift("polynomial", W * t, h)[0], m * rates[0] + k * s + preload]


def cam_lift_off():
    """F = m (s'' W^2 + s' alpha) + k s + preload with s = e (1 - cos x), x = alpha t^2/2, W = alpha t."""
    e, m, k, preload, alpha = 0.005, 0.3, 2000, 40, 40

    def force(t):
        x, W = 0.5 * alpha * t * t, alpha * t
        return m * e * (cos(x) * W * W + sin(x) * alpha) + k * e * (1 - cos(x)) + preload

    k_first = next(k for k in range(10**6) if force(1e-5 * k) < 0)
    off = root(force, 1e-5 * (k_first - 1), 1e-5 * k_first)
    yield ["force", "speed", "lift_off"]
    for t in grid(0.5, 6):
        yield [t, force(t), alpha * t, off if t > off else math.nan]


def incline():
    """Sticks if tan(a) < 0.4; slides with g (sin(a) - 0.3 cos(a)). Friction of the block at rest: m g sin(a),
    and its bristles bend by tan(a)/stiffness."""
    m, a = 5, 20 * pi / 180
    rate = g * (sin(a) - 0.3 * cos(a))
    yield ["rests", "slides", "speed", "holds"]
    for t in grid(2.5, 10)[1:]:
        yield [t, tan(a) / 2.0e5, 0.5 * rate * t * t, rate * t, m * g * sin(a)]


def stick_slip():
    """Static and kinetic friction F_s, F_k: it sticks for 2 d/v, d = (F_s - F_k)/k, and slips for 2 (pi - atan(d w/v))/w. The block
    comes to a halt for the first time at F_s/(k v) + atan(v/(w d))/w, and then once in each period."""
    m, k, v, static, kinetic = 1, 100, 0.05, 6, 4
    w, d = sqrt(k / m), (static - kinetic) / k
    period = 2 * d / v + 2 * (pi - atan(d * w / v)) / w
    first = static / (k * v) + atan(v / (w * d)) / w
    yield ["first", "later"]
    yield [5, first, first + 3 * period]


def bouncing_ball():
    yield ["a", "b", "c", "d"]
    yield [0.5, 0.3, 0.5, 0.7, 0.9]  # after the first impact at sqrt(2 h/g) = 0.4515 s, before the second one


def constant_velocity():
    """Both shafts turn by the same angle; J of the second one times its acceleration is the torque it takes."""
    yield ["angle", "speed", "motor"]
    for t in grid(0.05, 2):
        w = 4 * pi
        yield [t, 5 * t + 0.3 * sin(w * t), 5 + 0.3 * w * cos(w * t), -(0.01 + 0.02) * 0.3 * w * w * sin(w * t)]


def hookes_joint():
    """tan(q2) = tan(q1) cos(b), with the diameter of the first shaft across the plane of the shafts at the start."""
    b, W = 30 * pi / 180, 5
    yield ["angle", "speed"]
    for t in grid(0.05, 2):
        q = W * t
        turns = 2 * pi * floor((q + pi) / (2 * pi))
        yield [t, atan2(sin(q) * cos(b), cos(q)) + turns, W * cos(b) / (cos(q) ** 2 + (sin(q) * cos(b)) ** 2)]


def tautochrone():
    """On a cycloid the length of the arc from the bottom is s = 4 R sin(u/2) = sqrt(8 R z), and s'' = -g/(4 R) s."""
    R, w = 0.5, sqrt(g / (4 * 0.5))
    yield ["low", "middle", "high", "quarter"]
    for t in grid(0.05, 3):
        heights = [R * (1 - cos(u)) * cos(w * t) ** 2 for u in (0.6, 1.4, 2.2)]
        yield [t, *heights, pi / (2 * w) if t > pi / (2 * w) else math.nan]


CASES = [gear_train, planetary_gear, differential, rack_and_pinion, screw_jack, belt_drive, cam, cam_lift_off, incline, stick_slip,
         bouncing_ball, constant_velocity, hookes_joint, tautochrone]


def tables(case):
    """reference.csv; columns that have no value at some times go into events.csv, with the times at which all of them do."""
    names, *rows = case()
    late = [any(math.isnan(row[k + 1]) for row in rows) for k in range(len(names))]
    for file, chosen in (("reference.csv", False), ("events.csv", True)):
        columns = [k for k, is_late in enumerate(late) if is_late == chosen]
        lines = [",".join(["time", *(names[k] for k in columns)])]
        for row in rows:
            values = [row[0], *(row[k + 1] for k in columns)]
            if not any(math.isnan(x) for x in values):
                lines.append(",".join(f"{x + 0.0:.12g}" for x in values))
        if columns:
            yield HERE / case.__name__ / file, "\n".join(lines) + "\n"


def numbers(text):
    return [[float(x) for x in line.split(",")] for line in text.splitlines()[1:]]


def main():
    for file, text in (one for case in CASES for one in tables(case)):
        if "--check" not in sys.argv[1:]:
            file.write_text(text, encoding="utf-8")
            continue
        for kept, made in zip(numbers(file.read_text(encoding="utf-8")), numbers(text), strict=True):
            if any(abs(a - b) > 1e-10 * max(1.0, abs(b)) for a, b in zip(kept, made, strict=True)):
                sys.exit(f"{file}: the closed form gives {made}, found {kept}")


if __name__ == "__main__":
    main()
