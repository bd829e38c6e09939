"""Writes the reference data of the systems with moving and nonlinear constraints.

Each system stands below in ordinary coordinates. Its constraints phi(t, q, q') = 0 are
differentiated once, and one linear solve

    [ M  -J^T ] [ q''    ]   [ Q - h ]        M = d2L/dq'dq',  J = dphi/dq',
    [ J   0   ] [ lambda ] = [ -k    ]        h = dM-free rest of d/dt dL/dq' - dL/dq,
                                              k = dphi/dt + (dphi/dq) q'

gives accelerations and multipliers together (Lagrange-d'Alembert, Chetaev where phi is nonlinear).
sympy writes the derivatives down, mpmath evaluates and solves with 60 and with 100 digits, and the
two have to agree to 45. No quasi-velocity, bracket or adapted basis occurs.

Usage: python3 unreduced.py, in this directory.
"""

import json
import random

import mpmath
import sympy as sp

DIGITS = (60, 100)


class System:
    def __init__(self, name, setup, coordinates, parameters, lagrangian, constraints, forces=None, solve=None,
                 outputs=None, scaled=None, kinetic="", potential="", texts=None):
        self.name, self.setup, self.parameters = name, setup, parameters
        self.kinetic, self.potential, self.texts = kinetic, potential, texts
        self.coordinates = coordinates
        self.t = sp.Symbol("t")
        self.q = [sp.Symbol(c) for c in coordinates]
        self.v = [sp.Symbol("d" + c) for c in coordinates]
        names = {s.name: s for s in self.q + self.v + [self.t]}
        names.update({p: sp.Symbol(p) for p in parameters[0][1]})
        read = lambda text: sp.sympify(text, locals=names)
        self.names = names
        self.L = read(lagrangian)
        self.phi = {label: read(text) for label, text in constraints.items()}
        self.force = [read((forces or {}).get(c, "0")) for c in coordinates]
        self.solve = {k: read(e) for k, e in (solve or {}).items()}
        self.outputs = {k: read(e) for k, e in (outputs or {}).items()}
        self.scaled = {k: (label, read(e)) for k, (label, e) in (scaled or {}).items()}

        n, t, q, v = len(self.q), self.t, self.q, self.v
        p = [sp.diff(self.L, x) for x in v]
        phi = list(self.phi.values())
        along = lambda f: sp.diff(f, t) + sum(sp.diff(f, a) * b for a, b in zip(q, v))
        W = sp.Matrix(n, n, lambda i, j: sp.diff(p[i], v[j]))
        h = [along(p[i]) - sp.diff(self.L, q[i]) for i in range(n)]
        J = sp.Matrix(len(phi), n, lambda a, j: sp.diff(phi[a], v[j]))
        k = [along(f) for f in phi]
        energy = sum(a * b for a, b in zip(p, v)) - self.L
        self.arguments = [t, *q, *v, *[names[x] for x in parameters[0][1]]]
        f = lambda e: sp.lambdify(self.arguments, e, "mpmath", cse=True)
        self.eval = {key: f(e) for key, e in dict(
            W=W, h=h, J=J, k=k, Q=self.force, phi=phi, energy=energy, explicit=-sp.diff(self.L, t)).items()}
        self.eval_solve = {key: f(e) for key, e in self.solve.items()}
        self.eval_scaled = {key: (label, f(e)) for key, (label, e) in self.scaled.items()}
        # outputs and their rates, linear in the accelerations
        self.eval_outputs = {
            key: (f(e), f(along(e)), f([sp.diff(e, x) for x in v])) for key, e in self.outputs.items()}

    def sample(self, t, q, v, values, digits):
        mpmath.mp.dps = digits
        number = lambda x: mpmath.mpf(x)
        values = [number(x) for x in values.values()]
        t, q, v = number(t), [number(x) for x in q], {c: number(x) for c, x in v.items()}
        full = [v.get(c, number(0)) for c in self.coordinates]
        # dependent velocities, one after the other
        for c, f in self.eval_solve.items():
            full[self.coordinates.index(c)] = f(t, *q, *full, *values)
        x = [t, *q, *full, *values]
        e = {key: f(*x) for key, f in self.eval.items()}
        n, m = len(q), len(self.phi)
        assert all(abs(r) < mpmath.mpf(10) ** (5 - digits) for r in e["phi"]), (self.name, e["phi"])
        A, b = mpmath.zeros(n + m), mpmath.zeros(n + m, 1)
        for i in range(n):
            b[i] = e["Q"][i] - e["h"][i]
            for j in range(n):
                A[i, j] = e["W"][i, j]
            for a in range(m):
                A[i, n + a], A[n + a, i] = -e["J"][a, i], e["J"][a, i]
        for a in range(m):
            b[n + a] = -e["k"][a]
        solution = mpmath.lu_solve(A, b)
        acceleration, multiplier = list(solution[:n]), list(solution[n:])
        state = {c: q[i] for i, c in enumerate(self.coordinates)}
        rate = {c: full[i] for i, c in enumerate(self.coordinates)}
        for i, c in enumerate(self.coordinates):
            state["d" + c], rate["d" + c] = full[i], acceleration[i]
        for key, (value, drift, slope) in self.eval_outputs.items():
            state[key] = value(*x)
            rate[key] = drift(*x) + sum(s * a for s, a in zip(slope(*x), acceleration))
        multipliers = dict(zip(self.phi, multiplier))
        for key, (label, factor) in self.eval_scaled.items():
            multipliers[key] = multipliers[label] * factor(*x)
        forces = sum(f * y for f, y in zip(e["Q"], full))
        constraints = sum(
            l * e["J"][a, i] * full[i] for a, l in enumerate(multiplier) for i in range(n))
        power = dict(dE_dt=forces + constraints + e["explicit"], forces=forces, constraints=constraints,
                     explicit_time=e["explicit"])
        return dict(state=state, derivative=rate, multipliers=multipliers, energy=e["energy"], power=power)


