#!/usr/bin/env python3
"""Accelerations of machines with loops for tests/tests/holonomic/{five_bar,delta}.rs, and a long swing for
long_swing.rs: in redundant coordinates, with one multiplier for each constraint, by differences at 60 digits.

    [ M  -F^T ] [ q'' ]   [ Q - sum J^T m J' q' ]
    [ F   0   ] [ l   ] = [ -F' q'              ]

No Lagrangian and no elimination of constraints occurs.

Usage: python3 loops.py
"""
from mpmath import mp, mpf, matrix, cos, sin, findroot, lu_solve, asin, sqrt, ellipfun, ellipk

mp.dps = 60
H = mpf(10) ** -20


def gradient(f, q):
    """The derivatives of a list of functions, a row each."""
    up, rows = [], None
    for i in range(len(q)):
        a, b = list(q), list(q)
        a[i] += H
        b[i] -= H
        up.append([(x - y) / (2 * H) for x, y in zip(f(a), f(b))])
    return [[column[r] for column in up] for r in range(len(up[0]))]


def accelerations(points, constraints, rows, q, v, forces):
    """points: functions of q with a weight each (a mass, or a moment of inertia for an angle); constraints f(q) = 0;
    rows(q): constraints A(q) q' = 0; forces: generalized, by q."""
    n = len(q)
    weights = [w for w, _ in points]
    place = lambda q: [f(q) for _, f in points]
    along = lambda f: [(x - y) / (2 * H) for x, y in zip(f([a + H * b for a, b in zip(q, v)]), f([a - H * b for a, b in zip(q, v)]))]
    flat = lambda f: lambda q: [x for row in f(q) for x in row]
    J = lambda q: gradient(place, q)
    F = lambda q: (gradient(constraints, q) if constraints(q) else []) + rows(q)
    j, f = J(q), F(q)
    dj, df = along(flat(J)), along(flat(F))
    k = len(f)
    saddle, right = matrix(n + k, n + k), matrix(n + k, 1)
    for a in range(n):
        for b in range(n):
            saddle[a, b] = sum(w * row[a] * row[b] for w, row in zip(weights, j))
        right[a] = forces(q)[a] - sum(
            w * row[a] * sum(dj[r * n + b] * v[b] for b in range(n)) for r, (w, row) in enumerate(zip(weights, j))
        )
        for c in range(k):
            saddle[n + c, a] = f[c][a]
            saddle[a, n + c] = -f[c][a]
    for c in range(k):
        right[n + c] = -sum(df[c * n + b] * v[b] for b in range(n))
    return [lu_solve(saddle, right)[i] for i in range(n)]


def show(name, numbers):
    print(name, "[" + ", ".join(mp.nstr(x, 20) for x in numbers) + "]")


# the five-bar: two cranks with a rod on each, whose ends meet
l1, l2, l3, l4, d, g = map(mpf, ("0.3", "0.35", "0.5", "0.45", "0.4", "9.81"))
m = list(map(mpf, ("1.1", "1.3", "0.8", "0.7")))
I = list(map(mpf, ("0.02", "0.03", "0.015", "0.012")))
tau = list(map(mpf, ("2.5", "-1.5")))
e = lambda a: (cos(a), sin(a))


def middles(q):
    a, b, c, s = q
    return [
        (l1 / 2 * cos(a), l1 / 2 * sin(a)),
        (d + l2 / 2 * cos(b), l2 / 2 * sin(b)),
        (l1 * cos(a) + l3 / 2 * cos(c), l1 * sin(a) + l3 / 2 * sin(c)),
        (d + l2 * cos(b) + l4 / 2 * cos(s), l2 * sin(b) + l4 / 2 * sin(s)),
    ]


def meet(q):
    a, b, c, s = q
    return [
        l1 * cos(a) + l3 * cos(c) - d - l2 * cos(b) - l4 * cos(s),
        l1 * sin(a) + l3 * sin(c) - l2 * sin(b) - l4 * sin(s),
    ]


points = [(m[i], lambda q, i=i, k=k: middles(q)[i][k]) for i in range(4) for k in range(2)]
points += [(I[i], lambda q, i=i: q[i]) for i in range(4)]


def weights_and_torques(q):
    slope = gradient(lambda q: [-sum(g * m[i] * middles(q)[i][1] for i in range(4))], q)[0]
    return [x + t for x, t in zip(slope, tau + [0, 0])]


a, b = mpf("2.1"), mpf("0.9")
c, s = findroot(lambda c, s: meet([a, b, c, s]), (mpf("0.9"), mpf("2.2")))
q = [a, b, c, s]
rates = [mpf("0.7"), mpf("-0.4")]
G = gradient(meet, q)
dep = lu_solve(matrix([[G[0][2], G[0][3]], [G[1][2], G[1][3]]]), matrix([-sum(G[r][i] * rates[i] for i in range(2)) for r in range(2)]))
v = rates + [dep[0], dep[1]]
show("five-bar q", q)
show("five-bar v", v)
show("five-bar accelerations", accelerations(points, meet, lambda q: [], q, v, weights_and_torques))


# with a wheel at the end of the first rod that rolls along it: the tip does not move across the rod
def blade(q):
    tip = lambda q: [l1 * cos(q[0]) + l3 * cos(q[2]), l1 * sin(q[0]) + l3 * sin(q[2])]
    t = gradient(tip, q)
    return [[-sin(q[2]) * x + cos(q[2]) * y for x, y in zip(t[0], t[1])]]


rows = lambda q: gradient(meet, q) + blade(q)
A = rows(q)
dep = lu_solve(matrix([[row[i] for i in (1, 2, 3)] for row in A]), matrix([-row[0] * rates[0] for row in A]))
v = [rates[0], dep[0], dep[1], dep[2]]
show("wheel v", v)
show("wheel accelerations", accelerations(points, meet, blade, q, v, weights_and_torques))

# the delta robot: three arms with rods to a platform that does not turn
r, L, l, J, ma, M = map(mpf, ("0.1", "0.25", "0.6", "0.01", "0.4", "0.9"))
turns = [2 * mp.pi * k / 3 for k in range(3)]


def elbow(k, t):
    out, down = r + L * cos(t), -L * sin(t)
    return (out * cos(turns[k]), out * sin(turns[k]), down)


def rods(q):
    return [sum((q[3 + i] - elbow(k, q[k])[i]) ** 2 for i in range(3)) - l**2 for k in range(3)]


points = [(J, lambda q, k=k: q[k]) for k in range(3)] + [(M, lambda q, i=i: q[3 + i]) for i in range(3)]
torques = list(map(mpf, ("0.6", "-0.3", "0.2")))
forces = lambda q: [torques[k] + ma * g * L / 2 * cos(q[k]) for k in range(3)] + [0, 0, -M * g]
arms = list(map(mpf, ("0.3", "0.5", "0.1")))
p = findroot(lambda x, y, z: rods(arms + [x, y, z]), (mpf(0), mpf(0), mpf("-0.6")))
q = arms + list(p)
speeds = list(map(mpf, ("0.8", "-0.5", "0.3")))
G = gradient(rods, q)
dep = lu_solve(matrix([[row[3 + i] for i in range(3)] for row in G]), matrix([-sum(row[i] * speeds[i] for i in range(3)) for row in G]))
v = speeds + [dep[i] for i in range(3)]
show("delta q", q)
show("delta v", v)
show("delta accelerations", accelerations(points, rods, lambda q: [], q, v, forces))

# a pendulum of 250 m that swings up to 1 rad, after 100000 s: sin(theta/2) = k cd(omega t)
omega, k = sqrt(g / 250), sin(mpf(1) / 2)
t = mpf(100000)
u = omega * t
cd = ellipfun("cd", u, m=k**2)
theta = 2 * asin(k * cd)
rate = -2 * k * sqrt(1 - k**2) * omega * ellipfun("sd", u, m=k**2)
show("swing", [theta, rate])
