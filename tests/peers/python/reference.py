"""The end of both runs to 30 digits: Taylor series of order 40 in 45-digit arithmetic.

Nothing is shared with the project but the equations of motion, written down from Newton and Euler.
`python reference.py` prints what stands in `src/problem.rs`.
"""

from mpmath import mp, mpf, matrix, lu_solve

mp.dps = 45
ORDER = 40


def conv(a, b, k):
    return sum(a[j] * b[k - j] for j in range(k + 1))


def cross(a, b, k):
    return [
        conv(a[1], b[2], k) - conv(a[2], b[1], k),
        conv(a[2], b[0], k) - conv(a[0], b[2], k),
        conv(a[0], b[1], k) - conv(a[1], b[0], k),
    ]


def advance(rates, x, t_end, h):
    """Fixed steps of length h; `rates(series, k, memory)` gives the coefficients of order k of the rates."""
    steps = int(mpf(t_end) / h)
    for _ in range(steps):
        series, memory = [[v] for v in x], {}
        for k in range(ORDER):
            for s, rate in zip(series, rates(series, k, memory)):
                s.append(rate / (k + 1))
        x = []
        for s in series:
            value = mpf(0)
            for c in reversed(s):
                value = value * h + c
            x.append(value)
    return x


def sleigh(x, k, memory):
    m, J, a, b = mpf("1.5"), mpf("0.8"), mpf("0.35"), mpf("-0.2")
    theta, _, _, omega, v = x
    sin, cos = memory.setdefault("sin", []), memory.setdefault("cos", [])
    if k == 0:
        sin.append(mp.sin(theta[0])), cos.append(mp.cos(theta[0]))
    else:
        sin.append(sum(j * theta[j] * cos[k - j] for j in range(1, k + 1)) / k)
        cos.append(-sum(j * theta[j] * sin[k - j] for j in range(1, k + 1)) / k)
    # the centre of mass at (a, b): its velocity is (v - b omega, a omega); angular momentum about the contact
    turning = conv(omega, [p - b * q for p, q in zip(v, omega)], k)
    # (J + m a^2) omega' = -m a omega (v - b omega), v' - b omega' = a omega^2
    omega_dot = -m * a * turning / (J + m * a * a)
    v_dot = a * conv(omega, omega, k) + b * omega_dot
    return [omega[k], conv(v, cos, k), conv(v, sin, k), omega_dot, v_dot]


def veselova(x, k, memory):
    inertia = mp.diag([mpf("2.1"), mpf("2.8"), mpf("3.3")])
    c = [mpf("0.9"), mpf("-0.4"), mpf("1.7")]
    g, w = x[:3], x[3:]
    momentum = memory.setdefault("momentum", [[], [], []])
    for i in range(3):
        momentum[i].append(sum(inertia[i, j] * w[j][k] for j in range(3)))
    inverse = memory.get("inverse") or memory.setdefault("inverse", inertia**-1)
    # I w' = I w x w + g x c + lambda g with g . w' = 0 (g' = g x w is orthogonal to w)
    torque = cross(momentum, w, k)
    torque = [
        torque[0] + g[1][k] * c[2] - g[2][k] * c[1],
        torque[1] + g[2][k] * c[0] - g[0][k] * c[2],
        torque[2] + g[0][k] * c[1] - g[1][k] * c[0],
    ]
    free = [sum(inverse[i, j] * torque[j] for j in range(3)) for i in range(3)]
    spread = [sum(inverse[i, j] * g[j][k] for j in range(3)) for i in range(3)]
    for name, values in (("free", free), ("spread", spread)):
        for s, v in zip(memory.setdefault(name, [[], [], []]), values):
            s.append(v)
    up = sum(conv(g[i], memory["free"][i], k) for i in range(3))
    down = memory.setdefault("down", [])
    down.append(sum(conv(g[i], memory["spread"][i], k) for i in range(3)))
    # lambda = -up / down
    multiplier = memory.setdefault("lambda", [])
    known = sum(multiplier[j] * down[k - j] for j in range(k))
    multiplier.append((-up - known) / down[0])
    w_dot = [free[i] + conv(multiplier, memory["spread"][i], k) for i in range(3)]
    return cross(g, w, k) + w_dot


def show(name, x):
    print(name, ", ".join(mp.nstr(v, 30) for v in x), flush=True)


if __name__ == "__main__":
    start = ["0.3", "0", "0", "1.1", "-0.6"]
    show("sleigh, T = 20:", advance(sleigh, [mpf(v) for v in start], 20, mpf(1) / 8))
    g = [mpf("14") / 15, mpf("2") / 15, mpf("1") / 3]
    start = g + [mpf("0.6"), mpf("-1.1"), mpf("-1.24")]
    show("Veselova, T = 100:", advance(veselova, start, 100, mpf(1) / 8))
