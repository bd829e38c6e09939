"""Vehicles on wheels, skates and rollers: on each of these nothing moves sideways."""

from types import SimpleNamespace

from pieces import on_the_plane, planar, several, two_by_two


def sleigh(f):
    def bodies(p, q, u):
        # the centre of mass at (a, b) in the body
        return [planar(p.m, p.J, u.v1 - p.b * u.omega, u.v2 + p.a * u.omega, u.omega, u.omega)]

    def explicit(p, q, u, i):
        ma, turn = f.named(p.m * p.a), u.omega
        turned = f.named((i.torque - turn * (p.c + ma * (u.v1 - p.b * turn))) / (ma * p.a + p.J))
        return [turned, p.b * turned + p.a * turn * turn]

    return SimpleNamespace(
        parameters="m J a b c", coordinates="theta x y", speeds="omega v1 v2", kept="omega v1", inputs="torque",
        rates=lambda q, u: [u.omega, u.v1 * f.cos(q.theta) - u.v2 * f.sin(q.theta),
                            u.v1 * f.sin(q.theta) + u.v2 * f.cos(q.theta)],
        bodies=bodies,
        forces=lambda p, q, u, i: dict(omega=i.torque - p.c * u.omega),
        constraints=lambda p, q, u: [u.v2],
        solved=lambda p, q, u: dict(v2=0),
        explicit=explicit,
    )


def snakeboard(f):
    def bodies(p, q, u):
        board = p.m * p.l * p.l - p.J0 - 2 * p.J1
        wheels = [planar(0, p.J1, 0, 0, 0, u.dtheta + sign * u.dphi) for sign in (1, -1)]
        return [planar(p.m, board, u.u1, u.u2, u.dtheta, u.dtheta),
                planar(0, p.J0, 0, 0, 0, u.dtheta + u.dpsi)] + wheels

    def explicit(p, q, u, i):
        # the board turns at −κ u₁, and turn is κ̇ u₁
        name = f.named
        cos = name(f.cos(q.phi))
        reach = name(p.l * cos)
        kappa, turn = name(f.sin(q.phi) / (p.l * f.cos(q.phi))), name(u.dphi * u.u1 / (reach * cos))
        excess = name(p.m * p.l * p.l - p.J0)
        ahead = name((i.rotor - excess * turn) * kappa / (excess * kappa * kappa + p.m))
        return [ahead, i.rotor / p.J0 + (kappa * ahead + turn), i.steering / (2 * p.J1)]

    return SimpleNamespace(
        parameters="m l J0 J1", coordinates="x y theta psi phi", speeds="u1 u2 dtheta dpsi dphi",
        kept="u1 dpsi dphi", inputs="rotor steering",
        rates=lambda q, u: [u.u1 * f.cos(q.theta) - u.u2 * f.sin(q.theta),
                            u.u1 * f.sin(q.theta) + u.u2 * f.cos(q.theta), u.dtheta, u.dpsi, u.dphi],
        bodies=bodies,
        forces=lambda p, q, u, i: dict(dpsi=i.rotor, dphi=i.steering),
        constraints=lambda p, q, u: [
            -f.sin(q.phi) * u.u1 + f.cos(q.phi) * u.u2 - p.l * f.cos(q.phi) * u.dtheta,
            f.sin(q.phi) * u.u1 + f.cos(q.phi) * u.u2 + p.l * f.cos(q.phi) * u.dtheta],
        solved=lambda p, q, u: dict(u2=0, dtheta=-f.named(f.sin(q.phi) / (p.l * f.cos(q.phi))) * u.u1),
        explicit=explicit,
    )


