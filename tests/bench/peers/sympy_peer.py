"""C for one system of the benchmark by SymPy: KanesMethod, then `cse`.

    python sympy_peer.py <system> typed|expert <file.c>

`typed`: dependent speeds and their constraints are given to KanesMethod. `expert`: the dependent speeds
are put in by hand, or the accelerations are written out; of several formulations and ways to solve for the
accelerations, the one of the fewest operations. Mass matrices are solved symbolically after `cse` has named their
entries, by SymPy or with names for intermediate results.
"""

import signal
import sys
import time
from types import SimpleNamespace

import sympy
from sympy import Function, Matrix, Symbol, cse
from sympy.codegen.rewriting import create_expand_pow_optimization
from sympy.physics.mechanics import (
    KanesMethod, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia)

from pieces import factorised, three_by_three, two_by_two
from systems import SYSTEMS

# the seconds that a formulation may take when there is another
ENOUGH = 20
# C has no powers
products = create_expand_pow_optimization(8, base_req=lambda base: True)
root = Function("root")


def with_roots(e):
    """Powers with halves as powers of a root, which is computed once."""
    halves = lambda part: part.is_Pow and part.exp.is_Rational and part.exp.q == 2
    return e.replace(halves, lambda part: root(part.base) ** part.exp.p)


def space(names, make):
    return SimpleNamespace(**{name: make(name) for name in names.split()})


def vector(frame, components):
    return sum((c * axis for c, axis in zip(components, (frame.x, frame.y, frame.z))), 0 * frame.x)


class Names:
    """Names of intermediate results, the same one for the same result."""

    def __init__(self, prefix):
        self.prefix, self.names = prefix, {}

    def __call__(self, entry):
        entry = sympy.sympify(entry)
        if entry.is_Number or entry.is_Symbol:
            return entry
        return self.names.setdefault(entry, Symbol(f"{self.prefix}{len(self.names)}"))

    def definitions(self):
        return [(name, value) for value, name in self.names.items()]


def tool(named):
    return SimpleNamespace(sin=sympy.sin, cos=sympy.cos, sqrt=sympy.sqrt, named=named)


def by_sympy(matrix, right, named):
    return list(matrix.LUsolve(right))


def by_elimination(matrix, right, named):
    """Gauss's, with a name for every intermediate result."""
    rows = [list(row) + [value] for row, value in zip(matrix.tolist(), right)]
    for k in range(len(rows)):
        pivot = next(row for row in rows[k:] if row[k] != 0)
        rows.remove(pivot)
        rows.insert(k, pivot)
        for row in rows[k + 1:]:
            if row[k] != 0:
                share = named(row[k] / pivot[k])
                row[k + 1:] = [named(a - share * b) for a, b in zip(row[k + 1:], pivot[k + 1:])]
    found = []
    for k in reversed(range(len(rows))):
        rest = rows[k][-1] - sum(a * b for a, b in zip(rows[k][k + 1:-1], found))
        found.insert(0, named(rest / rows[k][k]))
    return found


def by_factors(matrix, right, named):
    return factorised(tool(named), matrix.tolist(), list(right))


def by_factors_from_the_last(matrix, right, named):
    turned = [list(reversed(row)) for row in reversed(matrix.tolist())]
    return list(reversed(factorised(tool(named), turned, list(reversed(right)))))


def by_minors(matrix, right, named):
    if len(right) == 2:
        return two_by_two(tool(named), matrix[0, 0], matrix[0, 1], matrix[1, 1], list(right))
    (a, d, e), (_, b, g), (_, _, c) = matrix.tolist()
    return three_by_three(tool(named), (a, b, c, d, e, g), list(right))


def solved(matrix, right, prefix, way=by_sympy):
    """The solution with the entries named first, so that the formulas of elimination stay short."""
    named = Names(prefix)
    matrix, right = Matrix(matrix).applyfunc(named), Matrix(right).applyfunc(named)
    return list(way(matrix, right, named)), named.definitions()


def plain_names(system, q, u):
    pairs = ((q, system.coordinates), (u, system.speeds))
    return {getattr(s, n): Symbol(n) for s, list_ in pairs for n in list_.split()}


def motion(system, by_expert):
    """What KanesMethod makes of a system, with what it takes to solve for the accelerations."""
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
    for k, (mass, moments, velocity, axes, spin, *turning) in enumerate(bodies(p, q, speeds)):
        frame, own, point = ReferenceFrame(f"A{k}"), ReferenceFrame(f"B{k}"), Point(f"P{k}")
        frame.set_ang_vel(newton, vector(frame, axes))
        principal = own
        if turning:
            # axes of the inertia that do not turn with the body
            principal = ReferenceFrame(f"C{k}")
            principal.set_ang_vel(newton, vector(principal, turning[0]))
            own.set_ang_vel(principal, vector(principal, [a - b for a, b in zip(spin, turning[0])]))
        else:
            own.set_ang_vel(newton, vector(own, spin))
        point.set_vel(newton, vector(frame, velocity))
        if any(moments):
            parts.append(RigidBody(f"body{k}", point, own, mass, (inertia(principal, *moments), point)))
        else:
            parts.append(Particle(f"body{k}", point, mass))
    rates = (getattr(system, "rates_by_an_expert", system.rates) if by_expert else system.rates)(q, speeds)
    coordinates = [getattr(q, name) for name in system.coordinates.split()]
    kinematic = [c.diff() - rate for c, rate in zip(coordinates, rates)]
    if by_expert or not system.constraints(p, q, u):
        independent, dependent, constraints = kept, [], None
    else:
        dependent = [name for name in names if name not in kept] or system.dependent.split()
        independent = [name for name in names if name not in dependent]
        constraints = Matrix(system.constraints(p, q, u))
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
    values, more = {}, []
    if dependent and set(dependent).isdisjoint(kept):
        which = [getattr(u, name) for name in dependent]
        residuals = Matrix(constraints)
        found, more = solved(residuals.jacobian(which), -residuals.subs(dict.fromkeys(which, 0)), "wheel")
        values = dict(zip(which, found))
    plain = plain_names(system, q, u)
    dependents = [(Symbol(str(which.func)), value.subs(plain)) for which, value in values.items()]
    named = [(name, e.subs(plain)) for name, e in more] + dependents
    order = independent + dependent
    return named, rates, Matrix(method.mass_matrix), forcing, [order.index(name) for name in kept], plain


