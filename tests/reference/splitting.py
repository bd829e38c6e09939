"""Reference numbers for the splitting of D by symmetries: horizontal lifts, locked inertia, curvature,
connection, momenta, their rates and the force of the horizontal equations; and accelerations on a level
of a conserved momentum.

Only vector fields on the configuration space are used, by their components as functions that are
evaluated at 60 digits and differentiated numerically. Accelerations come from unreduced multipliers. The
rates are derivatives of the momenta along the motion, and the force is what the Euler-Lagrange
expression of the constrained Lagrangian needs: neither uses a bracket or a momentum equation.

    python3 tests/reference/splitting.py > tests/reference/splitting.json     (Python 3.11, mpmath 1.3.0)
"""

import json
from mpmath import mp, mpf, matrix, sin, cos, tan, inverse, lu_solve, diff

mp.dps = 60


def jacobian(f, point):
    """Columns: the derivatives of a list-valued function."""
    n = len(point)
    columns = []
    for j in range(n):
        count = len(f(point))
        columns.append([
            diff(lambda s: f([p + (s if i == j else 0) for i, p in enumerate(point)])[k], 0)
            for k in range(count)
        ])
    return columns


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class System:
    def __init__(self, name, n, lagrangian, rows, sections, basis, shape, force):
        self.name, self.n, self.L, self.rows, self.S, self.basis = name, n, lagrangian, rows, sections, basis
        self.shape, self.force = shape, force

    def mass(self, q):
        zero = [mpf(0)] * self.n
        def entry(i, j):
            e = lambda k: [mpf(int(l == k)) for l in range(self.n)]
            plus = [a + b for a, b in zip(e(i), e(j))]
            T = lambda v: self.L(q, v) - self.L(q, zero)
            return T(plus) - T(e(i)) - T(e(j))
        return matrix(self.n, self.n) + matrix([[entry(i, j) for j in range(self.n)] for i in range(self.n)])

    def momenta(self, q, v):
        M = self.mass(q)
        unit = lambda i, sign: [mpf(sign * int(l == i)) for l in range(self.n)]
        linear = [(self.L(q, unit(i, 1)) - self.L(q, unit(i, -1))) / 2 for i in range(self.n)]
        return [dot(M[i, :], v) + linear[i] for i in range(self.n)]

    def acceleration(self, q, v):
        n, k = self.n, len(self.rows(q))
        M, A = self.mass(q), self.rows(q)
        slope = [diff(lambda s: self.L([x + (s if i == j else 0) for i, x in enumerate(q)], v), 0) for j in range(n)]
        turned = [diff(lambda s: self.momenta([x + s * y for x, y in zip(q, v)], v)[i], 0) for i in range(n)]
        right = [slope[i] - turned[i] + self.force(q, v)[i] for i in range(n)]
        for a in range(k):
            right.append(-diff(lambda s: dot(self.rows([x + s * y for x, y in zip(q, v)])[a], v), 0))
        saddle = matrix(n + k, n + k)
        for i in range(n):
            for j in range(n):
                saddle[i, j] = M[i, j]
            for a in range(k):
                saddle[i, n + a] = -A[a][i]
                saddle[n + a, i] = A[a][i]
        return list(lu_solve(saddle, matrix(right)))[:n]

    def lifts(self, q):
        """Least kinetic energy over unit rates of the shape coordinates, in D."""
        B = self.basis(q)
        M = self.mass(q)
        r, h = len(B), len(self.shape)
        C = matrix([[dot([dot(M[i, :], B[b]) for i in range(self.n)], B[a]) for b in range(r)] for a in range(r)])
        R = matrix([[B[a][i] for a in range(r)] for i in self.shape])
        raised = inverse(C) * R.T
        weights = raised * inverse(R * raised)
        return [[sum(B[a][i] * weights[a, k] for a in range(r)) for i in range(self.n)] for k in range(h)]

    def bracket(self, X, Y, q):
        dX, dY = jacobian(X, q), jacobian(Y, q)
        x, y = X(q), Y(q)
        return [sum(x[j] * dY[j][i] - y[j] * dX[j][i] for j in range(self.n)) for i in range(self.n)]

    def report(self, q, rates, vertical):
        q = [mpf(x) for x in q]
        h, s = len(self.shape), len(self.S(q))
        lifts, S = self.lifts(q), self.S(q)
        v = [sum(mpf(rates[k]) * lifts[k][i] for k in range(h)) + sum(mpf(vertical[r]) * S[r][i] for r in range(s))
             for i in range(self.n)]
        assert all(abs(dot(row, v)) < mpf(10) ** -50 for row in self.rows(q))
        M = self.mass(q)
        inertia = [[dot([dot(M[i, :], S[b]) for i in range(self.n)], S[a]) for b in range(s)] for a in range(s)]
        lift = lambda k: lambda q: self.lifts(q)[k]
        section = lambda r: lambda q: self.S(q)[r]
        curvature = [[self.bracket(lift(k), lift(l), q) for l in range(h)] for k in range(h)]
        coefficients = [[self.bracket(lift(k), section(r), q) for r in range(s)] for k in range(h)]
        a = self.acceleration(q, v)
        along = lambda s: ([x + s * y for x, y in zip(q, v)], [x + s * y for x, y in zip(v, a)])
        P = lambda q, v: [dot(section, self.momenta(q, v)) for section in self.S(q)]
        rates_of_P = [diff(lambda s: P(*along(s))[r], 0) for r in range(s)]
        # d/dt dl_c/dx'^k - h_k(l_c) - Q(h_k), at constant shape rates and vertical velocities
        def constrained(q):
            h_q, S_q = self.lifts(q), self.S(q)
            y = [sum(mpf(rates[k]) * h_q[k][i] for k in range(h)) + sum(mpf(vertical[r]) * S_q[r][i] for r in range(s))
                 for i in range(self.n)]
            return self.L(q, y)
        force = []
        for k in range(h):
            p = lambda s: dot(self.lifts(along(s)[0])[k], self.momenta(*along(s)))
            slope = diff(lambda s: constrained([x + s * y for x, y in zip(q, lifts[k])]), 0)
            force.append(diff(p, 0) - slope - dot(lifts[k], self.force(q, v)))
        numbers = lambda tree: [numbers(t) for t in tree] if isinstance(tree, list) else (
            float(tree) if abs(tree) > mpf(10) ** -30 else 0.0)
        return {
            "q": numbers(q), "v": numbers(v), "vertical_sections": numbers(S), "horizontal_lifts": numbers(lifts),
            "locked_inertia": numbers(inertia), "connection_coefficients": numbers(coefficients),
            "curvature": numbers(curvature), "vertical_momenta": numbers(P(q, v)),
            "vertical_momentum_rates": numbers(rates_of_P),
            "vertical_velocities": [float(mpf(x)) for x in vertical], "horizontal_force": numbers(force),
        }