def robot(f):
    def bodies(p, q, u):
        # the centre of mass of the body l ahead of the axle; J is about the middle of the axle
        body = planar(p.m0, p.J - p.m0 * p.l * p.l, u.v, u.side + p.l * u.turn, u.turn, u.turn)
        axle = planar(2 * p.m1, 0, u.v, u.side, u.turn, u.turn)
        wheels = [(0, (0, p.J2, 0), (0, 0, 0), (0, 0, 0), (0, spin, 0)) for spin in (u.dpsi1, u.dpsi2)]
        return [body, axle] + wheels

    def explicit(p, q, u, i):
        # the sum and the difference of the wheels' rates decouple
        name = f.named
        speed, turn, quotient = u.v, u.turn, name(p.R / p.c)
        pull, double = name(p.m0 * p.l * turn), name(p.J2 + p.J2)
        sum = name(p.R * pull * turn / ((2 * p.m1 + p.m0) * p.R * p.R + double))
        difference = name(quotient * pull * speed / (p.J * quotient * quotient + double))
        return [difference - sum, -(sum + difference)]

    return SimpleNamespace(
        parameters="m0 m1 l J J2 c R", coordinates="psi1 psi2 x y theta", speeds="dpsi1 dpsi2 v side turn",
        kept="dpsi1 dpsi2", inputs="",
        rates=lambda q, u: [u.dpsi1, u.dpsi2, u.v * f.cos(q.theta) - u.side * f.sin(q.theta),
                            u.v * f.sin(q.theta) + u.side * f.cos(q.theta), u.turn],
        bodies=bodies,
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [u.side, u.v + p.c * u.turn + p.R * u.dpsi1, u.v - p.c * u.turn + p.R * u.dpsi2],
        solved=lambda p, q, u: dict(side=0, v=f.named(-0.5 * p.R * (u.dpsi1 + u.dpsi2)),
                                    turn=f.named(0.5 * f.named(p.R / p.c) * (u.dpsi2 - u.dpsi1))),
        explicit=explicit,
    )


def car(f):
    def explicit(p, q, u, i):
        # the car turns at κ v, and bend is κ̇ v
        name = f.named
        cos, over = f.cos(q.delta), name(1 / (p.L * f.cos(q.delta)))
        kappa, bend = name(f.sin(q.delta) * over), name(u.turn * over * u.v / cos)
        inertia = name(p.m * p.a * p.a + p.J)
        ahead = name((i.drive - kappa * (inertia * bend + i.steer)) / (inertia * kappa * kappa + p.m))
        return [ahead, i.steer / p.Js - (kappa * ahead + bend)]

    return SimpleNamespace(
        parameters="m J Js a L", coordinates="x y th delta", speeds="v side omega turn", kept="v turn",
        inputs="drive steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.turn],
        bodies=lambda p, q, u: [planar(p.m, p.J, u.v, u.side + p.a * u.omega, u.omega, u.omega),
                                planar(0, p.Js, 0, 0, u.omega, u.omega + u.turn)],
        forces=lambda p, q, u, i: dict(v=i.drive, turn=i.steer),
        constraints=lambda p, q, u: [
            u.side, (u.side + p.L * u.omega) * f.cos(q.delta) - u.v * f.sin(q.delta)],
        solved=lambda p, q, u: dict(side=0, omega=f.named(f.sin(q.delta) * f.named(1 / (p.L * f.cos(q.delta)))) * u.v),
        explicit=explicit,
    )


def roller_racer(f):
    def turned(p, q, u):
        name = f.named
        sin, cos, over = name(f.sin(q.phi)), name(f.cos(q.phi)), name(1 / p.d2)
        a, b = name(sin * over), name(p.d1 * cos * over)
        return sin, cos, over, a, b, name(a * u.v - (b + 1) * u.omega)

    def explicit(p, q, u, i):
        # by the force across the handlebar's wheels, which turns at av − bω
        name = f.named
        sin, cos, over, a, b, swing = turned(p, q, u)
        bend = swing * over * (cos * u.v + p.d1 * sin * u.omega)
        by_mass, by_inertia = name(a / p.m), name(b / p.I1)
        force = name((i.torque - p.I2 * (by_inertia * i.torque + bend)) / (p.I2 * (a * by_mass + b * by_inertia) + 1))
        return [by_mass * force, -(by_inertia * force + i.torque / p.I1)]

    return SimpleNamespace(
        parameters="m I1 I2 d1 d2", coordinates="x y th phi", speeds="v side omega swing", kept="v omega",
        inputs="torque",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.swing],
        bodies=lambda p, q, u: [planar(p.m, p.I1, u.v, u.side, u.omega, u.omega),
                                planar(0, p.I2, 0, 0, u.omega, u.omega + u.swing)],
        forces=lambda p, q, u, i: dict(swing=i.torque),
        constraints=lambda p, q, u: [
            u.side, u.v * f.sin(q.phi) - (p.d1 * f.cos(q.phi) + p.d2) * u.omega - p.d2 * u.swing],
        solved=lambda p, q, u: dict(
            side=0, swing=turned(p, q, u)[-1]),
        explicit=explicit,
    )


