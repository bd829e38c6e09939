"""C for one system of the benchmark by CasADi: Kane's equations with partial velocities.

    python casadi_peer.py <system> typed|expert|jacobian <file.c>

`typed`: all speeds with multipliers, the saddle system and the dependent speeds solved symbolically by
CasADi. `expert`: the dependent speeds put in by hand. `jacobian`: the derivative with the non-zeros of its Jacobian by
state and inputs, after an expert where there is an elimination by hand.
"""

import sys
from types import SimpleNamespace

import casadi
from casadi import SX, jacobian, jtimes, vertcat

from systems import SYSTEMS


def symbols(names):
    return SimpleNamespace(**{name: SX.sym(name) for name in names.split()})


def stacked(values):
    return vertcat(*values) if values else SX(0, 1)


def cross(a, b):
    return vertcat(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def derivative(system, by_expert):
    p, q, u, i = map(symbols, (system.parameters, system.coordinates, system.speeds, system.inputs))
    kept = system.kept.split()
    of = lambda space, names: stacked([getattr(space, name) for name in names.split()])
    states = vertcat(of(q, system.coordinates), of(u, system.kept))
    speeds = u
    if by_expert:
        values = {name: getattr(u, name) for name in kept} | system.solved(p, q, u)
        speeds = SimpleNamespace(**values)
    free = of(u, system.kept) if by_expert else of(u, system.speeds)
    coordinates = of(q, system.coordinates)
    rates = stacked(system.rates(q, speeds))
    # Σ ∂v/∂u · m a + ∂ω/∂u · dH/dt = F, with u̇ taken out
    unknown = SX.sym("du", free.shape[0])
    along = lambda e: jtimes(e, coordinates, rates) + jtimes(e, free, unknown)
    bodies = getattr(system, "bodies_by_an_expert", system.bodies) if by_expert else system.bodies
    balance = SX.zeros(free.shape[0])
    for mass, moments, velocity, axes, spin in bodies(p, q, speeds):
        velocity, axes, spin, moments = (vertcat(*map(SX, each)) for each in (velocity, axes, spin, moments))
        acceleration = along(velocity) + cross(axes, velocity)
        torque = moments * along(spin) + cross(spin, moments * spin)
        balance += jacobian(velocity, free).T @ (mass * acceleration) + jacobian(spin, free).T @ torque
    forces = system.forces(p, q, speeds, i)
    for name, force in forces.items():
        balance -= jacobian(SX(getattr(speeds, name)), free).T @ force
    mass = jacobian(balance, unknown)
    rest = casadi.substitute(balance, unknown, 0)
    if by_expert:
        result = casadi.solve(mass, -rest)
    else:
        residual = stacked(system.constraints(p, q, u))
        phi = jacobian(residual, free)
        drift = jtimes(residual, coordinates, rates)
        k = residual.shape[0]
        saddle = casadi.blockcat([[mass, -phi.T], [phi, SX(k, k)]])
        solution = casadi.solve(saddle, -vertcat(rest, drift))
        names = system.speeds.split()
        result = stacked([solution[names.index(name)] for name in kept])
        dependent = [name for name in names if name not in kept]
        if dependent:
            which = of(u, " ".join(dependent))
            values = casadi.solve(jacobian(residual, which), -casadi.substitute(residual, which, 0))
            result, rates = casadi.substitute([result, rates], [which], [values])
    derivative = casadi.cse(vertcat(rates, result))
    arguments = [of(p, system.parameters), states, of(i, system.inputs)]
    return casadi.Function("casadi_peer", arguments, [derivative])


def with_jacobian(name):
    try:
        function = derivative(SYSTEMS[name](casadi), True)
    except Exception:
        # there is no elimination by hand that is valid everywhere
        function = derivative(SYSTEMS[name](casadi), False)
    arguments = [function.sx_in(index) for index in range(3)]
    value = function(*arguments)
    slopes = jacobian(value, vertcat(*arguments[1:]))
    return casadi.Function("casadi_peer", arguments, casadi.cse([value, slopes]))


def main(name, style, path):
    import time
    start = time.perf_counter()
    function = with_jacobian(name) if style == "jacobian" else derivative(SYSTEMS[name](casadi), style == "expert")
    print(f"{(time.perf_counter() - start) * 1e3:.1f}")
    generator = casadi.CodeGenerator("peer.c")
    generator.add(function)
    width = max(1, function.sz_w())
    with open(path, "w") as file:
        file.write(generator.dump())
        file.write(f"""
void peer(const double *p, const double *x, const double *u, double *dx) {{
  const double *arg[{function.sz_arg()}] = {{p, x, u}};
  {"static double values[%d];" % function.nnz_out(1) if function.n_out() > 1 else ""}
  double *res[{function.sz_res()}] = {{{"dx, values" if function.n_out() > 1 else "dx"}}};
  casadi_int iw[{max(1, function.sz_iw())}];
  double w[{width}];
  casadi_peer(arg, res, iw, w, 0);
}}
""")


main(*sys.argv[1:])
