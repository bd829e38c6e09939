"""What rolls on a table: balls, a disk, stones."""

from types import SimpleNamespace

from pieces import cross, dot, numbered, several, three_by_three


def ball(f):
    def bodies(p, q, u):
        moment = p.m * p.k2
        return [(p.m, (moment, moment, moment), (u.dx, u.dy, 0), (0, 0, 0), (u.wx, u.wy, u.wz))]

    return SimpleNamespace(
        parameters="m r k2 Omega", coordinates="x y", speeds="dx dy wx wy wz", kept="wx wy wz", inputs="",
        rates=lambda q, u: [u.dx, u.dy],
        bodies=bodies,
        explicit=lambda p, q, u, i: [f.named(p.r * p.Omega / (p.r * p.r + p.k2)) * each for each in (u.dx, u.dy)] + [0],
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [u.dx - p.r * u.wy + p.Omega * q.y, u.dy + p.r * u.wx - p.Omega * q.x],
        solved=lambda p, q, u: dict(dx=p.r * u.wy - p.Omega * q.y, dy=-p.r * u.wx + p.Omega * q.x),
    )


def about_the_contact(f, p, g, moments, right):
    """The angular acceleration of a ball by the moments about its contact: Chaplygin's solution."""
    mrr = f.named(p.m * p.r * p.r)
    share = f.named(mrr * dot(g, g))
    over = [f.named(1 / (each + share)) for each in moments]
    along = [f.named(a * b) for a, b in zip(g, over)]
    pull = f.named(mrr * dot(along, right) / (1 - mrr * dot(along, g)))
    return [f.named(a * b + c * pull) for a, b, c in zip(over, right, along)]


def rolled(p, q, u, first):
    """The velocity of a ball's centre: r ω × g."""
    return tuple(p.r * each for each in cross(several(u, "w", 3, first), several(q, "g", 3, first)))


def chaplygin_ball(f):
    def bodies(p, q, u):
        spin = (u.w1, u.w2, u.w3)
        return [(p.m, (p.I1, p.I2, p.I3), (u.v1, u.v2, u.v3), spin, spin)]

    def explicit(p, q, u, i):
        w, moments = several(u, "w", 3, 1), several(p, "I", 3, 1)
        (a, b, c), (x, y, z) = moments, w
        right = [f.named(each) for each in ((b - c) * y * z, (c - a) * z * x, (a - b) * x * y)]
        return about_the_contact(f, p, several(q, "g", 3, 1), moments, right)

    return SimpleNamespace(
        parameters="I1 I2 I3 m r", coordinates="g1 g2 g3", speeds="w1 w2 w3 v1 v2 v3", kept="w1 w2 w3", inputs="",
        rates=lambda q, u: list(cross(several(q, "g", 3, 1), several(u, "w", 3, 1))),
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [v - c for v, c in zip((u.v1, u.v2, u.v3), rolled(p, q, u, 1))],
        solved=lambda p, q, u: dict(zip(("v1", "v2", "v3"), rolled(p, q, u, 1))),
    )


def ball_with_rotors(f):
    def bodies(p, q, u):
        w, s = tuple(several(u, "w", 3)), several(u, "s", 3)
        rotors = []
        for k, moment in enumerate(several(p, "J", 3)):
            rotors.append((0, tuple(moment if j == k else 0 for j in range(3)), (0, 0, 0), (0, 0, 0),
                           tuple(w[j] + s[k] if j == k else w[j] for j in range(3))))
        return [(p.m, tuple(several(p, "I", 3)), tuple(several(u, "v", 3)), w, w)] + rotors

    def explicit(p, q, u, i):
        # a rotor's torque is its momentum's rate, and its reaction acts on the ball
        w, s, moments, rotors = several(u, "w", 3), several(u, "s", 3), several(p, "I", 3), several(p, "J", 3)
        torques = several(i, "torque", 3)
        spin = [f.named(m * a + j * (a + b)) for m, j, a, b in zip(moments, rotors, w, s)]
        right = [f.named(a - b) for a, b in zip(cross(spin, w), torques)]
        turned = about_the_contact(f, p, several(q, "g", 3), moments, right)
        return turned + [t / j - a for t, j, a in zip(torques, rotors, turned)]

    w, v, s = (numbered(name, 3) for name in "wvs")
    return SimpleNamespace(
        parameters=f"{numbered('I', 3)} {numbered('J', 3)} m r", coordinates=numbered("g", 3), speeds=f"{w} {v} {s}",
        kept=f"{w} {s}", inputs=numbered("torque", 3),
        rates=lambda q, u: list(cross(several(q, "g", 3), several(u, "w", 3))),
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: {f"s{k}": getattr(i, f"torque{k}") for k in range(3)},
        constraints=lambda p, q, u: [a - b for a, b in zip(several(u, "v", 3), rolled(p, q, u, 0))],
        solved=lambda p, q, u: dict(zip(v.split(), rolled(p, q, u, 0))),
    )