def balancing_robot(f):
    def bodies(p, q, u):
        sin, cos = f.sin(q.phi), f.cos(q.phi)
        body = (p.mb, (p.I1, p.I2, p.I3),
                (u.v + p.l * u.pitch * cos, u.side + p.l * u.omega * sin, -p.l * u.pitch * sin),
                (0, 0, u.omega), (-u.omega * sin, u.pitch, u.omega * cos))
        wheels = [(p.mw, (0, p.Jw, p.Iz), (u.v + arm * u.omega, u.side, 0), (0, 0, u.omega), (0, spin, u.omega))
                  for arm, spin in ((p.b, u.w0), (-p.b, u.w1))]
        return [body] + wheels

    def forces(p, q, u, i):
        topple = p.mb * p.g * p.l * f.sin(q.phi)
        return dict(w0=i.right, w1=i.left, pitch=topple - i.right - i.left)

    def explicit(p, q, u, i):
        name = f.named
        sin, cos, over = name(f.sin(q.phi)), name(f.cos(q.phi)), name(1 / p.r)
        ml = name(p.mb * p.l)
        mll, wheel = name(ml * p.l), name(p.Jw * over * over + p.mw)
        coupling, overhang, sum = name(ml * cos), name(ml * sin), name(i.right + i.left)
        square, slim = name(u.omega * u.omega), name((mll + p.I1 - p.I3) * sin)
        push = name(overhang * (u.pitch * u.pitch + square) + sum * over)
        topple = name(slim * cos * square + overhang * p.g - sum)
        ahead, pitched = two_by_two(f, name(2 * wheel + p.mb), coupling, name(mll + p.I2), (push, topple))
        yaw = slim * sin + (2 * (wheel * p.b * p.b + p.Iz) + p.I3)
        drag = 2 * slim * cos * u.pitch + overhang * u.v
        return [ahead, ((i.right - i.left) * p.b * over - u.omega * drag) / yaw, pitched]

    return SimpleNamespace(
        parameters="mb mw l I1 I2 I3 Iz Jw b r g", coordinates="x y th phi", speeds="v side omega pitch w0 w1",
        kept="v omega pitch", inputs="right left",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.pitch],
        bodies=bodies,
        forces=forces,
        constraints=lambda p, q, u: [
            u.side, p.r * u.w0 - u.v - p.b * u.omega, p.r * u.w1 - u.v + p.b * u.omega],
        solved=lambda p, q, u: dict(side=0, w0=(u.v + p.b * u.omega) / p.r, w1=(u.v - p.b * u.omega) / p.r),
        explicit=explicit,
    )


