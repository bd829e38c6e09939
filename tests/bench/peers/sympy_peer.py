"""C for one system of the benchmark by SymPy: KanesMethod, then `cse`.

    python sympy_peer.py <system> typed|expert <file.c>

`typed`: dependent speeds and their constraints are given to KanesMethod. `expert`: the dependent speeds
are put in by hand. Mass matrices are solved symbolically after `cse` has named their entries.
"""

import sys
import time
from types import SimpleNamespace

import sympy
from sympy import Matrix, Symbol, cse, symbols
from sympy.physics.mechanics import (
    KanesMethod, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia)

from systems import SYSTEMS


def space(names, make):
    return SimpleNamespace(**{name: make(name) for name in names.split()})


def vector(frame, components):
    return sum((c * axis for c, axis in zip(components, (frame.x, frame.y, frame.z))), 0 * frame.x)


def solved(matrix, right, prefix):
    """The solution with the entries named first, so that the formulas of elimination stay short."""
    names, values = [], []

    def named(entry):
        if entry.is_Number or entry.is_Symbol:
            return entry
        names.append(Symbol(f"{prefix}{len(names)}"))
        values.append(entry)
        return names[-1]

    matrix, right = matrix.applyfunc(named), right.applyfunc(named)
    return matrix.LUsolve(right), list(zip(names, values))


def derivative(system, by_expert):
    p, i = space(system.parameters, Symbol), space(system.inputs, Symbol)
    q, u = space(system.coordinates, dynamicsymbols), space(system.speeds, dynamicsymbols)
    names, kept = system.speeds.split(), system.kept.split()
    speeds = u
    if by_expert:
        speeds = SimpleNamespace(**({name: getattr(u, name) for name in kept} | system.solved(p, q, u)))
    newton, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(newton, 0)
    bodies = getattr(system, "bodies_by_an_expert", system.bodies) if by_expert else system.bodies
    parts = []
    for k, (mass, moments, velocity, axes, spin) in enumerate(bodies(p, q, speeds)):
        frame, own, point = ReferenceFrame(f"A{k}"), ReferenceFrame(f"B{k}"), Point(f"P{k}")
        frame.set_ang_vel(newton, vector(frame, axes))
        own.set_ang_vel(newton, vector(own, spin))
        point.set_vel(newton, vector(frame, velocity))
        if any(moments):
            parts.append(RigidBody(f"body{k}", point, own, mass, (inertia(own, *moments), point)))
        else:
            parts.append(Particle(f"body{k}", point, mass))
    rates = system.rates(q, speeds)
    coordinates = [getattr(q, name) for name in system.coordinates.split()]
    kinematic = [c.diff() - rate for c, rate in zip(coordinates, rates)]
    if by_expert or not system.constraints(p, q, u):
        independent, dependent, constraints = kept, [], None
    else:
        residuals = system.constraints(p, q, u)
        choice = {"veselova": ["w3"]}
        dependent = [name for name in names if name not in kept] or choice["veselova"]
        independent = [name for name in names if name not in dependent]
        constraints = Matrix(residuals)
    method = KanesMethod(
        newton, coordinates, [getattr(u, name) for name in independent], kd_eqs=kinematic,
        u_dependent=[getattr(u, name) for name in dependent], velocity_constraints=constraints)
    method.kanes_equations(parts, [])
    forcing = Matrix(method.forcing)
    forces = system.forces(p, q, speeds, i)
    applied = Matrix([forces.get(name, 0) for name in independent])
    if by_expert:
        # of a force on a dependent speed what the speeds put in leave
        for row, kept_speed in enumerate(independent):
            for name, force in forces.items():
                if name not in independent:
                    share = sympy.diff(getattr(speeds, name), getattr(u, kept_speed))
                    applied[row] += share * force
    if dependent:
        applied += method._Ars.T * Matrix([forces.get(name, 0) for name in dependent])
    for row, force in enumerate(applied):
        forcing[row] += force
    accelerations, definitions = solved(Matrix(method.mass_matrix), forcing, "mass")
    order = independent + dependent
    outputs = rates + [accelerations[order.index(name)] for name in kept]
    values, more = {}, []
    if dependent and set(dependent).isdisjoint(kept):
        which = [getattr(u, name) for name in dependent]
        residuals = Matrix(constraints)
        found, more = solved(residuals.jacobian(which), -residuals.subs(dict.fromkeys(which, 0)), "wheel")
        values = dict(zip(which, found))
    plain = {getattr(s, n): Symbol(n) for s, list_ in ((q, system.coordinates), (u, system.speeds)) for n in list_.split()}
    dependents = [(Symbol(str(which.func)), value.subs(plain)) for which, value in values.items()]
    return p, [(name, e.subs(plain)) for name, e in more], dependents, \
        [(name, e.subs(plain)) for name, e in definitions], [sympy.sympify(e).subs(plain) for e in outputs]


def main(name, style, path):
    system = SYSTEMS[name](sympy)
    start = time.perf_counter()
    p, *named, outputs = derivative(system, style == "expert")
    named = [pair for group in named for pair in group]
    temporaries = (Symbol(f"t{k}") for k in range(10**6))
    steps, reduced = cse([e for _, e in named] + outputs, symbols=temporaries)
    # definitions in the order in which they depend on each other
    lines, done = [], set()
    available = dict(steps)
    available.update(zip((n for n, _ in named), reduced))

    def define(symbol):
        if symbol in done or symbol not in available:
            return
        done.add(symbol)
        for operand in sorted(available[symbol].free_symbols, key=str):
            define(operand)
        lines.append(f"  const double {symbol} = {sympy.ccode(available[symbol])};")

    results = reduced[len(named):]
    for result in results:
        for operand in sorted(result.free_symbols, key=str):
            define(operand)
    print(f"{(time.perf_counter() - start) * 1e3:.1f}")
    names = [("p_", system.parameters), ("x_", f"{system.coordinates} {system.kept}"), ("u_", system.inputs)]
    loads = [f"  const double {n} = {array}[{k}];" for array, list_ in names for k, n in enumerate(list_.split())]
    stores = [f"  dx_[{k}] = {sympy.ccode(result)};" for k, result in enumerate(results)]
    with open(path, "w") as file:
        file.write("#include <math.h>\n"
                   "void peer(const double *restrict p_, const double *restrict x_, const double *restrict u_, "
                   "double *restrict dx_) {\n" + "\n".join(loads + lines + stores) + "\n}\n")


main(*sys.argv[1:])