def derivative(parts, way):
    named, rates, mass, forcing, places, plain = parts
    accelerations, definitions = solved(mass, forcing, "mass", way)
    outputs = rates + [accelerations[place] for place in places]
    return named + [(name, e.subs(plain)) for name, e in definitions], \
        [sympy.sympify(e).subs(plain) for e in outputs]


def explicit(make):
    """Accelerations that an expert has written out, with the intermediate results that bear names in them."""
    named = Names("part")
    system = make(tool(named))
    p, q, u, i = (space(names, Symbol) for names in (
        system.parameters, system.coordinates, system.speeds, system.inputs))
    if system.solved:
        u = SimpleNamespace(**(vars(u) | system.solved(p, q, u)))
    rates = getattr(system, "rates_by_an_expert", system.rates)(q, u)
    outputs = rates + list(system.explicit(p, q, u, i))
    return named.definitions(), [sympy.sympify(e) for e in outputs]


def lines(definitions, outputs):
    """Lines of C in the order in which they depend on each other, and the results."""
    temporaries = (Symbol(f"t{k}") for k in range(10**6))
    steps, reduced = cse([with_roots(e) for e in [e for _, e in definitions] + outputs], symbols=temporaries)
    available = dict(steps)
    available.update(zip((n for n, _ in definitions), reduced))
    ordered, done = [], set()

    def define(symbol):
        if symbol in done or symbol not in available:
            return
        done.add(symbol)
        for operand in sorted(available[symbol].free_symbols, key=str):
            define(operand)
        ordered.append((symbol, available[symbol]))

    results = reduced[len(definitions):]
    for result in results:
        for operand in sorted(result.free_symbols, key=str):
            define(operand)
    return ordered, results


def operations(made):
    """A sine for thirty."""
    ordered, results = made
    all = [value for _, value in ordered] + list(results)
    sines = sum(value.count(lambda e: isinstance(e, (sympy.sin, sympy.cos))) for value in all)
    return sum(value.count_ops() for value in all) + 30 * sines


def ways_to_solve(style, size):
    if style == "typed":
        return [by_elimination, by_sympy]
    return [by_factors, by_factors_from_the_last] + ([by_minors] if size in (2, 3) else [])


def out_of_time(*_):
    raise TimeoutError


def best(name, style):
    """The program of the fewest operations, and the milliseconds that this one took."""
    began, found = time.perf_counter(), []
    signal.signal(signal.SIGALRM, out_of_time)
    system = SYSTEMS[name](tool(lambda value: value))
    if style == "expert" and hasattr(system, "explicit"):
        found.append((lines(*explicit(SYSTEMS[name])), time.perf_counter() - began))
    if found:
        signal.alarm(ENOUGH)
    try:
        if style == "typed" or system.solved is not None:
            start = time.perf_counter()
            parts = motion(system, style == "expert")
            taken = time.perf_counter() - start
            for way in ways_to_solve(style, parts[3].shape[0]):
                start = time.perf_counter()
                found.append((lines(*derivative(parts, way)), taken + time.perf_counter() - start))
                signal.alarm(ENOUGH)
    except TimeoutError:
        pass
    signal.alarm(0)
    return min(found, key=lambda each: operations(each[0]))


def main(name, style, path):
    system = SYSTEMS[name](tool(None))
    (ordered, results), taken = best(name, style)
    print(f"{taken * 1e3:.1f}")
    names = [("p_", system.parameters), ("x_", f"{system.coordinates} {system.kept}"), ("u_", system.inputs)]
    code = lambda value: sympy.ccode(products(value), user_functions={"root": "sqrt"})
    loads = [f"  const double {n} = {array}[{k}];" for array, list_ in names for k, n in enumerate(list_.split())]
    steps = [f"  const double {symbol} = {code(value)};" for symbol, value in ordered]
    stores = [f"  dx_[{k}] = {code(result)};" for k, result in enumerate(results)]
    with open(path, "w") as file:
        file.write("#include <math.h>\n"
                   "void peer(const double *restrict p_, const double *restrict x_, const double *restrict u_, "
                   "double *restrict dx_) {\n" + "\n".join(loads + steps + stores) + "\n}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
