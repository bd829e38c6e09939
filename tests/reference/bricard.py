#!/usr/bin/env python3
"""The motion of a loop of six rods for tests/tests/holonomic/redundant.rs, with the one coordinate that it has.

Six hinges whose axes are turned by a right angle to and fro from rod to rod, all rods of length 1 (Bricard's trihedral
loop, every second angle the same): with the angles a, b, a, b, a, b it is closed where cos a cos b + cos a + cos b = 0.
So T = M(a) a'^2 / 2 and a'' = -(M' a'^2 / 2 + V') / M; no constraint and no multiplier occurs. Rods are uniform, of mass
1, five of them move, and gravity 9.81 acts against the first axis.

Usage: python3 bricard.py
"""
from mpmath import mp, mpf, matrix, cos, sin, acos, diff

mp.dps = 40
G = mpf("9.81")


def other(a):
    return acos(-cos(a) / (1 + cos(a)))


def hinges(a):
    """The places of the hinges, the first in the origin."""
    angles = [a, other(a)] * 3
    turn, place, found = matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), matrix([0, 0, 0]), [matrix([0, 0, 0])]
    for k, q in enumerate(angles):
        sign = 1 if k % 2 == 0 else -1
        place = place + turn * matrix([cos(q), sin(q), 0])
        turn = turn * matrix([[cos(q), 0, sign * sin(q)], [sin(q), 0, -sign * cos(q)], [0, sign, 0]])
        found.append(place)
    defect = max([abs(x) for x in place] + [abs(turn[i, j] - (i == j)) for i in range(3) for j in range(3)])
    assert defect < mpf(10) ** -30, defect
    return found


def inertia(a):
    slopes = [matrix([diff(lambda x: hinges(x)[k][i], a) for i in range(3)]) for k in range(6)]
    dot = lambda u, v: sum(u[i] * v[i] for i in range(3))
    return sum(dot(u, u) + dot(u, v) + dot(v, v) for u, v in zip(slopes, slopes[1:])) / 3


def potential(a):
    places = hinges(a)
    return G * sum(places[k][2] + places[k + 1][2] for k in range(5)) / 2


def acceleration(a, rate):
    return -(diff(inertia, a) * rate ** 2 / 2 + diff(potential, a)) / inertia(a)


def show(name, numbers):
    print(name, "[" + ", ".join(mp.nstr(x, 20) for x in numbers) + "]")


def main():
    a, rate = mpf("1.2"), mpf("0.7")
    found = acceleration(a, rate)
    slope, curvature = diff(other, a), diff(other, a, 2)
    show("angles", [a, other(a)])
    show("rates", [rate, slope * rate])
    show("accelerations", [found, curvature * rate ** 2 + slope * found])


if __name__ == "__main__":
    main()