def text(x, digits):
    return mpmath.nstr(x, digits, strip_zeros=True, min_fixed=-4, max_fixed=9) if abs(x) > mpmath.mpf(10) ** -45 else "0.0"


def written(sample):
    shown = {key: {k: text(x, 40 if key == "state" else 30) for k, x in part.items()}
             for key, part in sample.items() if key != "energy"}
    shown["energy"] = text(sample["energy"], 30)
    return shown


def agreement(a, b):
    """The worst number of digits to which two evaluations agree."""
    mpmath.mp.dps = max(DIGITS)
    flat = lambda s: [x for part in s.values() for x in (part.values() if isinstance(part, dict) else [part])]
    a, b = flat(a), flat(b)
    scale = max(abs(x) for x in b)
    return min((-mpmath.log10(abs(x - y) / scale) for x, y in zip(a, b) if x != y), default=mpmath.mpf(max(DIGITS)))


def compact(x):
    return json.dumps(x, separators=(",", ":"))


def write(system, samples=6):
    chance = random.Random(system.name)
    free = [c for c in system.coordinates if c not in system.solve]
    sets = []
    for label, values in system.parameters:
        rows, digits = [], mpmath.mpf(max(DIGITS))
        for _ in range(samples):
            t = f"{chance.uniform(0.0, 3.0):.4f}"
            q = [f"{chance.uniform(-1.5, 1.5):.4f}" for _ in system.coordinates]
            v = {c: f"{chance.uniform(-1.5, 1.5):.4f}" for c in free}
            low, high = (system.sample(t, q, v, values, digits) for digits in DIGITS)
            digits = min(digits, agreement(low, high))
            shown = written(high)
            order = ("state", "derivative", "multipliers", "energy", "power")
            rows.append(compact({"t": t, **{key: shown[key] for key in order}}))
        assert digits > 45, (system.name, digits)
        sets.append(
            '{"name":%s,"kind":"ordinary","comment":"",\n"values":%s,\n"rhs_certified_digits":%d,\n"rhs_samples":[\n%s],\n"trajectories":[]}'
            % (compact(label), compact(values), int(digits), ",\n".join(rows)))
    header = dict(name=system.name, source="unreduced.py", setup=system.setup,
                  constraints={k: str(e) + " = 0" for k, e in system.phi.items()},
                  lagrangian=str(system.L), forces={c: str(f) for c, f in zip(system.coordinates, system.force) if f != 0})
    lines = ",\n".join(f"{compact(k)}:{compact(v)}" for k, v in header.items())
    with open(system.name + ".json", "w", encoding="utf-8") as file:
        file.write("{\n" + lines + ',\n"parameter_sets":[\n' + ",\n".join(sets) + "\n]}\n")


SLEIGH = ("J/2*dtheta**2 + m/2*((dx - (a*sin(theta) + b*cos(theta))*dtheta)**2"
          " + (dy + (a*cos(theta) - b*sin(theta))*dtheta)**2)")
BODY = {"v1": "dx*cos(theta) + dy*sin(theta)", "v2": "-dx*sin(theta) + dy*cos(theta)"}