# roller racer: theta, x, y, phi
m, I1, I2, d1, d2, torque = map(mpf, ["1.3", "0.7", "0.4", "0.6", "0.9", "0.35"])
roller_racer = System(
    "roller_racer", 4,
    lambda q, v: m / 2 * (v[1]**2 + v[2]**2) + I1 / 2 * v[0]**2 + I2 / 2 * (v[0] + v[3])**2,
    lambda q: [
        [0, -sin(q[0]), cos(q[0]), 0],
        [-d1 * cos(q[3]) - d2, -sin(q[0] + q[3]), cos(q[0] + q[3]), -d2],
    ],
    lambda q: [[sin(q[3]) / d2, -(d2 + d1 * cos(q[3])) / d2 * cos(q[0]), -(d2 + d1 * cos(q[3])) / d2 * sin(q[0]), 0]],
    # omega and the speed determine the rate of phi
    lambda q: [
        [1, 0, 0, -(d1 * cos(q[3]) + d2) / d2],
        [0, cos(q[0]), sin(q[0]), -sin(q[3]) / d2],
    ],
    [3], lambda q, v: [0, 0, 0, torque],
)

# snakeboard: x, y, theta, psi, phi
sm, sl, sJ0, sJ1, drive, steer = map(mpf, ["1.2", "0.8", "0.3", "0.15", "0.2", "-0.4"])
snakeboard = System(
    "snakeboard", 5,
    lambda q, v: sm / 2 * (v[0]**2 + v[1]**2) + sm * sl**2 / 2 * v[2]**2 + sJ0 / 2 * v[3]**2 + sJ0 * v[3] * v[2]
    + sJ1 * v[4]**2,
    lambda q: [
        [-sin(q[2] + q[4]), cos(q[2] + q[4]), -sl * cos(q[4]), 0, 0],
        [-sin(q[2] - q[4]), cos(q[2] - q[4]), sl * cos(q[4]), 0, 0],
    ],
    lambda q: [[cos(q[2]), sin(q[2]), -tan(q[4]) / sl, 0, 0], [0, 0, 0, 1, 0]],
    lambda q: [[cos(q[2]), sin(q[2]), -tan(q[4]) / sl, 0, 0], [0, 0, 0, 1, 0], [0, 0, 0, 0, 1]],
    [4], lambda q, v: [0, 0, 0, drive, steer],
)

