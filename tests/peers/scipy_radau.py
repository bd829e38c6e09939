"""What SciPy's Radau takes for the same error as the code RADAU5, on the six problems of nh-runtime/tests/stiff.

    pip install scipy && python3 tests/peers/scipy_radau.py

The solutions and the runs of RADAU5 are read from the files of that test, and the figures are made as there: by the
line of least squares through the logarithms of costs over those of errors from 1e-8 to 1e-3, at its middle. A
factorization is one of a real and one of a complex matrix.
"""

import math
import pathlib
import re

import numpy as np
from scipy.integrate import solve_ivp

STIFF = pathlib.Path(__file__).resolve().parents[2] / "nh-runtime" / "tests" / "stiff"
RANGE = (1e-8, 1e-3)
CELLS = 20
DIFFUSION = 0.02 * 21**2


def numbers(text):
    return [float(number.replace("_", "")) for number in re.findall(r"-?\d[\d_.]*(?:e-?\d+)?", text)]


def solutions():
    """NAME and SOLUTION of each problem."""
    text = (STIFF / "problems.rs").read_text()
    found = {}
    for body in text.split("const NAME: &'static str = ")[1:]:
        name = body.split('"')[1]
        values = re.search(r"const SOLUTION: \[f64; \d+\] =\s*\[(.*?)\];", body, re.S)
        values = values or re.search(r"const BRUSSELATOR_END: \[f64; 40\] = \[(.*?)\];", text, re.S)
        negligible = re.search(r"const NEGLIGIBLE: f64 = ([^;]*);", body.split("system!")[0])
        found[name] = (np.array(numbers(values.group(1))), float(negligible.group(1)) if negligible else 0.0)
    return found


def radau5():
    """The runs of RADAU5: errors, NFCN, NJAC and NDEC."""
    text = (STIFF / "radau5.rs").read_text()
    found = {}
    for block in re.split(r'\n        "', text)[1:]:
        name, rest = block.split('"', 1)
        found[name] = [numbers(f"{error} {costs}") for error, costs in re.findall(r"\(([\d.e-]+), \[([\d_, ]+)\]\)", rest)]
    return found


def van_der_pol(t, y):
    return [y[1], ((1 - y[0] ** 2) * y[1] - y[0]) / 1e-6]


def van_der_pol_jacobian(t, y):
    return [[0, 1], [(-2 * y[0] * y[1] - 1) / 1e-6, (1 - y[0] ** 2) / 1e-6]]


def robertson(t, y):
    first, last = -0.04 * y[0] + 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
    return [first, -first - last, last]


def robertson_jacobian(t, y):
    return [[-0.04, 1e4 * y[2], 1e4 * y[1]], [0.04, -1e4 * y[2] - 6e7 * y[1], -1e4 * y[1]], [0, 6e7 * y[1], 0]]


def oregonator(t, y):
    a, b, c = y
    return [77.27 * (b + a * (1 - 8.375e-6 * a - b)), (c - (1 + a) * b) / 77.27, 0.161 * (a - c)]


def oregonator_jacobian(t, y):
    a, b, _ = y
    return [
        [77.27 * (1 - 2 * 8.375e-6 * a - b), 77.27 * (1 - a), 0],
        [-b / 77.27, -(1 + a) / 77.27, 1 / 77.27],
        [0.161, 0, -0.161],
    ]


def hires(t, y):
    y1, y2, y3, y4, y5, y6, y7, y8 = y
    seventh = 280 * y6 * y8 - 1.81 * y7
    return [
        -1.71 * y1 + 0.43 * y2 + 8.32 * y3 + 0.0007,
        1.71 * y1 - 8.75 * y2,
        -10.03 * y3 + 0.43 * y4 + 0.035 * y5,
        8.32 * y2 + 1.71 * y3 - 1.12 * y4,
        -1.745 * y5 + 0.43 * y6 + 0.43 * y7,
        -280 * y6 * y8 + 0.69 * y4 + 1.71 * y5 - 0.43 * y6 + 0.69 * y7,
        seventh,
        -seventh,
    ]


def hires_jacobian(t, y):
    by_6, by_8 = 280 * y[7], 280 * y[5]
    return [
        [-1.71, 0.43, 8.32, 0, 0, 0, 0, 0],
        [1.71, -8.75, 0, 0, 0, 0, 0, 0],
        [0, 0, -10.03, 0.43, 0.035, 0, 0, 0],
        [0, 8.32, 1.71, -1.12, 0, 0, 0, 0],
        [0, 0, 0, 0, -1.745, 0.43, 0.43, 0],
        [0, 0, 0, 0.69, 1.71, -0.43 - by_6, 0.69, -by_8],
        [0, 0, 0, 0, 0, by_6, -1.81, by_8],
        [0, 0, 0, 0, 0, -by_6, 1.81, -by_8],
    ]


