"""Writes brackets.json: nonholonomic brackets, R_L and connections of systems that are in no catalogue.

Nothing here is derived: everything is evaluated at one point with 50 digits, from definitions.
theta = p_a e^a is the Poincare-Cartan section and omega = -d theta on pairs (z, V) of a velocity and a
change of velocity; H holds those pairs with J z = 0 and J V + rho(z) phi = 0. X_f in H with
omega(X_f, Y) = df(Y) for all Y in H gives {f, g} = df(X_g) (CLMM section 7). The motion comes from the
unreduced equations with multipliers, and R_L is the motion less X_E. For connections: the symmetric part
of the Christoffel symbols from the geodesic equations, the antisymmetric one from the brackets, then
P (nabla_s t) + nabla_s (Q t) with the projectors as matrices.

Usage: python3 brackets.py, in this directory (sympy and mpmath).
"""

import json

import mpmath as mp
import sympy as sp
from sympy import Rational as Q, cos, exp, sin, sqrt

mp.mp.dps = 50
t = sp.Symbol("t")
SO3 = {(0, 1): {2: 1}, (1, 2): {0: 1}, (0, 2): {1: -1}}


def text(value):
    return mp.nstr(mp.mpf(value) if abs(value) > mp.mpf(10) ** -35 else mp.mpf(0), 25)


def derived(x, rho):
    """The structure functions of a frame on TQ."""
    n, s = rho.shape
    found = {}
    for a in range(s):
        for b in range(a + 1, s):
            bracket = sp.Matrix([sum(rho[j, a] * sp.diff(rho[i, b], x[j]) - rho[j, b] * sp.diff(rho[i, a], x[j])
                                     for j in range(n)) for i in range(n)])
            entries = {c: sp.simplify(e) for c, e in enumerate(rho.LUsolve(bracket))}
            found[a, b] = {c: e for c, e in entries.items() if e != 0}
    return found


def null_space(rows, size):
    rows, pivots, r = [row[:] for row in rows], [], 0
    for c in range(size):
        if r == len(rows):
            break
        best = max(range(r, len(rows)), key=lambda i: abs(rows[i][c]))
        if abs(rows[best][c]) < mp.mpf(10) ** -30:
            continue
        rows[r], rows[best] = rows[best], rows[r]
        rows[r] = [e / rows[r][c] for e in rows[r]]
        for i in range(len(rows)):
            if i != r:
                rows[i] = [a - rows[i][c] * b for a, b in zip(rows[i], rows[r])]
        pivots.append(c)
        r += 1
    found = []
    for free in (c for c in range(size) if c not in pivots):
        vector = [mp.mpf(0)] * size
        vector[free] = mp.mpf(1)
        for i, c in enumerate(pivots):
            vector[c] = -rows[i][free]
        found.append(vector)
    return found


def brackets(x, y, rho, structure, L, phi, functions, values, forces=None, time=0):
    values = {s: sp.nsimplify(v) for s, v in values.items()} | {t: sp.nsimplify(time)}
    missing = [v for v in y if v not in values]
    if missing:
        values |= sp.solve([f.subs(values) for f in phi], missing, dict=True)[0]
    n, s, k = len(x), len(y), len(phi)
    num = lambda e: mp.mpf(sp.N(sp.sympify(e).subs(values), 60))
    slopes = lambda f, symbols: [num(sp.diff(f, v)) for v in symbols]
    momenta = [sp.diff(L, v) for v in y]
    p, px, W = [num(e) for e in momenta], [slopes(e, x) for e in momenta], [slopes(e, y) for e in momenta]
    anchor_entries = [[num(e) for e in rho.row(i)] for i in range(n)]
    J, F = [slopes(f, y) for f in phi], [slopes(f, x) for f in phi]
    dot = lambda a, b: mp.fsum(i * j for i, j in zip(a, b))
    anchor = lambda z: [dot(row, z) for row in anchor_entries]

    def contract(z, w):
        r = [mp.mpf(0)] * s
        for (a, b), entries in structure.items():
            for c, e in entries.items():
                r[c] += num(e) * (z[a] * w[b] - z[b] * w[a])
        return r

    def omega(Z, Y):
        (z, V), (w, U) = Z, Y
        along = lambda z, V: [dot(px[a], anchor(z)) + dot(W[a], V) for a in range(s)]
        return dot(along(w, U), z) - dot(along(z, V), w) + dot(p, contract(z, w))

    zero, unit = [mp.mpf(0)] * s, lambda a: [mp.mpf(int(a == b)) for b in range(s)]
    rows = [J[A] + zero for A in range(k)]
    rows += [[dot(F[A], anchor(unit(a))) for a in range(s)] + J[A] for A in range(k)]
    H = [(v[:s], v[s:]) for v in null_space(rows, 2 * s)]
    form = mp.matrix([[omega(Y, X) for Y in H] for X in H]).T

    def differential(f):
        fx, fy = slopes(f, x), slopes(f, y)
        return lambda Z: dot(fx, anchor(Z[0])) + dot(fy, Z[1])

    def field(f):
        # omega(sum c_i H_i, H_j) = df(H_j)
        c = mp.lu_solve(-form, mp.matrix([differential(f)(Y) for Y in H]))
        return [[mp.fsum(c[i] * H[i][part][a] for i in range(len(H))) for a in range(s)] for part in (0, 1)]

    # the motion
    velocity, lx = [num(v) for v in y], slopes(L, x)
    rest = [dot(px[a], anchor(velocity)) + num(sp.diff(momenta[a], t)) - dot(lx, anchor(unit(a)))
            + dot(p, contract(unit(a), velocity)) - num((forces or [0] * s)[a]) for a in range(s)]
    matrix, right = mp.zeros(s + k), mp.zeros(s + k, 1)
    for a in range(s):
        right[a] = -rest[a]
        for b in range(s):
            matrix[a, b] = W[a][b]
        for A in range(k):
            matrix[a, s + A], matrix[s + A, a] = -J[A][a], J[A][a]
    for A in range(k):
        right[s + A] = -dot(F[A], anchor(velocity)) - num(sp.diff(phi[A], t))
    motion = (velocity, list(mp.lu_solve(matrix, right))[:s])

    energy_field = field(sum(v * m for v, m in zip(y, momenta)) - L)
    differentials, fields = [differential(f) for f in functions], [field(f) for f in functions]
    energy = [d(energy_field) for d in differentials]
    rates = [d(motion) + num(sp.diff(f, t)) for d, f in zip(differentials, functions)]
    return {
        "velocity": [text(v) for v in velocity],
        "bracket": [text(d(X)) for d in differentials for X in fields],
        "energy": [text(e) for e in energy],
        "drift": [text(r - e) for r, e in zip(rates, energy)],
    }


def connections(x, rho, G, values, basis=None, annihilator=None):
    s, n, C = G.shape[0], len(x), derived(x, rho)
    y = sp.symbols(f"y:{s}")
    entry = lambda c, a, b: C.get((a, b), {}).get(c, 0) if a < b else -C.get((b, a), {}).get(c, 0)
    L = sum(G[i, j] * y[i] * y[j] for i in range(s) for j in range(s)) / 2
    p = [sp.diff(L, v) for v in y]
    rates = [sum(rho[i, a] * y[a] for a in range(s)) for i in range(n)]
    rest = [sum(sp.diff(p[a], x[i]) * rates[i] - rho[i, a] * sp.diff(L, x[i]) for i in range(n))
            + sum(entry(c, a, b) * y[b] * p[c] for b in range(s) for c in range(s)) for a in range(s)]
    geodesic = -G.LUsolve(sp.Matrix(rest))
    symbols = [[[-sp.diff(geodesic[c], y[a], y[b]) / 2 + Q(1, 2) * entry(c, a, b) for c in range(s)]
                for b in range(s)] for a in range(s)]

    def nabla(u, v):
        along = lambda f: sum(u[a] * rho[i, a] * sp.diff(f, x[i]) for a in range(s) for i in range(n))
        turned = lambda c: sum(symbols[a][b][c] * u[a] * v[b] for a in range(s) for b in range(s))
        return sp.Matrix([along(v[c]) + turned(c) for c in range(s)])

    if basis is not None:
        mass, sections = basis.T * G * basis, [list(basis[:, a]) for a in range(basis.shape[1])]
        found = [mass.LUsolve(basis.T * G * nabla(u, v)) for u in sections for v in sections]
    else:
        inverse, phi = G.inv(), annihilator
        complement = inverse * phi.T * (phi * inverse * phi.T).inv() * phi
        unit = lambda a: [int(a == b) for b in range(s)]
        found = [(sp.eye(s) - complement) * nabla(unit(a), unit(b)) + nabla(unit(a), list(complement[:, b]))
                 for a in range(s) for b in range(s)]
    number = lambda e: text(mp.mpf(sp.N(sp.sympify(e).subs(values), 40)))
    return {
        "christoffel": [number(e) for plane in symbols for row in plane for e in row],
        "connection": [number(e) for vector in found for e in vector],
    }


def main():
    s = sp.Symbol
    x, y, z, th, dx, dy, dz, dth = sp.symbols("x y z th dx dy dz dth")
    m, c, k, w, J, g, q, B, V, f, e, h, u, l = sp.symbols("m c k w J g q B V f e h u l")
    a, b, d = sp.symbols("a b d")
    three = sp.eye(3)
    data = {}
    data["relativistic"] = brackets(
        [x, y, z], [dx, dy, dz], three, {},
        -m * c**2 * sqrt(1 - (dx**2 + dy**2 + dz**2) / c**2) - k * x**2 / 2, [dz - y * dx - w * x],
        [x, y, z, dx + y * dz, dy * x],
        {m: "1.3", c: 2, k: "0.7", w: "0.4", x: "0.3", y: "-0.5", z: "0.2", dx: "0.6", dy: "-0.4"})
    data["quartic_skate"] = brackets(
        [x, y, th], [dx, dy, dth], three, {},
        m / 2 * (dx**2 + dy**2) + q / 4 * (dx**2 + dy**2)**2 + J / 2 * dth**2 - g * sin(x),
        [sin(th) * dx - cos(th) * dy],
        [x, y, th, dx * cos(th) + dy * sin(th), dth * x, sin(th) * dx - cos(th) * dy],
        {m: "1.3", q: "0.8", J: "0.7", g: "0.9", x: "0.3", y: "-0.5", th: "0.6", dx: "0.6", dth: "-0.4"})
    data["appell_hamel"] = brackets(
        [x, y, z], [dx, dy, dz], three, {}, m / 2 * (dx**2 + dy**2 + dz**2) - m * g * z,
        [dx**2 + dy**2 - k**2 * dz**2], [x, y, z, dx, dy, dz],
        {m: "1.3", g: "0.9", k: "1.25", x: "0.3", y: "-0.5", z: "0.6", dx: "0.6", dy: "0.8", dz: "0.8"})
    data["steered"] = brackets(
        [x, y, th], [dx, dy, dth], three, {}, m / 2 * (dx**2 + dy**2) + J / 2 * dth**2,
        [dth - sin(t) - x * dy], [x, y * t, dy * dx],
        {m: "1.3", J: "0.7", x: "0.3", y: "-0.5", th: "0.6", dx: "0.6", dy: "0.8"}, time="0.35")
    data["speed"] = brackets(
        [x, y, z], [dx, dy, dz], three, {},
        m / 2 * (dx**2 + dy**2 + (1 + x**2) * dz**2) - k * x * y + B * y * dz,
        [dx**2 + dy**2 + y * dz**2 - c**2 - x * dz], [x, y, z, dx, dy * x, dz],
        {m: "1.3", k: "0.9", c: "1.25", B: "0.4", x: "0.3", y: "0.5", z: "0.6",
         dx: sqrt(Q(25, 16) - Q(12, 100) - Q(64, 100) - Q(8, 100)), dy: "0.8", dz: "-0.4"})
    rho = sp.Matrix([[1, 0, 0], [0, cos(x), 0], [y, 0, 1]])
    data["spanned"] = brackets(
        [x, y, z], [a, b, d], rho, derived([x, y, z], rho),
        (a**2 + m * b**2 * exp(x)) / 2 + k * a * b - x**2 * z, [d - y * a + x * b],
        [x, y * z, a, b * b, d],
        {m: "1.3", k: "0.3", f: "0.8", x: "0.3", y: "-0.5", z: "0.6", a: "0.6", b: "0.8"},
        forces=[-f * x + Q(3, 10) * x * y, 0, Q(3, 10) * x])
    w3, g3 = sp.symbols("w:3"), sp.symbols("g:3")
    inertia, weight = [Q(13, 10), 2, Q(17, 10)], [Q(1, 5), -Q(3, 10), Q(1, 2)]
    rho = sp.Matrix([[0, -g3[2], g3[1]], [g3[2], 0, -g3[0]], [-g3[1], g3[0], 0]])
    motor = lambda speed, angle: sin(speed * angle)
    data["moving_veselova"] = brackets(
        list(g3), list(w3), rho, SO3,
        sum(i * v**2 for i, v in zip(inertia, w3)) / 2 + k * g3[0] * w3[1] - sum(i * v for i, v in zip(weight, g3))
        + e * w3[2]**4, [sum(i * v for i, v in zip(g3, w3)) - h * (1 + t) - g3[2]],
        list(g3) + [i * v * t for i, v in zip(inertia, w3)] + [motor(w3[0], g3[1]) * w3[2]],
        {h: "0.25", k: "0.4", e: "0.15", u: "0.7", g3[0]: Q(1, 3), g3[1]: Q(2, 3), g3[2]: -Q(2, 3), w3[0]: "0.6",
         w3[1]: "0.8"}, forces=[motor(w3[1], g3[0]), 0, u * g3[0]], time="0.3")
    R = sp.Matrix(3, 3, sp.symbols("R:9"))
    rows = [[1, 0, 0, 0, 0], [0, 1, 0, 0, 0]]
    for i in range(3):
        rows += [[0, 0, 0, -R[i, 2], R[i, 1]], [0, 0, R[i, 2], 0, -R[i, 0]], [0, 0, -R[i, 1], R[i, 0], 0]]
    r, Om = sp.symbols("r Om")
    spin = R * sp.Matrix(w3)
    turned = sp.Matrix([[-20, 4, 22], [20, -10, 20], [10, 28, 4]]) / 30
    data["ball_on_table"] = brackets(
        [x, y] + list(R), [a, b] + list(w3), sp.Matrix(rows),
        {(i + 2, j + 2): {c + 2: v for c, v in entries.items()} for (i, j), entries in SO3.items()},
        m / 2 * (a**2 + b**2) + sum(i * v**2 for i, v in zip(inertia, w3)) / 2 - k / 2 * (x**2 + y**2),
        [a - r * spin[1] + Om * y, b + r * spin[0] - Om * x], [x, y, R[2, 0], w3[0], a, w3[1] * R[0, 1]],
        {m: "1.3", r: "0.6", Om: "0.45", k: "0.7", x: "0.3", y: "-0.5", w3[0]: "0.6", w3[1]: "0.8", w3[2]: "-0.3"}
        | dict(zip(R, turned)))
    data["cone"] = connections(
        [x, y, z], sp.Matrix([[1 + y**2, 0, 0], [0, exp(x), 0], [x, 0, 1]]),
        m * sp.Matrix([[1, 0, x / 3], [0, 2 + sin(y), 0], [x / 3, 0, 1]]),
        {m: Q(13, 10), x: Q(3, 10), y: -Q(1, 2), z: Q(6, 10)}, basis=sp.Matrix([[1, 0], [0, 1], [y, 0]]))
    data["skate"] = connections(
        [x, y, th], three, sp.Matrix([[m, 0, l * cos(th)], [0, m, 0], [l * cos(th), 0, J]]),
        {m: Q(13, 10), J: Q(7, 10), l: Q(1, 5), x: Q(3, 10), y: -Q(1, 2), th: Q(6, 10)},
        annihilator=sp.Matrix([[sin(th), -cos(th), 0]]))
    with open("brackets.json", "w") as file:
        json.dump(data, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
