"""Writes the reference data of four machines on wheels: more/{mecanum,segway,rider,hitch}.txt.

Bodies stand as positions and rotation matrices in space, functions of ordinary coordinates; their
velocities are derivatives of these, the kinetic energy is that of the velocities, and wheels roll where
the velocity of a point says so. The constraints are differentiated once, and one linear solve at 50
digits gives accelerations and multipliers together, as in unreduced.py. Quasi-velocities are functions
of the result.

Usage: python3 more_wheels.py, in this directory.
"""

import random

import mpmath
import sympy as sp
from sympy import cos, sin

mpmath.mp.dps = 50
t = sp.Symbol("t")


class Machine:
    """Coordinates with their velocities; sub-classes say L, the constraints, the forces, what is looked at."""

    def __init__(self, names):
        self.q = sp.symbols(names, seq=True)
        self.v = [sp.Symbol("d" + name.name) for name in self.q]

    def rate(self, expression):
        pairs = zip(self.q, self.v)
        return sp.diff(expression, t) + sum((sp.diff(expression, a) * b for a, b in pairs), sp.Integer(0))

    def velocity(self, position):
        return sp.Matrix(position).applyfunc(self.rate)

    def spin(self, rotation):
        """Body components of the angular velocity, from RᵀR'."""
        hat = rotation.T * rotation.applyfunc(self.rate)
        return sp.Matrix([hat[2, 1], hat[0, 2], hat[1, 0]])

    def write(self, file, lagrangian, constraints, forces, quasi):
        q, v, n, k = self.q, self.v, len(self.q), len(constraints)
        p = [sp.diff(lagrangian, x) for x in v]
        mass = sp.Matrix(n, n, lambda i, j: sp.diff(p[i], v[j]))
        rest = [self.rate(p[i]) - sp.diff(lagrangian, q[i]) for i in range(n)]
        jacobian = sp.Matrix(k, n, lambda a, j: sp.diff(constraints[a], v[j]))
        drift = [self.rate(phi) for phi in constraints]
        energy = sum(a * b for a, b in zip(p, v)) - lagrangian
        rates = [(self.rate(y), [sp.diff(y, x) for x in v]) for y in quasi.values()]
        f = lambda e: sp.lambdify([t, *q, *v], e, "mpmath", cse=True)
        mass, rest, jacobian, drift, phi, force, energy, outputs, rates = map(
            f, (mass, rest, jacobian, drift, constraints, forces, energy, list(quasi.values()), rates))
        column = lambda entries: mpmath.matrix([mpmath.mpf(x) for x in entries])
        text = lambda numbers: " ".join(mpmath.nstr(x, 20) for x in numbers)
        draw = random.Random(file)
        some = lambda scale: mpmath.mpf(draw.randint(-1000, 1000)) / 1000 * scale
        lines = ["# unreduced Lagrange multipliers, coordinates " + " ".join(x.name for x in q)]
        lines.append("names " + " ".join([*(self.field(x.name) for x in q), *quasi]))
        for _ in range(3):
            at = [abs(some(2)), *(some(1) for _ in q)]
            # velocities that the constraints allow: the nearest to random ones
            start = column(some(1) for _ in v)
            rows = mpmath.matrix(jacobian(*at, *start))
            start -= rows.T * mpmath.lu_solve(rows * rows.T, column(phi(*at, *start)))
            at += list(start)
            assert max(abs(x) for x in phi(*at)) < mpmath.mpf(10) ** -45
            system = mpmath.zeros(n + k)
            system[:n, :n], rows = mpmath.matrix(mass(*at)), mpmath.matrix(jacobian(*at))
            system[n:, :n], system[:n, n:] = rows, -rows.T
            right = column([*(a - b for a, b in zip(force(*at), rest(*at))), *(-x for x in drift(*at))])
            solved = list(mpmath.lu_solve(system, right))
            outer = [a + sum(x * y for x, y in zip(b, solved)) for a, b in rates(*at)]
            lines.append(f"at {mpmath.nstr(at[0], 20)}")
            lines.append("state " + text([*at[1:1 + n], *outputs(*at)]))
            lines.append("rate " + text([*at[1 + n:], *outer]))
            lines.append("energy " + text([mpmath.mpf(energy(*at))]))
            lines.append("multipliers " + text(solved[n:]))
        with open(f"more/{file}.txt", "w") as out:
            out.write("\n".join(lines) + "\n")

    @staticmethod
    def field(name):
        """a2 is the entry a[2] of the state."""
        return f"{name[:-1]}[{name[-1]}]" if name[-1].isdigit() else name


def turned(angle):
    return sp.Matrix([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])


def tilted(angle):
    """About the second axis: the third one goes to the first."""
    return sp.Matrix([[cos(angle), 0, sin(angle)], [0, 1, 0], [-sin(angle), 0, cos(angle)]])


def leaning(angle):
    """About the first axis."""
    return sp.Matrix([[1, 0, 0], [0, cos(angle), -sin(angle)], [0, sin(angle), cos(angle)]])


def squared(vector):
    return vector.dot(vector)


def in_plane(machine):
    """The velocities of the frame of a body at x, y, th."""
    x, y, th = machine.q[:3]
    vx, vy, om = machine.v[:3]
    return cos(th) * vx + sin(th) * vy, -sin(th) * vx + cos(th) * vy, om


number = sp.Rational


