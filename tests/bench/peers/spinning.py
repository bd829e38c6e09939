"""Bodies that turn in space, and what turns in them."""

from types import SimpleNamespace

from pieces import attitude, cross, dot, halved, numbered, several


def veselova(f):
    def forces(p, q, u, i):
        return dict(w1=q.g2 * p.c3 - q.g3 * p.c2, w2=q.g3 * p.c1 - q.g1 * p.c3, w3=q.g1 * p.c2 - q.g2 * p.c1)

    def explicit(p, q, u, i):
        # the multiplier keeps g · w, whose rate is g · ẇ since ġ = g × w
        g, w, moments = several(q, "g", 3, 1), several(u, "w", 3, 1), several(p, "I", 3, 1)
        spin = [m * each for m, each in zip(moments, w)]
        free = [f.named(a + b) for a, b in zip(cross(spin, w), cross(g, several(p, "c", 3, 1)))]
        over = [f.named(1 / m) for m in moments]
        along = [f.named(a * b) for a, b in zip(g, over)]
        multiplier = f.named(dot(along, free) / dot(along, g))
        return [a * b - c * multiplier for a, b, c in zip(free, over, along)]

    return SimpleNamespace(
        parameters="I1 I2 I3 c1 c2 c3", coordinates="g1 g2 g3", speeds="w1 w2 w3", kept="w1 w2 w3", dependent="w3",
        inputs="",
        rates=lambda q, u: list(cross(several(q, "g", 3, 1), several(u, "w", 3, 1))),
        bodies=lambda p, q, u: [(0, (p.I1, p.I2, p.I3), (0, 0, 0), (0, 0, 0), (u.w1, u.w2, u.w3))],
        forces=forces,
        explicit=explicit,
        constraints=lambda p, q, u: [q.g1 * u.w1 + q.g2 * u.w2 + q.g3 * u.w3],
        solved=None,
    )


def satellite(f):
    def bodies(p, q, u):
        def wheel(axis):
            moments = [0, 0, 0]
            moments[axis] = (p.J1, p.J2, p.J3)[axis]
            spin = [u.w1, u.w2, u.w3]
            spin[axis] += (u.s1, u.s2, u.s3)[axis]
            return 0, tuple(moments), (0, 0, 0), (0, 0, 0), tuple(spin)

        return [(0, (p.I1, p.I2, p.I3), (0, 0, 0), (0, 0, 0), (u.w1, u.w2, u.w3))] + [wheel(k) for k in range(3)]

    def explicit(p, q, u, i):
        # a wheel's torque is its momentum's rate, and its reaction acts on the rest
        w, s = several(u, "w", 3, 1), several(u, "s", 3, 1)
        moments, wheels, torques = several(p, "I", 3, 1), several(p, "J", 3, 1), several(i, "torque", 3, 1)
        spin = [f.named(m * a + j * (a + b)) for m, j, a, b in zip(moments, wheels, w, s)]
        turned = [f.named((a - b) / m) for a, b, m in zip(cross(spin, w), torques, moments)]
        return turned + [a / j - b for a, j, b in zip(torques, wheels, turned)]

    return SimpleNamespace(
        parameters="I1 I2 I3 J1 J2 J3", coordinates="q0 q1 q2 q3", speeds="w1 w2 w3 s1 s2 s3",
        kept="w1 w2 w3 s1 s2 s3", inputs="torque1 torque2 torque3",
        rates=lambda q, u: attitude(several(q, "q", 4), several(u, "w", 3, 1)),
        rates_by_an_expert=lambda q, u: halved(several(q, "q", 4), several(u, "w", 3, 1)),
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(s1=i.torque1, s2=i.torque2, s3=i.torque3),
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )


def four_wheels(f):
    def axis(p, k):
        return several(p, f"e{k}", 3)

    def bodies(p, q, u):
        w, s = several(u, "w", 3), several(u, "s", 4)
        all = [(0, tuple(several(p, "I", 3)), (0, 0, 0), (0, 0, 0), tuple(w))]
        for k in range(4):
            # about an axis of unit length
            (x, y, z), moment = axis(p, k), getattr(p, f"J{k}")
            inertia = tuple(moment * each for each in (x * x, y * y, z * z, x * y, y * z, z * x))
            all.append((0, inertia, (0, 0, 0), (0, 0, 0), tuple(a + s[k] * e for a, e in zip(w, (x, y, z)))))
        return all

    def explicit(p, q, u, i):
        w, moments = several(u, "w", 3), several(p, "I", 3)
        wheels, torques = several(p, "J", 4), several(i, "torque", 4)
        axes = [axis(p, k) for k in range(4)]
        momenta = [f.named(j * (s + dot(e, w))) for j, s, e in zip(wheels, several(u, "s", 4), axes)]
        spin = [f.named(moments[k] * w[k] + sum(e[k] * h for e, h in zip(axes, momenta))) for k in range(3)]
        gyroscopic = cross(spin, w)
        turned = [f.named((gyroscopic[k] - sum(e[k] * t for e, t in zip(axes, torques))) / moments[k])
                  for k in range(3)]
        return turned + [t / j - dot(e, turned) for t, j, e in zip(torques, wheels, axes)]

    return SimpleNamespace(
        parameters=f"{numbered('I', 3)} {numbered('J', 4)} " + " ".join(numbered(f"e{k}", 3) for k in range(4)),
        coordinates=numbered("q", 4), speeds=f"{numbered('w', 3)} {numbered('s', 4)}",
        kept=f"{numbered('w', 3)} {numbered('s', 4)}", inputs=numbered("torque", 4),
        rates=lambda q, u: attitude(several(q, "q", 4), several(u, "w", 3)),
        rates_by_an_expert=lambda q, u: halved(several(q, "q", 4), several(u, "w", 3)),
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: {f"s{k}": getattr(i, f"torque{k}") for k in range(4)},
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )


def quadrotor(f):
    def forces(p, q, u, i):
        a, b, c, d = several(q, "q", 4)
        return dict(v0=2 * (b * d + a * c) * i.thrust, v1=2 * (c * d - a * b) * i.thrust,
                    v2=(a * a - b * b - c * c + d * d) * i.thrust - p.m * p.g,
                    w0=i.torque0, w1=i.torque1, w2=i.torque2)

    def explicit(p, q, u, i):
        (a, b, c, d), (x, y, z) = several(q, "q", 4), several(u, "w", 3)
        pull = f.named(i.thrust / p.m)
        twice = f.named(2 * pull)
        return [twice * (b * d + a * c), twice * (c * d - a * b), pull * (a * a - b * b - c * c + d * d) - p.g,
                (y * z * (p.I1 - p.I2) + i.torque0) / p.I0, (z * x * (p.I2 - p.I0) + i.torque1) / p.I1,
                (x * y * (p.I0 - p.I1) + i.torque2) / p.I2]

    def rates(turning):
        return lambda q, u: several(u, "v", 3) + turning(several(q, "q", 4), several(u, "w", 3))

    return SimpleNamespace(
        parameters="m I0 I1 I2 g", coordinates=f"{numbered('p', 3)} {numbered('q', 4)}",
        speeds=f"{numbered('v', 3)} {numbered('w', 3)}", kept=f"{numbered('v', 3)} {numbered('w', 3)}",
        inputs="thrust " + numbered("torque", 3),
        rates=rates(attitude),
        rates_by_an_expert=rates(halved),
        bodies=lambda p, q, u: [(p.m, (p.I0, p.I1, p.I2), (u.v0, u.v1, u.v2), (0, 0, 0), (u.w0, u.w1, u.w2))],
        explicit=explicit,
        forces=forces,
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )


def finned_body(f):
    """A body in a fluid that adds other masses along each axis: three particles, each along an axis that stands, and
    what the turning of their momentum leaves, as forces."""

    def bodies(p, q, u):
        masses = [(mass, (0, 0, 0), tuple(speed if j == k else 0 for j in range(3)), (0, 0, 0), (0, 0, 0))
                  for k, (mass, speed) in enumerate(zip(several(p, "M", 3), several(u, "v", 3)))]
        return [(0, tuple(several(p, "I", 3)), (0, 0, 0), (0, 0, 0), tuple(several(u, "w", 3)))] + masses

    def forces(p, q, u, i):
        w, v = several(u, "w", 3), several(u, "v", 3)
        momentum = [mass * speed for mass, speed in zip(several(p, "M", 3), v)]
        push, turn = cross(momentum, w), cross(momentum, v)
        return dict(v0=push[0] + i.thrust, v1=push[1], v2=push[2], w0=turn[0] + i.torque0, w1=turn[1] + i.torque1,
                    w2=turn[2] + i.torque2)

    def explicit(p, q, u, i):
        # across the fins masses only add to the inertias about them
        x, y, z = several(u, "w", 3)
        p1, p2 = f.named(p.M1 * p.d), f.named(p.M2 * p.d)
        k1, k2 = f.named(p2 * p.d + p.I1), f.named(p1 * p.d + p.I2)
        return [((k1 - k2) * y * z + i.torque0) / p.I0,
                ((k2 - p.I0) * z * x - p2 * u.v0 * y + i.torque1) / k1,
                ((p.I0 - k1) * x * y - p1 * u.v0 * z + i.torque2) / k2,
                (p1 * z * z + p2 * y * y + i.thrust) / p.M0]

    return SimpleNamespace(
        parameters=f"{numbered('I', 3)} {numbered('M', 3)} d", coordinates=numbered("q", 4),
        speeds=f"{numbered('w', 3)} {numbered('v', 3)}", kept=f"{numbered('w', 3)} v0",
        inputs="thrust " + numbered("torque", 3),
        rates=lambda q, u: attitude(several(q, "q", 4), several(u, "w", 3)),
        rates_by_an_expert=lambda q, u: halved(several(q, "q", 4), several(u, "w", 3)),
        bodies=bodies,
        explicit=explicit,
        forces=forces,
        constraints=lambda p, q, u: [u.v1 - p.d * u.w2, u.v2 + p.d * u.w1],
        solved=lambda p, q, u: dict(v1=p.d * u.w2, v2=-p.d * u.w1),
    )


def heavy_top(f):
    def weight(p, q):
        return cross(several(q, "g", 3), [p.m * p.gravity * each for each in several(p, "c", 3)])

    def explicit(p, q, u, i):
        g, (x, y, z), pull = several(q, "g", 3), several(u, "w", 3), f.named(p.m * p.gravity)
        torque = cross(g, [f.named(pull * each) for each in several(p, "c", 3)])
        return [((p.I1 - p.I2) * y * z + torque[0]) / p.I0, ((p.I2 - p.I0) * z * x + torque[1]) / p.I1,
                ((p.I0 - p.I1) * x * y + torque[2]) / p.I2]

    return SimpleNamespace(
        parameters=f"{numbered('I', 3)} {numbered('c', 3)} m gravity", coordinates=numbered("g", 3),
        speeds=numbered("w", 3), kept=numbered("w", 3), inputs="",
        rates=lambda q, u: list(cross(several(q, "g", 3), several(u, "w", 3))),
        bodies=lambda p, q, u: [(0, tuple(several(p, "I", 3)), (0, 0, 0), (0, 0, 0), tuple(several(u, "w", 3)))],
        explicit=explicit,
        forces=lambda p, q, u, i: dict(zip(("w0", "w1", "w2"), weight(p, q))),
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )
