#!/usr/bin/env python3
"""Accelerations, multipliers and holding forces of a platform on six legs for tests/tests/holonomic/stewart.rs.

Twice, in different coordinates of the legs: their lengths beside the platform's place and angles, with one multiplier for
each length; and two angles and a length for each leg, whose end three multipliers hold at the platform, and whose tube
and rod are bodies that turn. `Machine` of machines.py has Newton and Euler for each body along partial velocities that
are differences at 200 digits: no Lagrangian and no elimination of constraints occurs. That the two agree is asserted.

Usage: python3 stewart.py
"""
import mpmath
from mpmath import mpf

from machines import FINE, Machine, along, cross, diagonal, dot, rx, ry, rz, vec

FEET = [("0.98", "-0.17", "0.0"), ("0.97", "0.19", "0.02"), ("-0.34", "0.94", "0.0"), ("-0.65", "0.77", "-0.01"),
        ("-0.64", "-0.78", "0.03"), ("-0.33", "-0.95", "0.0")]
JOINTS = [("0.32", "-0.38", "-0.05"), ("0.33", "0.37", "-0.04"), ("0.16", "0.47", "-0.05"), ("-0.49", "0.08", "-0.06"),
          ("-0.48", "-0.1", "-0.05"), ("0.17", "-0.46", "-0.03")]
P = {k: mpf(x) for k, x in dict(M="25.0", I1="1.1", I2="1.4", I3="2.1", m1="2.5", m2="1.5", low="0.3", high="0.35",
                                Jt="0.09", Jr="0.06", g="9.81").items()}
feet, joints = [vec(*map(mpf, f)) for f in FEET], [vec(*map(mpf, j)) for j in JOINTS]
place = lambda q: vec(q["x"], q["y"], q["z"])
attitude = lambda q: rz(q["yaw"]) * ry(q["pitch"]) * rx(q["roll"])
tip = lambda k, q: place(q) + attitude(q) * joints[k]
strut = lambda k, q: tip(k, q) - feet[k]
size = lambda v: mpmath.sqrt(dot(v, v))
PLATFORM = ["x", "y", "z", "yaw", "pitch", "roll"]
LENGTHS = [f"leg{k}" for k in range(6)]


def turned(n):
    """A frame whose third axis points along n."""
    return rz(mpmath.atan2(n[1], n[0])) * ry(mpmath.acos(n[2] / size(n)))


def platform(q):
    return (P["M"], diagonal(P["I1"], P["I2"], P["I3"]), place(q), attitude(q))


def weight(q, direction):
    """The potential, where legs point along a direction."""
    found = P["M"] * q["z"]
    for k in range(6):
        along = direction(k, q)
        end = feet[k] + q[LENGTHS[k]] * along
        found += P["m1"] * (feet[k] + P["low"] * along)[2] + P["m2"] * (end - P["high"] * along)[2]
    return P["g"] * found


def by_lengths(q):
    found = [platform(q)]
    for k in range(6):
        n = strut(k, q) / q[LENGTHS[k]]
        # the moments of inertia as a mass at the end of n: multipliers belong to an energy off the constraints as well
        found += [(P["m1"], None, feet[k] + P["low"] * n, None), (P["m2"], None, tip(k, q) - P["high"] * n, None)]
        found += [(P["Jt"] + P["Jr"], None, n, None)]
    return found


def by_angles(q):
    found = [platform(q)]
    for k in range(6):
        n = direction(k, q)
        across = lambda J: diagonal(P[J], P[J], 0)
        found += [(P["m1"], across("Jt"), feet[k] + P["low"] * n, turned(n))]
        found += [(P["m2"], across("Jr"), feet[k] + (q[LENGTHS[k]] - P["high"]) * n, turned(n))]
    return found


def direction(k, q):
    a, e = q[f"turn{k}"], q[f"rise{k}"]
    return vec(mpmath.cos(e) * mpmath.cos(a), mpmath.cos(e) * mpmath.sin(a), mpmath.sin(e))


push = list(map(mpf, ("110.0", "45.0", "70.0", "95.0", "60.0", "88.0")))
pushed = lambda names: lambda q, v: [push[LENGTHS.index(c)] if c in LENGTHS else mpf(0) for c in names]
# the squares of the lengths, differentiated
closed = lambda q, v, rate: [
    2 * dot(strut(k, q), rate(lambda x: strut(k, x))) - 2 * q[LENGTHS[k]] * v[LENGTHS[k]] for k in range(6)
]
held = lambda q, v, rate: [
    c for k in range(6) for c in rate(lambda x: tip(k, x) - feet[k] - x[LENGTHS[k]] * direction(k, x))
]
ANGLES = [f"{a}{k}" for k in range(6) for a in ("turn", "rise")]
machine = Machine("stewart", "", [*PLATFORM, *LENGTHS], {}, by_lengths, closed, lambda q: weight(q, lambda k, q: strut(k, q) / q[LENGTHS[k]]),
                  force=pushed([*PLATFORM, *LENGTHS]))
other = Machine("stewart", "", [*PLATFORM, *LENGTHS, *ANGLES], {}, by_angles, held, lambda q: weight(q, direction),
                force=pushed([*PLATFORM, *LENGTHS, *ANGLES]))

where = list(map(mpf, ("0.05", "-0.08", "0.9", "0.2", "-0.15", "0.1")))
rates = list(map(mpf, ("0.3", "-0.2", "0.4", "0.5", "-0.7", "0.6")))


def with_legs(x):
    q = dict(zip(PLATFORM, x))
    return [size(strut(k, q)) for k in range(6)]


def with_angles(x):
    q = dict(zip(PLATFORM, x))
    found = []
    for k in range(6):
        s = strut(k, q)
        found += [mpmath.atan2(s[1], s[0]), mpmath.asin(s[2] / size(s))]
    return found


def lifted(f, x, v):
    return list(along(lambda y: mpmath.matrix(f(y)), x, v, FINE))


q = [*where, *with_legs(where)]
v = [*rates, *lifted(with_legs, where, rates)]
a, multipliers = machine.accelerations(q, v)
b, _ = other.accelerations([*q, *with_angles(where)], [*v, *lifted(with_angles, where, rates)])
assert max(abs(x - y) for x, y in zip(a, b)) < mpf(10) ** -25 * max(map(abs, a))


def show(name, numbers):
    print(name, "[" + ", ".join(mpmath.nstr(x, 25) for x in numbers) + "]")


show("legs", q[6:])
show("rates of the legs", v[6:])
show("accelerations", a)
show("multipliers", multipliers)
show("energy", [machine.energy(q, v)])

# what holds it at rest: no virtual displacement of the platform does work, d length push = d weight
height = lambda x: [machine.potential(dict(zip([*PLATFORM, *LENGTHS], [*x, *with_legs(x)])))]
unit = [[mpf(int(i == j)) for j in range(6)] for i in range(6)]
slopes = mpmath.matrix([lifted(with_legs, where, e) for e in unit])
show("held by", mpmath.lu_solve(slopes, mpmath.matrix([lifted(height, where, e)[0] for e in unit])))

# legs that weigh nothing: forces along them, whose sum carries the weight and whose moments about the platform's centre
# cancel
at = dict(zip(PLATFORM, where))
columns = []
for k in range(6):
    n = strut(k, at) / size(strut(k, at))
    columns.append([*n, *cross(attitude(at) * joints[k], n)])
wrenches = mpmath.matrix(columns).T
show("held by legs without weight", mpmath.lu_solve(wrenches, mpmath.matrix([0, 0, P["M"] * P["g"], 0, 0, 0])))