SYSTEMS = [
    System(
        "sleigh_on_a_belt",
        "Chaplygin sleigh, centre of mass at (a, b) from the blade, J about it, on a belt that moves along x with "
        "the velocity U*cos(w*t); rotary friction cf.",
        ["theta", "x", "y"],
        [("ordinary", dict(m="1.3", J="0.45", a="0.3", b="-0.12", U="0.8", w="1.7", cf="0.25")),
         ("centred", dict(m="2.1", J="0.2", a="0", b="0.4", U="-1.6", w="0.6", cf="0"))],
        SLEIGH,
        {"blade": "-sin(theta)*(dx - U*cos(w*t)) + cos(theta)*dy"},
        forces={"theta": "-cf*dtheta"},
        solve={"y": "tan(theta)*(dx - U*cos(w*t))"},
        outputs=BODY,
    ),
    System(
        "sleigh_with_steered_blade",
        "The same body on a floor at rest; its blade is turned by the angle A*sin(w*t) from the axis of the body.",
        ["theta", "x", "y"],
        [("ordinary", dict(m="1.3", J="0.45", a="0.3", b="-0.12", A="0.7", w="1.7")),
         ("wide", dict(m="0.7", J="0.9", a="-0.5", b="0.2", A="1.2", w="2.3"))],
        SLEIGH,
        {"blade": "-sin(theta + A*sin(w*t))*dx + cos(theta + A*sin(w*t))*dy"},
        solve={"y": "tan(theta + A*sin(w*t))*dx"},
        outputs=BODY,
        scaled={"blade_by_slope": ("blade", "cos(A*sin(w*t))")},
    ),
    System(
        "robot_with_prescribed_wheels",
        "Two-wheeled robot whose wheels turn as prescribed, with an arm (mass M at the distance d from the middle of "
        "the axle, absolute angle alpha) on a spring.",
        ["psi1", "psi2", "x", "y", "theta", "alpha"],
        [("ordinary", dict(m0="4.2", m1="0.6", l="0.15", J="0.9", J2="0.02", c="0.25", R="0.1", M="0.8", d="0.5",
                           k="1.4", W1="2.5", W2="-1.2", E="0.6", w="1.9"))],
        "(m0 + 2*m1)/2*(dx**2 + dy**2) + m0*l*(dy*cos(theta) - dx*sin(theta))*dtheta + J/2*dtheta**2"
        " + J2/2*(dpsi1**2 + dpsi2**2) + M/2*((dx - d*sin(alpha)*dalpha)**2 + (dy + d*cos(alpha)*dalpha)**2)"
        " + k*cos(alpha - theta)",
        {"lateral": "-sin(theta)*dx + cos(theta)*dy",
         "wheel1": "dx*cos(theta) + dy*sin(theta) + c*dtheta + R*dpsi1",
         "wheel2": "dx*cos(theta) + dy*sin(theta) - c*dtheta + R*dpsi2",
         "drive1": "dpsi1 - W1*(1 + E*sin(w*t))",
         "drive2": "dpsi2 - W2*cos(w*t)"},
        solve={"psi1": "W1*(1 + E*sin(w*t))", "psi2": "W2*cos(w*t)", "x": "-R/2*(dpsi1 + dpsi2)*cos(theta)",
               "y": "-R/2*(dpsi1 + dpsi2)*sin(theta)", "theta": "R/(2*c)*(dpsi2 - dpsi1)"},
    ),
    System(
        "parallel_velocities",
        "Two points on a vertical plane, joined by a spring, whose velocities stay parallel.",
        ["x1", "y1", "x2", "y2"],
        [("ordinary", dict(m1="1.1", m2="2.3", k="1.7", g="0.9")),
         ("no spring", dict(m1="0.4", m2="1.2", k="0", g="0"))],
        "m1/2*(dx1**2 + dy1**2) + m2/2*(dx2**2 + dy2**2) - k/2*((x1 - x2)**2 + (y1 - y2)**2) - g*(m1*y1 + m2*y2)",
        {"parallel": "dx1*dy2 - dy1*dx2"},
        solve={"y2": "dy1*dx2/dx1"},
    ),
    System(
        "constant_speed",
        "A point whose speed is held at c, in an anisotropic harmonic potential (Chetaev).",
        ["x", "y", "z"],
        [("ordinary", dict(m="1.4", c="2.9", k="0.8", g="1.3")), ("slow", dict(m="0.3", c="2.2", k="2.6", g="-0.4"))],
        "m/2*(dx**2 + dy**2 + dz**2) - k/2*(x**2 + 2*y**2 + 3*z**2) - m*g*z",
        {"speed": "dx**2 + dy**2 + dz**2 - c**2"},
        solve={"z": "sqrt(c**2 - dx**2 - dy**2)"},
    ),
    System(
        "growing_speed",
        "A point in a vertical plane whose speed is c*(1 + t) (Chetaev).",
        ["x", "y"],
        [("ordinary", dict(m="1.4", c="1.8", g="1.3")), ("fast", dict(m="0.3", c="3.1", g="9.8"))],
        "m/2*(dx**2 + dy**2) - m*g*y",
        {"speed": "dx**2 + dy**2 - c**2*(1 + t)**2"},
        solve={"y": "-sqrt(c**2*(1 + t)**2 - dx**2)"},
    ),
]

if __name__ == "__main__":
    for system in SYSTEMS:
        write(system)
        print(system.name)
