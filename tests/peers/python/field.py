"""heyoka and SciPy on the same two runs: microseconds to reach given accuracies at the end.

    python -m venv /tmp/peers && /tmp/peers/bin/pip install -r requirements.txt && /tmp/peers/bin/python field.py

heyoka compiles when an integrator is made: that time is shown apart. SciPy's right-hand side is Python.
"""

import time

import heyoka as hy
import numpy as np
from scipy.integrate import solve_ivp

ACCURACIES = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12]
TOLERANCES = [10 ** (-k / 2) for k in range(4, 30)]


def sleigh_rates(x, sin, cos, m, J, a, b):
    theta, _, _, omega, v = x
    turn = -m * a * omega * (v - b * omega) / (J + m * a * a)
    return [omega, v * cos(theta), v * sin(theta), turn, a * omega * omega + b * turn]


def veselova_rates(x, I, c):
    g, w = x[:3], x[3:]
    k = [
        (I[1] - I[2]) * w[1] * w[2] + g[1] * c[2] - g[2] * c[1],
        (I[2] - I[0]) * w[2] * w[0] + g[2] * c[0] - g[0] * c[2],
        (I[0] - I[1]) * w[0] * w[1] + g[0] * c[1] - g[1] * c[0],
    ]
    s = [g[i] / I[i] for i in range(3)]
    pull = -(s[0] * k[0] + s[1] * k[1] + s[2] * k[2]) / (g[0] * s[0] + g[1] * s[1] + g[2] * s[2])
    return [
        g[1] * w[2] - g[2] * w[1],
        g[2] * w[0] - g[0] * w[2],
        g[0] * w[1] - g[1] * w[0],
        *[(k[i] + pull * g[i]) / I[i] for i in range(3)],
    ]


RUNS = {
    "sleigh": (
        20.0,
        [0.3, 0.0, 0.0, 1.1, -0.6],
        [1.5, 0.8, 0.35, -0.2],
        lambda x, p, sin, cos: sleigh_rates(x, sin, cos, *p),
        [4.867242701758369, -0.5919840513152261, -15.542084728666937, 0.00011734379580648774, 0.9684590165253134],
    ),
    "veselova": (
        100.0,
        [14 / 15, 2 / 15, 1 / 3, 0.6, -1.1, -1.24],
        [2.1, 2.8, 3.3, 0.9, -0.4, 1.7],
        lambda x, p, sin, cos: veselova_rates(x, p[:3], p[3:]),
        [-0.8968355415311274, -0.05129684593886489, 0.4393798414166197, -0.674143014110514, 1.4987453618993315,
         -1.2010439611814427],
    ),
}


def shortest(run, seconds):
    best, begin = float("inf"), time.perf_counter()
    while True:
        start = time.perf_counter()
        end = run()
        best = min(best, time.perf_counter() - start)
        if time.perf_counter() - begin > seconds:
            return best * 1e6, end


def with_heyoka(name, tolerance):
    to, start, values, rates, _ = RUNS[name]
    x = hy.make_vars(*[f"x{i}" for i in range(len(start))])
    p = [hy.par[i] for i in range(len(values))]
    begin = time.perf_counter()
    sim = hy.taylor_adaptive(list(zip(x, rates(x, p, hy.sin, hy.cos))), start, pars=values, tol=tolerance)
    compiled = time.perf_counter() - begin

    def run():
        sim.time = 0.0
        sim.state[:] = start
        sim.propagate_until(to)
        return sim.state.copy()

    return (*shortest(run, 0.2), compiled)


def with_scipy(name, tolerance):
    to, start, values, rates, _ = RUNS[name]
    f = lambda t, x: rates(x, values, np.sin, np.cos)
    run = lambda: solve_ivp(f, (0.0, to), start, method="DOP853", rtol=max(tolerance, 2.3e-14), atol=tolerance).y[:, -1]
    return (*shortest(run, 0.2), 0.0)


for name, (*_, reference) in RUNS.items():
    for library, solve in (("heyoka", with_heyoka), ("SciPy DOP853", with_scipy)):
        runs = []
        for tolerance in TOLERANCES:
            microseconds, end, compiled = solve(name, tolerance)
            runs.append((microseconds, float(np.max(np.abs(end - reference))), compiled))
        cells = []
        for accuracy in ACCURACIES:
            # as good with the next finer tolerances too
            good = [i for i in range(len(runs)) if all(error <= accuracy for _, error, _ in runs[i : i + 4])]
            best = min((runs[i][0] for i in good), default=None)
            cells.append("-" if best is None else f"{best:.1f}")
        compiling = max(compiled for *_, compiled in runs)
        print(f"{name:10} {library:14}", *[f"{cell:>10}" for cell in cells], f"  compilation up to {compiling:.1f} s", flush=True)
