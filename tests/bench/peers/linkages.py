"""Loops of links in the plane. Every speed is in the state, and the rates of the closed loop are constraints.

By an expert the loop is solved for the accelerations of two links, which is valid where these are not in line, as at
the states of the benchmark; `dependent` are the speeds that a tool takes for dependent.
"""

from types import SimpleNamespace

from pieces import planar, two_by_two


def rod(f, p, q, u, share):
    """The velocity of a point of the second link, a share of its length from the crank."""
    return (-p.l1 * f.sin(q.a) * u.a_dot - share * p.l2 * f.sin(q.b) * u.b_dot,
            p.l1 * f.cos(q.a) * u.a_dot + share * p.l2 * f.cos(q.b) * u.b_dot)


def differences(f, angle, others):
    """Sines and cosines of an angle less each of the others."""
    return [(f.named(f.sin(angle - other)), f.named(f.cos(angle - other))) for other in others]


def between(f, first, second):
    """Sine and cosine of the second angle less the first, each counted from the same one."""
    (s1, c1), (s2, c2) = first, second
    return f.named(s1 * c2 - c1 * s2), f.named(c1 * c2 + s1 * s2)


def four_bar(f):
    def bodies(p, q, u):
        return [planar(0, p.J1, 0, 0, 0, u.a_dot), planar(p.m, p.J2, *rod(f, p, q, u, 0.5), 0, u.b_dot),
                planar(0, p.J3, 0, 0, 0, u.c_dot)]

    def constraints(p, q, u):
        x, y = rod(f, p, q, u, 1)
        return [x + p.l3 * f.sin(q.c) * u.c_dot, y - p.l3 * f.cos(q.c) * u.c_dot]

    def explicit(p, q, u, i):
        name = f.named
        (sab, cab), (sac, cac) = differences(f, q.a, (q.b, q.c))
        scb, ccb = between(f, (sab, cab), (sac, cac))
        aa, bb, cc = (name(each * each) for each in (u.a_dot, u.b_dot, u.c_dot))
        # the second and third accelerations are k₂ä + g₂ and k₃ä + g₃
        over = name(1 / (p.l2 * p.l3 * scb))
        over2, over3 = name(p.l3 * over), name(p.l2 * over)
        k2, k3 = name(p.l1 * sac * over2), name(p.l1 * sab * over3)
        pull, rod, arm = name(p.l1 * aa), name(p.l2 * bb), name(p.l3 * cc)
        g2 = name((pull * cac + rod * ccb - arm) * over2)
        g3 = name((pull * cab + rod - arm * ccb) * over3)
        half = name(0.5 * p.m * p.l2)
        coupling = name(half * p.l1)
        w12, w22, turn = name(coupling * cab), name(half * 0.5 * p.l2 + p.J2), name(coupling * sab)
        row, j3k3 = name(w22 * k2 + w12), name(p.J3 * k3)
        mass = k2 * (row + w12) + j3k3 * k3 + (p.m * p.l1 * p.l1 + p.J1)
        force = k2 * turn * aa - turn * bb + i.torque - row * g2 - j3k3 * g3
        a = name(force / mass)
        return [a, k2 * a + g2, k3 * a + g3]

    return SimpleNamespace(
        parameters="l1 l2 l3 d J1 J2 J3 m", coordinates="a b c", speeds="a_dot b_dot c_dot",
        kept="a_dot b_dot c_dot", dependent="b_dot c_dot", inputs="torque",
        rates=lambda q, u: [u.a_dot, u.b_dot, u.c_dot],
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(a_dot=i.torque),
        constraints=constraints,
        solved=None,
    )


