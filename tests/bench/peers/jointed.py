"""Machines of links and joints: arms, a leg, Furuta's pendulum."""

from types import SimpleNamespace

from pieces import numbered, on_the_plane, planar, several, two_by_two


def couplings(lengths, moments, s, co, spins, turned):
    """What the turning of the other links asks of each link of a planar chain, in absolute angles."""
    for a in range(len(s)):
        asked = 0
        for b in range(len(s)):
            if b != a:
                pair = (s[a] * co[b] - co[a] * s[b]) * spins[b] * spins[b]
                pair = pair + (co[a] * co[b] + s[a] * s[b]) * turned[b]
                asked = asked + lengths[min(a, b)] * moments[max(a, b)] * pair
        yield asked


def arm(n):
    """A planar arm on a skate; by an expert Featherstone's articulated bodies, in the axes of each link."""

    def parts(p, q, u):
        get = getattr
        return [tuple(get(space, f"{name}{k}") for space, name in
                      ((p, "m"), (p, "J"), (p, "l"), (p, "c"), (q, "q"), (u, "qd"))) for k in range(n)]

    def of(f):
        def bodies(p, q, u):
            all = [planar(p.M, p.I, u.v, u.side, u.omega, u.omega)]
            angle, spin, vx, vy = 0, u.omega, u.v, u.side + p.a * u.omega
            for m, J, l, c, turn, rate in parts(p, q, u):
                angle, spin = angle + turn, spin + rate
                sin, cos = f.sin(angle), f.cos(angle)
                all.append(planar(m, J, vx - c * sin * spin, vy + c * cos * spin, u.omega, spin))
                vx, vy = vx - l * sin * spin, vy + l * cos * spin
            return all

        def by_an_expert(p, q, u):
            all = [planar(p.M, p.I, u.v, 0, u.omega, u.omega)]
            spin, vx, vy = u.omega, u.v, p.a * u.omega
            for m, J, l, c, turn, rate in parts(p, q, u):
                sin, cos = f.sin(turn), f.cos(turn)
                spin, vx, vy = spin + rate, cos * vx + sin * vy, cos * vy - sin * vx
                all.append(planar(m, J, vx, vy + c * spin, spin, spin))
                vy = vy + l * spin
            return all

        def explicit(p, q, u, i):
            name = f.named
            spins, run = [], u.omega
            for *_, rate in parts(p, q, u):
                run = name(run + rate)
                spins.append(name(run * run))
            torques, inward = several(i, "torque", n), []
            xx = xy = yy = fx = fy = beyond = 0
            for (m, J, l, c, turn, _), ww, torque in reversed(list(zip(parts(p, q, u), spins, torques))):
                sin, cos = name(f.sin(turn)), name(f.cos(turn))
                mc, lw = name(m * c), name(l * ww)
                xt, yt = name(l * xy), name(l * yy + mc)
                over = name(1 / (mc * c + l * l * yy + J))
                px, py = name(fx - mc * ww - xx * lw), name(fy - xy * lw)
                e = name((torque - l * py - beyond) * over)
                kx, ky = name(xt * over), name(yt * over)
                inward.append((sin, cos, e, kx, ky))
                rx, ry = name(xt * e + px), name(yt * e + py)
                rxx, rxy, ryy = name(m + xx - xt * kx), name(xy - xt * ky), name(m + yy - yt * ky)
                first, second = name(cos * rxx - sin * rxy), name(cos * rxy - sin * ryy)
                xx, xy = name(cos * first - sin * second), name(sin * first + cos * second)
                yy = name(rxx + ryy - xx)
                fx, fy, beyond = name(cos * rx - sin * ry), name(sin * rx + cos * ry), torque
            base, across = name(u.omega * u.omega), name(u.v * u.omega)
            lw, xt, yt = name(p.a * base), name(p.a * xy), name(p.a * yy)
            py = name(fy - xy * lw)
            push = name(i.push - fx + xx * lw - xy * across)
            steer = name(i.steer - beyond - p.a * py - yt * across)
            ahead, turned = two_by_two(f, name(p.M + xx), xt, name(p.a * yt + p.I), (push, steer))
            result = [ahead, turned]
            ax, ay, ww, l = ahead, across, base, p.a
            for (sin, cos, e, kx, ky), (_, _, length, *_), square in zip(reversed(inward), parts(p, q, u), spins):
                jx, jy = name(ax - l * ww), name(ay + l * turned)
                ax, ay = name(cos * jx + sin * jy), name(cos * jy - sin * jx)
                next = name(e - kx * ax - ky * ay)
                result.append(next - turned)
                turned, ww, l = next, square, length
            return result

        def balance(p, q, u, i, z, via):
            """In angles and angular velocities of links to the skate, by which the forces have short derivatives."""
            angle, spin, angles, spins = 0, u.omega, [], []
            for *_, turn, rate in parts(p, q, u):
                angle, spin = angle + turn, spin + rate
                angles.append(angle)
                spins.append(spin)
            # from the last, as sums of derivatives grow
            angles, spins = ([via(each) for each in reversed(all)][::-1] for all in (angles, spins))
            m, J, l, c, *_ = zip(*parts(p, q, u))
            beyond = [sum(m[k + 1:]) for k in range(n)]
            moments = [m[k] * c[k] + l[k] * beyond[k] for k in range(n)]
            s, co = [f.sin(each) for each in angles], [f.cos(each) for each in angles]
            torques, turned = several(i, "torque", n) + [0], z[2:]
            ax, ay = z[0] - p.a * u.omega * u.omega, u.v * u.omega + p.a * z[1]
            fx, fy, residuals = (beyond[0] + m[0]) * ax, (beyond[0] + m[0]) * ay, []
            for k, coupled in enumerate(couplings(l, moments, s, co, spins, turned)):
                square = spins[k] * spins[k]
                fx = fx - moments[k] * (s[k] * turned[k] + co[k] * square)
                fy = fy + moments[k] * (co[k] * turned[k] - s[k] * square)
                own = (J[k] + m[k] * c[k] * c[k] + l[k] * l[k] * beyond[k]) * turned[k]
                residuals.append(own + moments[k] * (co[k] * ay - s[k] * ax) + coupled + torques[k + 1] - torques[k])
            return [p.M * z[0] + fx - i.push, p.I * z[1] + p.a * fy + torques[0] - i.steer] + residuals

        names = numbered("qd", n)
        return SimpleNamespace(
            parameters="M I a " + " ".join(f"m{k} J{k} l{k} c{k}" for k in range(n)),
            coordinates="x y th " + numbered("q", n), speeds=f"v side omega {names}", kept=f"v omega {names}",
            inputs="push steer " + numbered("torque", n),
            rates=lambda q, u: on_the_plane(f, q, u) + several(u, "qd", n),
            bodies=bodies,
            bodies_by_an_expert=by_an_expert,
            explicit=explicit,
            balance=balance,
            relative=lambda z: z[:2] + [later - sooner for sooner, later in zip(z[1:], z[2:])],
            forces=lambda p, q, u, i: dict(
                v=i.push, omega=i.steer, **{f"qd{k}": getattr(i, f"torque{k}") for k in range(n)}),
            constraints=lambda p, q, u: [u.side],
            solved=lambda p, q, u: dict(side=0),
        )

    return of