def disk(f):
    def spins(q, u):
        """Of axes that follow the disk and do not spin, and of the disk, in them: along the horizontal, up, across."""
        sin, cos = f.sin(q.al), f.cos(q.al)
        frame = (u.al_dot, sin * u.psi_dot, cos * u.psi_dot)
        return frame, (*frame[:2], frame[2] + u.phi_dot)

    def bodies(p, q, u):
        frame, spin = spins(q, u)
        return [(p.m, (p.I, p.I, p.J), (u.x_dot, u.y_dot, p.r * f.cos(q.al) * u.al_dot), (0, 0, 0), spin, frame)]

    def by_an_expert(p, q, u):
        frame, spin = spins(q, u)
        return [(p.m, (p.I, p.I, p.J), (-p.r * spin[2], 0, p.r * spin[0]), frame, spin, frame)]

    def solved(p, q, u):
        sin, cos = f.sin(q.psi), f.cos(q.psi)
        down, along = p.r * f.sin(q.al) * u.al_dot, p.r * (f.cos(q.al) * u.psi_dot + u.phi_dot)
        return dict(x_dot=down * sin - along * cos, y_dot=-down * cos - along * sin)

    def constraints(p, q, u):
        # along the table and to the side
        sin, cos = f.sin(q.psi), f.cos(q.psi)
        return [cos * u.x_dot + sin * u.y_dot + p.r * (f.cos(q.al) * u.psi_dot + u.phi_dot),
                cos * u.y_dot - sin * u.x_dot + p.r * f.sin(q.al) * u.al_dot]

    def explicit(p, q, u, i):
        name = f.named
        sin, cos = name(f.sin(q.al)), name(f.cos(q.al))
        up, turn = name(sin * u.psi_dot), name(cos * u.psi_dot)
        spin = name(turn + u.phi_dot)
        mr = name(p.m * p.r)
        mrr = name(mr * p.r)
        heavy = name(p.J + mrr)
        leaned = (up * (p.I * turn - heavy * spin) - mr * p.g * cos) / (p.I + mrr)
        spun = mrr * u.al_dot * up / heavy
        turned = name(u.al_dot * (p.J / p.I * spin - 2 * turn) / sin)
        return [turned, leaned, u.al_dot * up - cos * turned + spun]

    speeds = "psi_dot al_dot phi_dot"
    return SimpleNamespace(
        parameters="m r I J g", coordinates="x y psi al phi", speeds=f"x_dot y_dot {speeds}", kept=speeds, inputs="",
        rates=lambda q, u: [u.x_dot, u.y_dot, u.psi_dot, u.al_dot, u.phi_dot],
        bodies=bodies,
        bodies_by_an_expert=by_an_expert,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(al_dot=-p.m * p.g * p.r * f.cos(q.al)),
        constraints=constraints,
        solved=solved,
    )