# curvature over two shape coordinates: x, y, z, u
k, f, g = map(mpf, ["0.7", "0.3", "-0.6"])
curved = System(
    "curved", 4,
    lambda q, v: (v[0]**2 + v[1]**2 + (1 + q[0]**2) * v[2]**2 + 2 * v[3]**2) / 2 + v[0] * v[3] / 3 - k * q[0] * q[1],
    lambda q: [[-q[1], 0, 1, -sin(q[0])]],
    lambda q: [[0, 0, sin(q[0]), 1]],
    lambda q: [[1, 0, q[1], 0], [0, 1, 0, 0], [0, 0, sin(q[0]), 1]],
    [0, 1], lambda q, v: [0, f, g * v[0], 0],
)

# no dimension assumption: x, y, z, w, with lifts over x and w
nodim = System(
    "nodim", 4,
    lambda q, v: (v[0]**2 + v[1]**2 + v[3]**2 + (v[2] + q[1] * v[0])**2) / 2 + q[1] * v[2] * v[3] / 4 - q[3]**2 * q[0],
    lambda q: [[0, 1, 0, -q[0]]],
    lambda q: [[0, 0, 1, 0]],
    lambda q: [[1, 0, 0, 0], [0, 0, 1, 0], [0, q[0], 0, 1]],
    [0, 3], lambda q, v: [0, 0, 0, 0],
)

# without constraints: theta, a, b
arm = System(
    "arm", 3,
    lambda q, v: (3 + cos(q[1])) / 2 * v[0]**2 + (v[1]**2 + v[2]**2) / 2 + v[0] * (v[1] * sin(q[2]) + v[2] * q[1] / 2)
    - k * cos(q[2]),
    lambda q: [],
    lambda q: [[1, 0, 0]],
    lambda q: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [1, 2], lambda q, v: [f, 0, 0],
)

# a conserved momentum along s, in a magnetic field, on a surface with a rough slope: x, y, z, s
field, stiff, slope, mass = map(mpf, ["0.8", "1.1", "0.45", "1.3"])
charged = System(
    "charged", 4,
    lambda q, v: mass / 2 * (v[0]**2 + v[1]**2 + v[2]**2) + (1 + q[0]**2) / 2 * v[3]**2 + q[1] * v[3] * v[0]
    + sin(q[0]) * v[3] * v[1] + field * q[0] * v[1] - stiff / 2 * q[0] * q[1]**2 - q[2] * q[0],
    lambda q: [[-q[1], -slope, 1, 0]],
    lambda q: [], lambda q: [], [], lambda q, v: [0, 0, 0, 0],
)


def on_level(system, q, v, cyclic):
    q, v = [mpf(x) for x in q], [mpf(x) for x in v]
    v[2] = q[1] * v[0] + slope * v[1]
    numbers = lambda values: [float(x) for x in values]
    momentum = diff(lambda s: system.L(q, [x + (s if i == cyclic else 0) for i, x in enumerate(v)]), 0)
    a = system.acceleration(q, v)
    return {"q": numbers(q), "v": numbers(v), "level": float(momentum), "acceleration": numbers(a)}


print(json.dumps({
    "roller_racer": roller_racer.report(["0.4", "0.3", "-0.2", "0.7"], ["0.9"], ["-0.5"]),
    "snakeboard": snakeboard.report(["0.3", "-0.2", "0.5", "0.1", "0.6"], ["0.8"], ["0.7", "-0.9"]),
    "curved": curved.report(["0.6", "-0.4", "0.2", "0.1"], ["0.5", "-0.8"], ["0.9"]),
    "nodim": nodim.report(["0.6", "-0.4", "0.2", "0.3"], ["0.5", "-0.8"], ["0.9"]),
    "arm": arm.report(["0.6", "-0.4", "0.2"], ["0.5", "-0.8"], ["0.9"]),
    "charged": on_level(charged, ["0.4", "-0.7", "0.3", "0"], ["0.9", "-0.5", "0", "0.6"], 3),
}, indent=1))