def furuta(f):
    def bodies(p, q, u):
        sin, cos = f.sin(q.b), f.cos(q.b)
        return [planar(0, p.J, 0, 0, 0, u.a_dot),
                (p.m, (p.I, p.I, 0), (-p.l * sin * u.a_dot, p.L * u.a_dot + p.l * cos * u.b_dot, -p.l * sin * u.b_dot),
                 (0, 0, u.a_dot), (-u.b_dot, -sin * u.a_dot, cos * u.a_dot))]

    def explicit(p, q, u, i):
        name = f.named
        sin, cos = name(f.sin(q.b)), name(f.cos(q.b))
        ml = name(p.m * p.l)
        m22, reach = name(ml * p.l + p.I), name(ml * p.L)
        m11 = name(m22 * sin * sin + (p.m * p.L * p.L + p.J))
        turn = name(m22 * sin * cos * u.a_dot)
        f1 = name(reach * sin * u.b_dot * u.b_dot - 2 * turn * u.b_dot + i.torque)
        f2 = name(turn * u.a_dot + ml * p.g * sin)
        return list(two_by_two(f, m11, name(reach * cos), m22, (f1, f2)))

    return SimpleNamespace(
        parameters="J L m l I g", coordinates="a b", speeds="a_dot b_dot", kept="a_dot b_dot", inputs="torque",
        rates=lambda q, u: [u.a_dot, u.b_dot],
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(a_dot=i.torque, b_dot=p.m * p.g * p.l * f.sin(q.b)),
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )


def leg(f):
    def bodies(p, q, u):
        vx = vy = 0
        all = []
        for k in range(3):
            m, J, l, c = (getattr(p, f"{name}{k}") for name in "mJlc")
            angle, rate = getattr(q, f"q{k}"), getattr(u, f"qd{k}")
            sin, cos = f.sin(angle), f.cos(angle)
            all.append(planar(m, J, vx + c * cos * rate, vy - c * sin * rate, 0, rate))
            vx, vy = vx + l * cos * rate, vy - l * sin * rate
        return all

    def forces(p, q, u, i):
        moments = [p.m0 * p.c0 + (p.m1 + p.m2) * p.l0, p.m1 * p.c1 + p.m2 * p.l1, p.m2 * p.c2]
        torques = [i.torque0 - i.torque1, i.torque1 - i.torque2, i.torque2]
        return {f"qd{k}": torques[k] + p.g * moments[k] * f.sin(getattr(q, f"q{k}")) for k in range(3)}

    def explicit(p, q, u, i):
        name = f.named
        s = [name(f.sin(each)) for each in several(q, "q", 3)]
        c = [name(f.cos(each)) for each in several(q, "q", 3)]
        squares = [name(each * each) for each in several(u, "qd", 3)]
        # what hangs beyond each link, and first moments
        beyond, heavy, k3 = name(p.m2 * p.l1), name(p.m1 + p.m2), name(p.m2 * p.c2)
        k2, k1 = name(p.m1 * p.c1 + beyond), name(p.m0 * p.c0 + heavy * p.l0)
        m11 = name(heavy * p.l0 * p.l0 + p.m0 * p.c0 * p.c0 + p.J0)
        m22 = name(beyond * p.l1 + p.m1 * p.c1 * p.c1 + p.J1)
        m33 = name(k3 * p.c2 + p.J2)

        def pair(first, second, moment):
            return name(moment * (c[first] * c[second] + s[first] * s[second])), \
                name(moment * (s[first] * c[second] - c[first] * s[second]))

        (m12, n12), (m13, n13), (m23, n23) = pair(0, 1, p.l0 * k2), pair(0, 2, p.l0 * k3), pair(1, 2, p.l1 * k3)
        f1 = name(p.g * k1 * s[0] - n12 * squares[1] - n13 * squares[2] + i.torque0 - i.torque1)
        f2 = name(p.g * k2 * s[1] + n12 * squares[0] - n23 * squares[2] + i.torque1 - i.torque2)
        f3 = name(p.g * k3 * s[2] + n13 * squares[0] + n23 * squares[1] + i.torque2)
        over = name(1 / m33)
        e1, e2 = name(m13 * over), name(m23 * over)
        a, b = two_by_two(f, name(m11 - e1 * m13), name(m12 - e1 * m23), name(m22 - e2 * m23),
                          (name(f1 - e1 * f3), name(f2 - e2 * f3)))
        return [a, b, f3 * over - e1 * a - e2 * b]

    def balance(p, q, u, i, z, via):
        m, J, l, c = (several(p, name, 3) for name in "mJlc")
        angles, spins, torques = several(q, "q", 3), several(u, "qd", 3), several(i, "torque", 3) + [0]
        s, co = [f.sin(each) for each in angles], [f.cos(each) for each in angles]
        beyond = [sum(m[k + 1:]) for k in range(3)]
        moments = [m[k] * c[k] + l[k] * beyond[k] for k in range(3)]
        return [(J[k] + m[k] * c[k] * c[k] + l[k] * l[k] * beyond[k]) * z[k] - p.g * moments[k] * s[k] + coupled
                + torques[k + 1] - torques[k] for k, coupled in enumerate(couplings(l, moments, s, co, spins, z))]

    return SimpleNamespace(
        parameters=" ".join(numbered(name, 3) for name in "mJlc") + " g", coordinates=numbered("q", 3),
        speeds=numbered("qd", 3), kept=numbered("qd", 3), inputs=numbered("torque", 3),
        rates=lambda q, u: several(u, "qd", 3),
        bodies=bodies,
        explicit=explicit,
        balance=balance,
        relative=lambda z: z,
        forces=forces,
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )


def elbow(f):
    def bodies(p, q, u):
        yaw, first, second = u.qd0, u.qd1, u.qd1 + u.qd2
        s1, c1, s2, c2 = f.sin(q.q1), f.cos(q.q1), f.sin(q.q1 + q.q2), f.cos(q.q1 + q.q2)
        reach = p.l * c1 + p.c1 * c2

        def slender(m, I, velocity, sin, cos, rate):
            return m, (0, I, I), velocity, (0, 0, yaw), (yaw * sin, -rate, yaw * cos)

        # in axes that turn with the base: outward, along, upward
        return [planar(0, p.J, 0, 0, 0, yaw),
                slender(p.m0, p.I0, (-p.c0 * s1 * first, p.c0 * c1 * yaw, p.c0 * c1 * first), s1, c1, first),
                slender(p.m1, p.I1, (-p.l * s1 * first - p.c1 * s2 * second, reach * yaw,
                                     p.l * c1 * first + p.c1 * c2 * second), s2, c2, second)]

    def forces(p, q, u, i):
        upper = p.g * (p.m0 * p.c0 + p.m1 * p.l) * f.cos(q.q1)
        lower = p.g * p.m1 * p.c1 * f.cos(q.q1 + q.q2)
        return dict(qd0=i.torque0, qd1=i.torque1 - upper - lower, qd2=i.torque2 - lower)

    def explicit(p, q, u, i):
        name = f.named
        s1, c1, se, ce = name(f.sin(q.q1)), name(f.cos(q.q1)), name(f.sin(q.q2)), name(f.cos(q.q2))
        s2, c2 = name(s1 * ce + c1 * se), name(c1 * ce - s1 * se)
        second = name(u.qd1 + u.qd2)
        # in angles to the horizontal: the links' inertias about their joints, and what couples them
        mc, ml = name(p.m1 * p.c1), name(p.m1 * p.l)
        k1, k2 = name(ml * p.l + p.m0 * p.c0 * p.c0 + p.I0), name(mc * p.c1 + p.I1)
        k = name(mc * p.l)
        p1, p2 = name(k1 * c1 + k * c2), name(k2 * c2 + k * c1)
        t1, t2 = name(s1 * p1), name(s2 * p2)
        yaw = 2 * u.qd0 * name(t1 * u.qd1 + t2 * second) + i.torque0
        yaw = yaw / name(c1 * p1 + c2 * p2 + p.J)
        yaws, turn = name(u.qd0 * u.qd0), name(k * se)
        weight = name(p.m0 * p.c0 + ml)
        f1 = name(turn * second * second - p.g * weight * c1 - t1 * yaws + i.torque1 - i.torque2)
        f2 = name(i.torque2 - turn * u.qd1 * u.qd1 - p.g * mc * c2 - t2 * yaws)
        a, b = two_by_two(f, k1, name(k * ce), k2, (f1, f2))
        return [yaw, a, b - a]

    return SimpleNamespace(
        parameters="J m0 m1 I0 I1 c0 c1 l g", coordinates=numbered("q", 3), speeds=numbered("qd", 3),
        kept=numbered("qd", 3), inputs=numbered("torque", 3),
        rates=lambda q, u: several(u, "qd", 3),
        bodies=bodies,
        explicit=explicit,
        forces=forces,
        constraints=lambda p, q, u: [],
        solved=lambda p, q, u: {},
    )