def stone(f, contact, moved, up, **rest):
    """A body that rolls on a point `contact`, seen from its centre of mass; `moved` are this point, its rate, and the
    vertical by hand, and `up` is the vertical."""

    def bodies(p, q, u):
        w, v = tuple(several(u, "w", 3)), tuple(several(u, "v", 3))
        return [(p.m, (*several(p, "I", 3), p.D, 0, 0), v, w, w)]

    def solved(p, q, u):
        return dict(zip(("v0", "v1", "v2"), cross(contact(p, q), several(u, "w", 3))))

    def explicit(p, q, u, i):
        # moments about the contact
        named = lambda values: [f.named(each) for each in values]
        w, (x, y, z) = several(u, "w", 3), several(u, "w", 3)
        at, rate, vertical = moved(p, q, w)
        slip = named(a - b for a, b in zip(named(cross(at, w)), rate))
        pull = named(p.gravity * a + b for a, b in zip(vertical, cross(w, slip)))
        heavy = named(p.m * each for each in at)
        spin = named((p.I0 * x + p.D * y, p.I1 * y + p.D * x, p.I2 * z))
        right = [a + b for a, b in zip(cross(spin, w), cross(heavy, pull))]
        xx, yy, zz = named(a * b for a, b in zip(heavy, at))
        matrix = (p.I0 + yy + zz, p.I1 + zz + xx, p.I2 + xx + yy, p.D - heavy[0] * at[1], -heavy[0] * at[2],
                  -heavy[1] * at[2])
        return list(three_by_three(f, matrix, right))

    w, v = numbered("w", 3), numbered("v", 3)
    return SimpleNamespace(
        speeds=f"{w} {v}", kept=w, inputs="",
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(zip(v.split(), (-p.m * p.gravity * each for each in up(q)))),
        constraints=lambda p, q, u: [getattr(u, name) - value for name, value in solved(p, q, u).items()],
        solved=solved,
        **rest,
    )


def rattleback(f):
    def contact(p, q):
        a = [each * each for each in several(p, "a", 3)]
        g = several(q, "g", 3)
        length = f.sqrt(sum(each * x * x for each, x in zip(a, g)))
        return -a[0] * q.g0 / length, -a[1] * q.g1 / length, p.h - a[2] * q.g2 / length

    def moved(p, q, w):
        name = f.named
        a = [name(each * each) for each in several(p, "a", 3)]
        g = several(q, "g", 3)
        out = [name(each * x) for each, x in zip(a, g)]
        over = name(1 / f.sqrt(dot(out, g)))
        down = [name(each * over) for each in out]
        rate = [name(each) for each in cross(g, w)]
        slide = name(dot(down, rate))
        return [-down[0], -down[1], name(p.h - down[2])], \
            [over * (x * slide - each * d) for x, each, d in zip(down, a, rate)], g

    return stone(
        f, contact, moved, lambda q: several(q, "g", 3),
        parameters=f"m {numbered('I', 3)} D {numbered('a', 3)} h gravity", coordinates=numbered("g", 3),
        rates=lambda q, u: list(cross(several(q, "g", 3), several(u, "w", 3))),
    )


def paraboloid(f):
    def contact(p, q):
        return -p.R0 * q.u0, -p.R1 * q.u1, (p.R0 * q.u0 * q.u0 + p.R1 * q.u1 * q.u1) / 2 - p.h

    def up(q):
        over = 1 / f.sqrt(1 + q.u0 * q.u0 + q.u1 * q.u1)
        return q.u0 * over, q.u1 * over, over

    def rates(q, u):
        x, y, z = cross((q.u0, q.u1, 1), several(u, "w", 3))
        return [x - q.u0 * z, y - q.u1 * z]

    def moved(p, q, w):
        name = f.named
        x, y = (name(each) for each in rates(q, SimpleNamespace(w0=w[0], w1=w[1], w2=w[2])))
        a, b = name(p.R0 * q.u0), name(p.R1 * q.u1)
        over = name(1 / f.sqrt(1 + q.u0 * q.u0 + q.u1 * q.u1))
        return [-a, -b, name((a * q.u0 + b * q.u1) * 0.5 - p.h)], [-p.R0 * x, -p.R1 * y, a * x + b * y], \
            [name(q.u0 * over), name(q.u1 * over), over]

    return stone(
        f, contact, moved, up,
        parameters=f"m {numbered('I', 3)} D {numbered('R', 2)} h gravity", coordinates=numbered("u", 2),
        rates=rates,
    )
