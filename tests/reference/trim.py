#!/usr/bin/env python3
"""Steady motions for tests/tests/linearization.rs, with mpmath: Newton and Euler for a car and a robot."""
from mpmath import mp, mpf, findroot, sin, cos, atan

mp.dps = 40

# a car with tyres that push aside in proportion to their slip: force and moment balances in axes of the car
m, J, a, b, cf, cr = map(mpf, (1500, 2500, "1.2", "1.6", 80000, 90000))
u, r = mpf(20), mpf("0.3")


def car(v, steer, drive):
    front = cf * (steer - atan((v + a * r) / u))
    rear = cr * -atan((v - b * r) / u)
    # m (u̇ − v r), m (v̇ + u r), J ṙ with u̇ = v̇ = ṙ = 0
    return [
        drive - front * sin(steer) + m * v * r,
        front * cos(steer) + rear - m * u * r,
        a * front * cos(steer) - b * rear,
    ]


v, steer, drive = findroot(car, (mpf(0), mpf("0.05"), mpf(0)))
print("V", mp.nstr(v, 20), "STEER", mp.nstr(steer, 20), "DRIVE", mp.nstr(drive, 20))