def mecanum():
    """A platform on four wheels whose rollers stand at 45 degrees to them."""
    machine = Machine("x y th a0 a1 a2 a3")
    x, y, th = machine.q[:3]
    m, J, Jw, r, length, width = (number(s) for s in ("5", "0.6", "0.03", "0.1", "0.3", "0.2"))
    frame, origin = turned(th), sp.Matrix([x, y, 0])
    centre = machine.velocity(origin + frame * sp.Matrix([number("0.07"), number("-0.03"), 0]))
    lagrangian = m / 2 * squared(centre) + J / 2 * machine.v[2] ** 2
    lagrangian += sum(Jw / 2 * spin ** 2 for spin in machine.v[3:])
    constraints = []
    # front left, front right, rear left, rear right: the contact slips along the roller's own axis only
    for spin, (along, side, roller) in zip(machine.v[3:], [(1, 1, -1), (1, -1, 1), (-1, 1, 1), (-1, -1, -1)]):
        at = sp.Matrix([along * length, side * width, 0])
        contact = frame.T * machine.velocity(origin + frame * at) - sp.Matrix([r * spin, 0, 0])
        constraints.append(-(contact[0] + roller * contact[1]))
    forces = [0, 0, 0, *(number(u) - v / 100 for u, v in zip(("0.3", "-0.2", "0.5", "0.1"), machine.v[3:]))]
    quasi = dict(zip(("vx", "vy", "om"), in_plane(machine)))
    machine.write("mecanum", lagrangian, constraints, forces, quasi)


def segway():
    """A pendulum on an axle with two wheels; the motors sit in the pendulum."""
    machine = Machine("x y yaw tilt right left")
    x, y, yaw, tilt, _, _ = machine.q
    mw, mb, Jd, Jw = (number(s) for s in ("0.5", "4", "0.002", "0.004"))
    inertia = sp.diag(number("0.2"), number("0.25"), number("0.11"))
    c, r, d, g = (number(s) for s in ("0.2", "0.1", "0.6", "9.81"))
    frame, origin = turned(yaw), sp.Matrix([x, y, 0])
    body = frame * tilted(tilt)
    centre = origin + body * sp.Matrix([0, 0, d])
    spin = machine.spin(body)
    lagrangian = mb / 2 * squared(machine.velocity(centre)) + (spin.T * inertia * spin)[0] / 2 - mb * g * centre[2]
    constraints = [(frame.T * machine.velocity(origin))[1]]
    for side, wheel in ((-1, machine.v[4]), (1, machine.v[5])):
        hub = machine.velocity(origin + frame * sp.Matrix([0, side * c, 0]))
        lagrangian += mw / 2 * squared(hub) + Jd / 2 * machine.v[2] ** 2 + Jw / 2 * wheel ** 2
        constraints.append((frame.T * hub)[0] - r * wheel)
    forces = [0, 0, 0, number("-0.3"), number("0.4"), number("-0.1")]
    dots = {f"{a.name}_dot": b for a, b in zip(machine.q, machine.v)}
    machine.write("segway", lagrangian, constraints, forces, dots)


def rider():
    """A rolling disk, and a rider who swings in its plane and pedals."""
    machine = Machine("x y yaw lean spin beta")
    x, y, yaw, lean, spin, beta = machine.q
    m, M, A, C, r, d, g = (number(s) for s in ("1.2", "0.8", "0.06", "0.11", "0.4", "0.7", "9.81"))
    plane = turned(yaw) * leaning(lean)
    hub = sp.Matrix([x, y, 0]) + plane * sp.Matrix([0, 0, r])
    top = hub + plane * sp.Matrix([d * sin(beta), 0, d * cos(beta)])
    wheel = plane * tilted(spin)
    w = machine.spin(wheel)
    lagrangian = m / 2 * squared(machine.velocity(hub)) + M / 2 * squared(machine.velocity(top))
    lagrangian += A / 2 * (w[0] ** 2 + w[2] ** 2) + C / 2 * w[1] ** 2 - m * g * hub[2] - M * g * top[2]
    # the point of the wheel that touches the ground rests
    below = -plane * sp.Matrix([0, 0, r])
    contact = machine.velocity(hub) + (wheel * w).cross(below)
    forces = [0, 0, 0, 0, number("0.33"), number("-0.33")]
    dots = {f"{a.name}_dot": b for a, b in zip(machine.q, machine.v)}
    machine.write("rider", sp.expand(lagrangian), [sp.simplify(contact[0]), sp.simplify(contact[1])], forces, dots)


def hitch():
    """A car with a steered axle, and a trailer that is hitched behind the rear axle."""
    machine = Machine("x y th delta psi")
    x, y, th, delta, psi = machine.q
    m, J, Jf, mt, Jt = (number(s) for s in ("2.1", "0.7", "0.05", "0.9", "0.21"))
    b, c, h, length, e = (number(s) for s in ("1.1", "0.45", "0.3", "0.8", "0.12"))
    rear = sp.Matrix([x, y, 0])
    ahead, steered, trailing = (turned(a) * sp.Matrix([1, 0, 0]) for a in (th, th + delta, psi))
    axle = rear - h * ahead - length * trailing
    lagrangian = m / 2 * squared(machine.velocity(rear + c * ahead)) + J / 2 * machine.v[2] ** 2
    lagrangian += Jf / 2 * (machine.v[2] + machine.v[3]) ** 2
    lagrangian += mt / 2 * squared(machine.velocity(axle + e * trailing)) + Jt / 2 * machine.v[4] ** 2
    sideways = lambda point, along: along.cross(machine.velocity(point))[2]
    constraints = [sideways(rear, ahead), sideways(rear + b * ahead, steered), sideways(axle, trailing)]
    drive = number("0.8") * ahead
    forces = [drive[0], drive[1], 0, number("-0.2"), 0]
    quasi = dict(zip(("v", "w", "om"), in_plane(machine)))
    quasi.update({"dd": machine.v[3], "dpsi": machine.v[4]})
    machine.write("hitch", lagrangian, constraints, forces, quasi)


if __name__ == "__main__":
    for machine in (mecanum, segway, rider, hitch):
        machine()
