#!/usr/bin/env python3
"""Accelerations and multipliers of a slider crank in space for tests/tests/holonomic/spatial_slider_crank.rs: a crank
that turns about an axis along the slide, beside it and above it, and a rod from its pin to the slide. (Haug, Computer
Aided Kinematics and Dynamics of Mechanical Systems, 1989, has such a mechanism; the bodies here have weights of their
own.) `Machine` of machines.py has Newton and Euler for each body along partial velocities that are differences at 200
digits.

Usage: python3 spatial_slider_crank.py
"""
import mpmath
from mpmath import mpf

from machines import Machine, along, diagonal, rx, ry, rz, vec, FINE

P = {k: mpf(x) for k, x in dict(y0="0.1", z0="0.12", r="0.08", rod="0.3", J="0.0001", ms="2.0", mr="0.5", I1="0.0001",
                                I2="0.004", g="9.81").items()}
slide = lambda q: vec(q["s"], 0, 0)
attitude = lambda q: rz(q["a"]) * ry(q["b"])
axis = lambda q: attitude(q) * vec(-1, 0, 0)
middle = lambda q: slide(q) + P["rod"] / 2 * axis(q)
pin = lambda q: vec(0, P["y0"] + P["r"] * mpmath.cos(q["theta"]), P["z0"] + P["r"] * mpmath.sin(q["theta"]))
opening = lambda q: slide(q) + P["rod"] * axis(q) - pin(q)


def bodies(q):
    return [
        (mpf(0), diagonal(P["J"], 0, 0), vec(0, 0, 0), rx(q["theta"])),
        (P["ms"], None, slide(q), None),
        (P["mr"], diagonal(P["I1"], P["I2"], P["I2"]), middle(q), attitude(q)),
    ]


NAMES = ["theta", "s", "a", "b"]
machine = Machine("spatial slider crank", "", NAMES, {}, bodies, lambda q, v, rate: list(rate(opening)),
                  lambda q: P["mr"] * P["g"] * middle(q)[2])


def closed(theta):
    """The rod reaches from the slide to the pin."""
    y, z = pin({"theta": theta})[1:]
    s = mpmath.sqrt(P["rod"] ** 2 - y**2 - z**2)
    b = mpmath.asin(z / P["rod"])
    return [theta, s, mpmath.asin(-y / P["rod"] / mpmath.cos(b)), b]


def show(name, numbers):
    print(name, "[" + ", ".join(mpmath.nstr(x, 20) for x in numbers) + "]")


theta, rate = mpf("0.7"), mpf(6)
q = closed(theta)
named = dict(zip(NAMES, q))
assert max(abs(x) for x in opening(named)) < mpf(10) ** -150
v = [rate * x for x in along(lambda t: mpmath.matrix(closed(t[0])), [theta], [mpf(1)], FINE)]
a, multipliers = machine.accelerations(q, v)
show("positions", q)
show("rates", v)
show("accelerations", a)
show("multipliers", multipliers)
show("energy", [machine.energy(q, v)])