def e5(t, y):
    first, second = 7.89e-10 * y[0], 1.1e7 * y[0] * y[2]
    third, fourth = 1.13e9 * y[1] * y[2], 1.13e3 * y[3]
    f2, f4 = first - third, second - fourth
    return [-first - second, f2, f2 - f4, f4]


def e5_jacobian(t, y):
    a, b, cm, c = 7.89e-10, 1.1e7, 1.13e9, 1.13e3
    return [
        [-a - b * y[2], 0, -b * y[0], 0],
        [a, -cm * y[2], -cm * y[1], 0],
        [a - b * y[2], -cm * y[2], -b * y[0] - cm * y[1], c],
        [b * y[2], 0, b * y[0], -c],
    ]


def brusselator(t, y):
    u = np.concatenate(([1.0], y[0::2], [1.0]))
    v = np.concatenate(([3.0], y[1::2], [3.0]))
    middle_u, middle_v = u[1:-1], v[1:-1]
    f = np.empty_like(y)
    f[0::2] = 1 + middle_u**2 * middle_v - 4 * middle_u + DIFFUSION * (u[:-2] - 2 * middle_u + u[2:])
    f[1::2] = 3 * middle_u - middle_u**2 * middle_v + DIFFUSION * (v[:-2] - 2 * middle_v + v[2:])
    return f


def brusselator_jacobian(t, y):
    matrix = np.zeros((2 * CELLS, 2 * CELLS))
    for i in range(CELLS):
        u, v = y[2 * i], y[2 * i + 1]
        matrix[2 * i, 2 * i] = 2 * u * v - 4 - 2 * DIFFUSION
        matrix[2 * i, 2 * i + 1] = u * u
        matrix[2 * i + 1, 2 * i] = 3 - 2 * u * v
        matrix[2 * i + 1, 2 * i + 1] = -u * u - 2 * DIFFUSION
        for j in (i - 1, i + 1):
            if 0 <= j < CELLS:
                matrix[2 * i, 2 * j] = matrix[2 * i + 1, 2 * j + 1] = DIFFUSION
    return matrix


def cells():
    places = [(i + 1) / (CELLS + 1) for i in range(CELLS)]
    return [number for x in places for number in (1 + math.sin(2 * math.pi * x) / 2, 3.0)]


PROBLEMS = [
    ("VDPOL", van_der_pol, van_der_pol_jacobian, [2, 0], 2.0, lambda rtol: rtol),
    ("ROBER", robertson, robertson_jacobian, [1, 0, 0], 1e11, lambda rtol: 1e-6 * rtol),
    ("OREGO", oregonator, oregonator_jacobian, [1, 2, 3], 360.0, lambda rtol: 1e-6 * rtol),
    ("HIRES", hires, hires_jacobian, [1, 0, 0, 0, 0, 0, 0, 0.0057], 321.8122, lambda rtol: 1e-4 * rtol),
    ("E5", e5, e5_jacobian, [1.76e-3, 0, 0, 0], 1e9, lambda rtol: 1.7e-24),
    ("BRUSS", brusselator, brusselator_jacobian, cells(), 10.0, lambda rtol: rtol),
]


def costs(runs):
    within = [run for run in runs if RANGE[0] <= run[0] <= RANGE[1]]
    if len(within) < 4:
        return None
    errors = np.log10([run[0] for run in within])
    middle = math.log10(RANGE[0] * RANGE[1]) / 2
    return [10 ** np.polyval(np.polyfit(errors, np.log10([run[i] for run in within]), 1), middle) for i in (1, 2, 3)]


def main():
    known, peer = solutions(), radau5()
    print("| | evaluations | to RADAU5 | Jacobians | to RADAU5 | factorizations | to RADAU5 |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    ratios = []
    for name, f, jacobian, start, end, atol in PROBLEMS:
        solution, negligible = known[name]
        runs = []
        for k in range(4, 21):
            rtol = 10 ** (-k / 2)
            run = solve_ivp(f, (0, end), start, "Radau", t_eval=[end], rtol=rtol, atol=atol(rtol), jac=jacobian, first_step=1e-6)
            if run.success:
                error = np.max(np.abs(run.y[:, -1] - solution) / (np.abs(solution) + negligible))
                runs.append((error, run.nfev, run.njev, run.nlu / 2))
        ours, theirs = costs(runs), costs(peer[name])
        if ours is None:
            print(f"| {name} | fewer than four runs reach errors from 1e-8 to 1e-3 | | | | | |")
            continue
        ratios.append([a / b for a, b in zip(ours, theirs)])
        print(f"| {name} | " + " | ".join(f"{a:.0f} | {a / b:.2f}" for a, b in zip(ours, theirs)) + " |")
    means = np.exp(np.mean(np.log(ratios), axis=0))
    print("| geometric mean | " + " | ".join(f"| {mean:.2f}" for mean in means) + " |")


if __name__ == "__main__":
    main()