def pendulum(f):
    def bodies(p, q, u):
        sa, ca, sb, cb = f.sin(q.al), f.cos(q.al), f.sin(q.be), f.cos(q.be)
        along = sa * cb
        bob = (u.v + p.l * (ca * cb * u.ad - sa * sb * u.bd - u.omega * sb),
               u.side + p.l * (cb * u.bd + u.omega * along),
               p.l * (sa * cb * u.ad + ca * sb * u.bd))
        return [planar(p.mc, p.J, u.v, u.side, u.omega, u.omega),
                (p.mb, (0, 0, 0), bob, (0, 0, u.omega), (0, 0, u.omega))]

    def forces(p, q, u, i):
        weight = p.mb * p.g * p.l
        return dict(v=i.push, omega=i.steer, ad=-weight * f.sin(q.al) * f.cos(q.be),
                    bd=-weight * f.cos(q.al) * f.sin(q.be))

    def explicit(p, q, u, i):
        # by the rod's tension, per unit mass of the bob and its reaction on the cart
        name = f.named
        sa, ca, sb, cb = name(f.sin(q.al)), name(f.cos(q.al)), name(f.sin(q.be)), name(f.cos(q.be))
        down, out = name(u.omega * ca), name(sa * cb)
        first, second = name(cb * u.ad - down * sb), name(u.omega * sa + u.bd)
        turn, side = name(sb * u.ad + down * cb), name(u.v * u.omega)
        pull = p.l * (first * first + second * second) + (p.g * ca * cb - sb * side)
        mass = name(p.mb * out)
        ahead, turned, over = name((mass * pull + i.push) / (mass * out + p.mc)), name(i.steer / p.J), name(1 / p.l)
        a = down * u.omega * out + turned * sb * ca - over * (p.g * sa + ahead * ca)
        b = (ahead * sa - p.g * ca) * sb - cb * side
        return [ahead, turned, (2 * turn * u.bd + a) / cb, over * b - turn * first - (down * u.ad + turned * sa)]

    return SimpleNamespace(
        parameters="mc mb J l g", coordinates="x y th al be", speeds="v side omega ad bd", kept="v omega ad bd",
        inputs="push steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.ad, u.bd],
        bodies=bodies,
        forces=forces,
        constraints=lambda p, q, u: [u.side],
        solved=lambda p, q, u: dict(side=0),
        explicit=explicit,
    )


def roller_walker(f):
    speeds = "x_dot y_dot th_dot a0_dot a1_dot"

    def legs(p, q, u):
        return zip(several(q, "a", 2), several(p, "h", 2), (u.a0_dot, u.a1_dot), several(p, "Jl", 2))

    def constraints(p, q, u):
        return [f.cos(a) * (u.x_dot - h * f.sin(q.th) * u.th_dot) + f.sin(a) * (u.y_dot + h * f.cos(q.th) * u.th_dot)
                for a, h, *_ in legs(p, q, u)]

    def explicit(p, q, u, i):
        # multipliers by mass, with ε = m / J: (1 + ε k₁², cos(a₁ − a₂) + ε k₁ k₂; …)
        name = f.named
        sin, cos, turn = name(f.sin(q.th)), name(f.cos(q.th)), u.th_dot
        over = name(1 / p.J)
        ratio, free = name(p.m * over), name(-(i.torque0 + i.torque1) * over)
        rows = []
        for a, h, rate, _ in legs(p, q, u):
            s, c = name(f.sin(a)), name(f.cos(a))
            k, l = name(h * (s * cos - c * sin)), name(h * (c * cos + s * sin))
            change = name(rate * (s * u.x_dot - c * u.y_dot) + l * turn * (turn - rate))
            rows.append((s, c, k, name(ratio * k), name(change - k * free)))
        (s1, c1, k1, e1, f1), (s2, c2, k2, e2, f2) = rows
        m12 = name(e1 * k2 + c1 * c2 + s1 * s2)
        first, second = two_by_two(f, name(e1 * k1 + 1), m12, name(e2 * k2 + 1), (f1, f2))
        return [c1 * first + c2 * second, s1 * first + s2 * second, e1 * first + e2 * second + free,
                i.torque0 / p.Jl0, i.torque1 / p.Jl1]

    return SimpleNamespace(
        parameters="m J Jl0 Jl1 h0 h1", coordinates="x y th a0 a1", speeds=speeds, kept=speeds,
        # valid where the legs are not parallel, as at the states of the benchmark
        dependent="x_dot y_dot", inputs="torque0 torque1",
        rates=lambda q, u: [u.x_dot, u.y_dot, u.th_dot, u.a0_dot, u.a1_dot],
        bodies=lambda p, q, u: [planar(p.m, p.J, u.x_dot, u.y_dot, 0, u.th_dot)] + [
            planar(0, J, 0, 0, 0, rate) for _, _, rate, J in legs(p, q, u)],
        explicit=explicit,
        forces=lambda p, q, u, i: dict(th_dot=-i.torque0 - i.torque1, a0_dot=i.torque0, a1_dot=i.torque1),
        constraints=constraints,
        solved=None,
    )