def five_bar(f):
    def bodies(p, q, u):
        return [planar(0, p.J1, 0, 0, 0, u.a_dot), planar(0, p.J2, 0, 0, 0, u.b_dot),
                planar(0, p.J3, 0, 0, 0, u.c_dot), planar(0, p.J4, 0, 0, 0, u.d_dot),
                planar(p.m, 0, *rod(f, p, q, u, 1), 0, 0)]

    def constraints(p, q, u):
        x, y = rod(f, p, q, u, 1)
        return [x + p.l3 * f.sin(q.c) * u.c_dot + p.l4 * f.sin(q.d) * u.d_dot,
                y - p.l3 * f.cos(q.c) * u.c_dot - p.l4 * f.cos(q.d) * u.d_dot]

    def explicit(p, q, u, i):
        name = f.named
        # all angles from that of the second link
        sa, ca = name(f.sin(q.a - q.b)), name(f.cos(q.a - q.b))
        sc, cc = name(f.sin(q.c - q.b)), name(f.cos(q.c - q.b))
        sd, cd = name(f.sin(q.d - q.b)), name(f.cos(q.d - q.b))
        sac, cac = name(sa * cc - ca * sc), name(ca * cc + sa * sc)
        sdc, cdc = name(sd * cc - cd * sc), name(cd * cc + sd * sc)
        aa, bb = name(u.a_dot * u.a_dot), name(u.b_dot * u.b_dot)
        pull_a, pull_b = name(p.l1 * aa), name(p.l2 * bb)
        pull_c, pull_d = name(p.l3 * u.c_dot * u.c_dot), name(p.l4 * u.d_dot * u.d_dot)
        # the second and third accelerations are kä + nd̈ + g and rä + td̈ + h
        over = name(1 / sc)
        over2, over3 = name(over / p.l2), name(over / p.l3)
        k, n = name(p.l1 * sac * over2), name(-p.l4 * sdc * over2)
        g = name(over2 * (pull_a * cac + pull_b * cc - pull_d * cdc - pull_c))
        r, t = name(p.l1 * sa * over3), name(-p.l4 * sd * over3)
        h = name(over3 * (pull_a * ca - pull_c * cc - pull_d * cd + pull_b))
        load = name(p.m * p.l1)
        coupling = name(load * p.l2)
        w12, turn = name(coupling * ca), name(coupling * sa)
        w22, w11 = name(p.m * p.l2 * p.l2 + p.J2), name(load * p.l1 + p.J1)
        f1, f2 = name(i.left - turn * bb), name(turn * aa - w22 * g)
        jr, jt, row = name(p.J3 * r), name(p.J3 * t), name(w22 * k + w12)
        m11 = name(k * (row + w12) + jr * r + w11)
        m12, m22 = name(row * n + jr * t), name(w22 * n * n + jt * t + p.J4)
        a, d = two_by_two(f, m11, m12, m22, (name(k * f2 - w12 * g - jr * h + f1), name(n * f2 - jt * h + i.right)))
        return [a, k * a + n * d + g, r * a + t * d + h, d]

    return SimpleNamespace(
        parameters="l1 l2 l3 l4 base J1 J2 J3 J4 m", coordinates="a b c d", speeds="a_dot b_dot c_dot d_dot",
        kept="a_dot b_dot c_dot d_dot", dependent="b_dot c_dot", inputs="left right",
        rates=lambda q, u: [u.a_dot, u.b_dot, u.c_dot, u.d_dot],
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(a_dot=i.left, d_dot=i.right),
        constraints=constraints,
        solved=None,
    )


def slider_crank(f):
    def bodies(p, q, u):
        return [planar(0, p.J1, 0, 0, 0, u.a_dot), planar(p.m, p.J2, *rod(f, p, q, u, 0.5), 0, u.b_dot),
                planar(p.M, 0, u.s_dot, 0, 0, 0)]

    def constraints(p, q, u):
        x, y = rod(f, p, q, u, 1)
        return [x - u.s_dot, y]

    def explicit(p, q, u, i):
        name = f.named
        sa, ca, sb, cb = name(f.sin(q.a)), name(f.cos(q.a)), name(f.sin(q.b)), name(f.cos(q.b))
        aa, bb = name(u.a_dot * u.a_dot), name(u.b_dot * u.b_dot)
        up, ahead, rod_up, rod_ahead = name(p.l1 * sa), name(p.l1 * ca), name(p.l2 * sb), name(p.l2 * cb)
        # the rod's acceleration is kä + g, the piston's eä + h
        over = name(1 / rod_ahead)
        k, g = name(-ahead * over), name(over * (up * aa + rod_up * bb))
        e, h = name(-(rod_up * k + up)), name(-(rod_up * g + ahead * aa + rod_ahead * bb))
        half = name(0.5 * p.m)
        w12, turn = name(half * (ahead * rod_ahead + up * rod_up)), name(half * (up * rod_ahead - ahead * rod_up))
        row = name((0.5 * half * p.l2 * p.l2 + p.J2) * k + w12)
        me = name(p.M * e)
        mass = k * (row + w12) + me * e + (p.m * p.l1 * p.l1 + p.J1)
        force = k * turn * aa - turn * bb + i.torque + e * i.push - row * g - me * h
        a = name(force / mass)
        return [a, k * a + g, e * a + h]

    return SimpleNamespace(
        parameters="l1 l2 J1 J2 m M", coordinates="a b s", speeds="a_dot b_dot s_dot", kept="a_dot b_dot s_dot",
        dependent="b_dot s_dot", inputs="torque push",
        rates=lambda q, u: [u.a_dot, u.b_dot, u.s_dot],
        bodies=bodies,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(a_dot=i.torque, s_dot=i.push),
        constraints=constraints,
        solved=None,
    )
