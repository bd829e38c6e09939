"""C for one system of the benchmark by CasADi: Kane's equations with partial velocities.

    python casadi_peer.py <system> typed|expert|jacobian <file.c>

`typed`: all speeds with multipliers, the saddle system and the dependent speeds solved symbolically by
CasADi, by QR or LDL, whichever takes fewer operations. `expert`: the dependent speeds put in by hand, or the
accelerations written out; of several formulations and ways to solve for the accelerations, the one of the fewest
operations. `jacobian`: the derivative with the non-zeros of its Jacobian by state and inputs, after an expert: through
the solution, or by the derivatives of the balance of forces, which the same factors solve; again what has the fewest
operations.
"""

import itertools
import sys
import time
from types import SimpleNamespace

import casadi
from casadi import SX, jacobian, jtimes, substitute, vertcat

from pieces import factorised, three_by_three, two_by_two
from systems import SYSTEMS

# CasADi names every intermediate result anyway
TOOL = SimpleNamespace(sin=casadi.sin, cos=casadi.cos, sqrt=casadi.sqrt, named=lambda value: value)


def symbols(names):
    return SimpleNamespace(**{name: SX.sym(name) for name in names.split()})


def stacked(values):
    return vertcat(*values) if values else SX(0, 1)


def cross(a, b):
    return vertcat(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def tensor(moments):
    if len(moments) == 3:
        return casadi.diag(vertcat(*map(SX, moments)))
    xx, yy, zz, xy, yz, zx = moments
    return casadi.blockcat([[SX(xx), xy, zx], [xy, SX(yy), yz], [zx, yz, SX(zz)]])


def substituted(e, symbols, values):
    return substitute(e, symbols, values) if symbols.numel() else e


class Description:
    """A system in symbols, by all its speeds or by those that an expert keeps."""

    def __init__(self, system, by_expert):
        self.system, self.by_expert, self.between = system, by_expert, []
        p, q, u, i = map(symbols, (system.parameters, system.coordinates, system.speeds, system.inputs))
        of = lambda space, names: stacked([getattr(space, name) for name in names.split()])
        self.p, self.q, self.i, self.of, self.all = p, q, i, of, u
        self.coordinates = of(q, system.coordinates)
        self.states = vertcat(self.coordinates, of(u, system.kept))
        self.arguments = [of(p, system.parameters), self.states, of(i, system.inputs)]
        self.speeds, rates = u, system.rates
        if by_expert:
            solved = system.solved(p, q, u) if system.solved else {}
            self.speeds = SimpleNamespace(**({name: getattr(u, name) for name in system.kept.split()} | solved))
            rates = getattr(system, "rates_by_an_expert", rates)
        self.free = of(u, system.kept if by_expert else system.speeds)
        self.rates = stacked(rates(q, self.speeds))

    def via(self, value):
        """A symbol that stands for a value until derivatives have been taken."""
        self.between.append((SX.sym("via"), value))
        return self.between[-1][0]

    def balance(self, bodies=None):
        """Σ ∂v/∂u · m a + ∂ω/∂u · dH/dt − F, or what an expert has written out, and its accelerations."""
        system, free = self.system, self.free
        unknown = SX.sym("du", free.shape[0])
        if bodies is None:
            accelerations = casadi.vertsplit(unknown)
            return stacked(system.balance(self.p, self.q, self.speeds, self.i, accelerations, self.via)), unknown
        along = lambda e: jtimes(e, self.coordinates, self.rates) + jtimes(e, free, unknown)
        balance = SX.zeros(free.shape[0])
        for mass, moments, velocity, axes, spin, *frame in bodies(self.p, self.q, self.speeds):
            velocity, axes, spin = (vertcat(*map(SX, each)) for each in (velocity, axes, spin))
            frame, moments = vertcat(*map(SX, frame[0])) if frame else spin, tensor(moments)
            acceleration = along(velocity) + cross(axes, velocity)
            torque = moments @ along(spin) + cross(frame, moments @ spin)
            balance += jacobian(velocity, free).T @ (mass * acceleration) + jacobian(spin, free).T @ torque
        for name, force in system.forces(self.p, self.q, self.speeds, self.i).items():
            balance -= jacobian(SX(getattr(self.speeds, name)), free).T @ force
        return balance, unknown


def function(description, result):
    derivative = casadi.cse(vertcat(description.rates, result))
    return casadi.Function("casadi_peer", description.arguments, [derivative])


def with_slopes(description, result, slopes=None):
    """The derivative with its Jacobian; of the accelerations it may be known."""
    value, wanted = vertcat(description.rates, result), vertcat(*description.arguments[1:])
    if slopes is None:
        slopes = jacobian(value, wanted)
    else:
        slopes = vertcat(jacobian(description.rates, wanted), slopes)
    return casadi.Function("casadi_peer", description.arguments, casadi.cse([value, slopes]))


def by_ldl(matrix, right):
    """CasADi's L D Lᵀ in the order given: kinetic energy is positive, so that no pivot of it or of what it leaves of
    independent constraints is zero."""
    diagonal, factor, order = casadi.ldl(matrix, False)
    return casadi.ldl_solve(right, diagonal, factor, order)


def with_multipliers(system, slopes, by_symmetry, implicit=False):
    description = Description(system, False)
    balance, unknown = description.balance(system.bodies)
    free, u, of = description.free, description.all, description.of
    mass, rest = jacobian(balance, unknown), substituted(balance, unknown, SX.zeros(*unknown.shape))
    residual = stacked(system.constraints(description.p, description.q, u))
    phi = jacobian(residual, free)
    drift = jtimes(residual, description.coordinates, description.rates)
    k = residual.shape[0]
    saddle = casadi.blockcat([[mass, phi.T], [phi, SX(k, k)]])
    solve = by_ldl if by_symmetry else casadi.solve
    solution = solve(saddle, -vertcat(rest, drift))
    names, kept = system.speeds.split(), system.kept.split()
    result = stacked([solution[names.index(name)] for name in kept])
    if implicit:
        unknown = vertcat(unknown, SX.sym("multiplier", k))
        wanted = vertcat(*description.arguments[1:])
        change = jacobian(saddle @ unknown + vertcat(rest, drift), wanted)
        change = -solve(saddle, substitute(change, unknown, solution))
        return with_slopes(description, result, change[:len(names), :])
    dependent = [name for name in names if name not in kept]
    if dependent:
        which = of(u, " ".join(dependent))
        values = casadi.solve(jacobian(residual, which), -substitute(residual, which, 0))
        result, description.rates = substitute([result, description.rates], [which], [values])
    return (with_slopes if slopes else function)(description, result)


def typed(system, slopes):
    for by_symmetry in (True, False):
        yield lambda by_symmetry=by_symmetry: with_multipliers(system, slopes, by_symmetry)


def reversed_order(f, matrix, right):
    turned = [list(reversed(row)) for row in reversed(matrix)]
    return list(reversed(factorised(f, turned, list(reversed(right)))))


def by_minors(f, matrix, right):
    if len(right) == 2:
        return two_by_two(f, matrix[0][0], matrix[0][1], matrix[1][1], right)
    (a, d, e), (_, b, g), (_, _, c) = matrix
    return three_by_three(f, (a, b, c, d, e, g), right)


def ways_to_solve(size):
    ways = [factorised, reversed_order] + ([by_minors] if size in (2, 3) else [])

    def scalars(way):
        def solve(matrix, right):
            rows = [[matrix[i, j] for j in range(size)] for i in range(size)]
            columns = [way(TOOL, rows, [right[i, k] for i in range(size)]) for k in range(right.shape[1])]
            return casadi.horzcat(*(vertcat(*column) for column in columns))

        return solve

    return [by_ldl] + [scalars(way) for way in ways]


def expert(system, slopes):
    """What makes each of the functions that an expert would try."""
    finished = with_slopes if slopes else function
    if hasattr(system, "explicit"):
        def explicit():
            description = Description(system, True)
            d = description
            return finished(d, stacked(system.explicit(d.p, d.q, d.speeds, d.i)))

        yield explicit
    if system.solved is None:
        if slopes:
            yield lambda: with_multipliers(system, True, True, True)
        return

    def solved(bodies, solve, implicit):
        description = Description(system, True)
        balance, unknown = description.balance(bodies)
        mass, rest = jacobian(balance, unknown), substitute(balance, unknown, 0)
        result = solve(mass, -rest)
        # of accelerations in other coordinates those of the state
        back = lambda rows: vertcat(*system.relative(casadi.vertsplit(rows))) if bodies is None else rows
        between = [stacked(list(each)) for each in zip(*description.between)] or [SX(0, 1)] * 2
        if not implicit:
            return finished(description, substituted(back(result), *between))
        # of M(x) u̇ + h(x, u̇) = 0 by x, with u̇ as it is found
        wanted = vertcat(*description.arguments[1:])
        change = jacobian(balance, wanted) + jacobian(balance, between[0]) @ jacobian(between[1], wanted)
        change = -solve(mass, substitute(change, unknown, result))
        return finished(description, *(substituted(back(each), *between) for each in (result, change)))

    forms = [system.bodies]
    forms += [system.bodies_by_an_expert] if hasattr(system, "bodies_by_an_expert") else []
    forms += [None] if hasattr(system, "balance") else []
    for form, way in itertools.product(forms, ways_to_solve(len(system.kept.split()))):
        yield lambda form=form, way=way: solved(form, way, False)
        if slopes:
            yield lambda form=form, way=way: solved(form, way, True)


def operations(made):
    """Operations of a function, a sine for thirty."""
    heavy = {casadi.OP_SIN, casadi.OP_COS}
    none = {casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST}
    kinds = [made.instruction_id(k) for k in range(made.n_instructions())]
    return sum(30 if kind in heavy else 0 if kind in none else 1 for kind in kinds)


def best(makers):
    """The function of the fewest operations, and the milliseconds that this one took."""
    made = []
    for maker in makers:
        start = time.perf_counter()
        candidate = maker()
        made.append((operations(candidate), (time.perf_counter() - start) * 1e3, candidate))
    return min(made, key=lambda each: each[0])


def main(name, style, path):
    system, slopes = SYSTEMS[name](TOOL), style == "jacobian"
    _, duration, function = best((typed if style == "typed" else expert)(system, slopes))
    print(f"{duration:.1f}")
    generator = casadi.CodeGenerator("peer.c")
    generator.add(function)
    with open(path, "w") as file:
        # in one function with what calls it no argument can be missing, which CasADi's C looks for
        file.write("#define CASADI_SYMBOL_EXPORT static inline\n" + generator.dump())
        file.write(f"""
{values(function) if function.n_out() > 1 else ""}
__attribute__((nonnull)) void peer(const double *restrict p, const double *restrict x, const double *restrict u,
                                   double *restrict dx) {{
  const double *arg[{function.sz_arg()}] = {{p, x, u}};
  double *res[{function.sz_res()}] = {{{"dx, values" if function.n_out() > 1 else "dx"}}};
  casadi_int iw[{max(1, function.sz_iw())}];
  double w[{max(1, function.sz_w())}];
  casadi_peer(arg, res, iw, w, 0);
}}
""")


def values(function):
    """Where the entries of the Jacobian go, and a function that prints all of it, row by row."""
    pattern = function.sparsity_out(1)
    places = [-1] * pattern.numel()
    for place, (row, column) in enumerate(zip(*pattern.get_triplet())):
        places[row * pattern.columns() + column] = place
    return f"""#include <stdio.h>
static double values[{pattern.nnz()}];
void print_jacobian(void) {{
  static const int places[{len(places)}] = {{{", ".join(map(str, places))}}};
  for (int i = 0; i < {len(places)}; i++) printf("%.17g\\n", places[i] < 0 ? 0.0 : values[places[i]]);
}}
"""


if __name__ == "__main__":
    main(*sys.argv[1:])
