"""The systems of the benchmark, as a user of a tool without brackets would describe them: bodies with
their velocities, constraints on the speeds, and, for an expert's version, the dependent speeds solved.

A body is (mass, principal moments, velocity, spin of the axes in which that is written, angular
velocity in its own axes). The functions take a module or class with `sin` and `cos`.
"""

from types import SimpleNamespace


def planar(mass, moment, vx, vy, axes, spin):
    return mass, (0, 0, moment), (vx, vy, 0), (0, 0, axes), (0, 0, spin)


def sleigh(f):
    def bodies(p, q, u):
        # the centre of mass at (a, b) in the body
        return [planar(p.m, p.J, u.v1 - p.b * u.omega, u.v2 + p.a * u.omega, u.omega, u.omega)]

    return SimpleNamespace(
        parameters="m J a b c", coordinates="theta x y", speeds="omega v1 v2", kept="omega v1", inputs="torque",
        rates=lambda q, u: [u.omega, u.v1 * f.cos(q.theta) - u.v2 * f.sin(q.theta),
                            u.v1 * f.sin(q.theta) + u.v2 * f.cos(q.theta)],
        bodies=bodies,
        forces=lambda p, q, u, i: dict(omega=i.torque - p.c * u.omega),
        constraints=lambda p, q, u: [u.v2],
        solved=lambda p, q, u: dict(v2=0),
    )


def veselova(f):
    def forces(p, q, u, i):
        return dict(w1=q.g2 * p.c3 - q.g3 * p.c2, w2=q.g3 * p.c1 - q.g1 * p.c3, w3=q.g1 * p.c2 - q.g2 * p.c1)

    return SimpleNamespace(
        parameters="I1 I2 I3 c1 c2 c3", coordinates="g1 g2 g3", speeds="w1 w2 w3", kept="w1 w2 w3", inputs="",
        rates=lambda q, u: [q.g2 * u.w3 - q.g3 * u.w2, q.g3 * u.w1 - q.g1 * u.w3, q.g1 * u.w2 - q.g2 * u.w1],
        bodies=lambda p, q, u: [(0, (p.I1, p.I2, p.I3), (0, 0, 0), (0, 0, 0), (u.w1, u.w2, u.w3))],
        forces=forces,
        constraints=lambda p, q, u: [q.g1 * u.w1 + q.g2 * u.w2 + q.g3 * u.w3],
        solved=None,
    )


def snakeboard(f):
    def bodies(p, q, u):
        board = p.m * p.l * p.l - p.J0 - 2 * p.J1
        wheels = [planar(0, p.J1, 0, 0, 0, u.dtheta + sign * u.dphi) for sign in (1, -1)]
        return [planar(p.m, board, u.u1, u.u2, u.dtheta, u.dtheta),
                planar(0, p.J0, 0, 0, 0, u.dtheta + u.dpsi)] + wheels

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
        solved=lambda p, q, u: dict(u2=0, dtheta=-f.sin(q.phi) / f.cos(q.phi) * u.u1 / p.l),
    )


def robot(f):
    def bodies(p, q, u):
        # the centre of mass of the body l ahead of the axle; J is about the middle of the axle
        body = planar(p.m0, p.J - p.m0 * p.l * p.l, u.v, u.side + p.l * u.turn, u.turn, u.turn)
        axle = planar(2 * p.m1, 0, u.v, u.side, u.turn, u.turn)
        wheels = [(0, (0, p.J2, 0), (0, 0, 0), (0, 0, 0), (0, spin, 0)) for spin in (u.dpsi1, u.dpsi2)]
        return [body, axle] + wheels

    return SimpleNamespace(
        parameters="m0 m1 l J J2 c R", coordinates="psi1 psi2 x y theta", speeds="dpsi1 dpsi2 v side turn",
        kept="dpsi1 dpsi2", inputs="",
        rates=lambda q, u: [u.dpsi1, u.dpsi2, u.v * f.cos(q.theta) - u.side * f.sin(q.theta),
                            u.v * f.sin(q.theta) + u.side * f.cos(q.theta), u.turn],
        bodies=bodies,
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [u.side, u.v + p.c * u.turn + p.R * u.dpsi1, u.v - p.c * u.turn + p.R * u.dpsi2],
        solved=lambda p, q, u: dict(side=0, v=-p.R / 2 * (u.dpsi1 + u.dpsi2),
                                    turn=p.R / (2 * p.c) * (u.dpsi2 - u.dpsi1)),
    )


def ball(f):
    def bodies(p, q, u):
        moment = p.m * p.k2
        return [(p.m, (moment, moment, moment), (u.dx, u.dy, 0), (0, 0, 0), (u.wx, u.wy, u.wz))]

    return SimpleNamespace(
        parameters="m r k2 Omega", coordinates="x y", speeds="dx dy wx wy wz", kept="wx wy wz", inputs="",
        rates=lambda q, u: [u.dx, u.dy],
        bodies=bodies,
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [u.dx - p.r * u.wy + p.Omega * q.y, u.dy + p.r * u.wx - p.Omega * q.x],
        solved=lambda p, q, u: dict(dx=p.r * u.wy - p.Omega * q.y, dy=-p.r * u.wx + p.Omega * q.x),
    )


def tractor(n):
    def of(f):
        get = getattr

        def chain(p, q, u):
            angle, spin, vx, vy, all = 0, u.omega, u.v, u.side, []
            for i in range(n):
                angle, spin = angle + get(q, f"rel{i}"), spin + get(u, f"rd{i}")
                d = get(p, f"d{i}")
                vx, vy = vx + d * f.sin(angle) * spin, vy - d * f.cos(angle) * spin
                all.append((angle, spin, vx, vy))
            return all

        def bodies(p, q, u):
            first = planar(p.m, p.J, u.v, u.side + p.a * u.omega, u.omega, u.omega)
            return [first] + [planar(get(p, f"m{i}"), get(p, f"J{i}"), vx, vy, u.omega, spin)
                              for i, (_, spin, vx, vy) in enumerate(chain(p, q, u))]

        def by_an_expert(p, q, u):
            # every trailer in its own axes: no sideways velocity
            first = planar(p.m, p.J, u.v, p.a * u.omega, u.omega, u.omega)
            speed, all = u.v, [first]
            for i in range(n):
                spin = -speed * f.sin(get(q, f"rel{i}")) / get(p, f"d{i}")
                speed = speed * f.cos(get(q, f"rel{i}"))
                all.append(planar(get(p, f"m{i}"), get(p, f"J{i}"), speed, 0, spin, spin))
            return all

        def solved(p, q, u):
            speed, before, found = u.v, u.omega, dict(side=0)
            for i in range(n):
                spin = -speed * f.sin(get(q, f"rel{i}")) / get(p, f"d{i}")
                speed = speed * f.cos(get(q, f"rel{i}"))
                found[f"rd{i}"], before = spin - before, spin
            return found

        def constraints(p, q, u):
            return [u.side] + [f.cos(angle) * vy - f.sin(angle) * vx for angle, _, vx, vy in chain(p, q, u)]

        each = range(n)
        return SimpleNamespace(
            parameters="m J a " + " ".join(f"m{i} J{i} d{i}" for i in each),
            coordinates="x y th " + " ".join(f"rel{i}" for i in each),
            speeds="v side omega " + " ".join(f"rd{i}" for i in each), kept="v omega", inputs="push steer",
            rates=lambda q, u: [u.v * f.cos(q.th) - u.side * f.sin(q.th), u.v * f.sin(q.th) + u.side * f.cos(q.th),
                                u.omega] + [get(u, f"rd{i}") for i in each],
            bodies=bodies,
            bodies_by_an_expert=by_an_expert,
            forces=lambda p, q, u, i: dict(v=i.push, omega=i.steer),
            constraints=constraints,
            solved=solved,
        )

    return of


def on_the_plane(f, q, u):
    return [u.v * f.cos(q.th) - u.side * f.sin(q.th), u.v * f.sin(q.th) + u.side * f.cos(q.th), u.omega]


def car(f):
    return SimpleNamespace(
        parameters="m J Js a L", coordinates="x y th delta", speeds="v side omega turn", kept="v turn",
        inputs="drive steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.turn],
        bodies=lambda p, q, u: [planar(p.m, p.J, u.v, u.side + p.a * u.omega, u.omega, u.omega),
                                planar(0, p.Js, 0, 0, u.omega, u.omega + u.turn)],
        forces=lambda p, q, u, i: dict(v=i.drive, turn=i.steer),
        constraints=lambda p, q, u: [
            u.side, (u.side + p.L * u.omega) * f.cos(q.delta) - u.v * f.sin(q.delta)],
        solved=lambda p, q, u: dict(side=0, omega=f.sin(q.delta) / f.cos(q.delta) * u.v / p.L),
    )


def roller_racer(f):
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
            side=0, swing=(u.v * f.sin(q.phi) - (p.d1 * f.cos(q.phi) + p.d2) * u.omega) / p.d2),
    )


def hitched_trailer(f):
    def bodies(p, q, u):
        spin = u.omega + u.rd
        return [planar(p.m, p.J, u.v, u.side, u.omega, u.omega),
                planar(p.mt, p.Jt, u.v + p.d * f.sin(q.rel) * spin,
                       u.side - p.h * u.omega - p.d * f.cos(q.rel) * spin, u.omega, spin)]

    def by_an_expert(p, q, u):
        # the trailer in its own axes: no sideways velocity
        along = u.v * f.cos(q.rel) - p.h * f.sin(q.rel) * u.omega
        spin = -(u.v * f.sin(q.rel) + p.h * f.cos(q.rel) * u.omega) / p.d
        return [planar(p.m, p.J, u.v, 0, u.omega, u.omega), planar(p.mt, p.Jt, along, 0, spin, spin)]

    return SimpleNamespace(
        parameters="m J mt Jt h d", coordinates="x y th rel", speeds="v side omega rd", kept="v omega",
        inputs="push steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.rd],
        bodies=bodies,
        bodies_by_an_expert=by_an_expert,
        forces=lambda p, q, u, i: dict(v=i.push, omega=i.steer),
        constraints=lambda p, q, u: [
            u.side,
            (u.side - p.h * u.omega) * f.cos(q.rel) - u.v * f.sin(q.rel) - p.d * (u.omega + u.rd)],
        solved=lambda p, q, u: dict(
            side=0, rd=-(u.v * f.sin(q.rel) + p.h * f.cos(q.rel) * u.omega) / p.d - u.omega),
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

    return SimpleNamespace(
        parameters="mb mw l I1 I2 I3 Iz Jw b r g", coordinates="x y th phi", speeds="v side omega pitch w0 w1",
        kept="v omega pitch", inputs="right left",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.pitch],
        bodies=bodies,
        forces=forces,
        constraints=lambda p, q, u: [
            u.side, p.r * u.w0 - u.v - p.b * u.omega, p.r * u.w1 - u.v + p.b * u.omega],
        solved=lambda p, q, u: dict(side=0, w0=(u.v + p.b * u.omega) / p.r, w1=(u.v - p.b * u.omega) / p.r),
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

    return SimpleNamespace(
        parameters="I1 I2 I3 J1 J2 J3", coordinates="q0 q1 q2 q3", speeds="w1 w2 w3 s1 s2 s3",
        kept="w1 w2 w3 s1 s2 s3", inputs="torque1 torque2 torque3",
        rates=lambda q, u: [-(q.q1 * u.w1 + q.q2 * u.w2 + q.q3 * u.w3) / 2,
                            (q.q0 * u.w1 + q.q2 * u.w3 - q.q3 * u.w2) / 2,
                            (q.q0 * u.w2 + q.q3 * u.w1 - q.q1 * u.w3) / 2,
                            (q.q0 * u.w3 + q.q1 * u.w2 - q.q2 * u.w1) / 2],
        bodies=bodies,
        forces=lambda p, q, u, i: dict(s1=i.torque1, s2=i.torque2, s3=i.torque3),
        constraints=lambda p, q, u: [],
        solved=None,
    )


def chaplygin_ball(f):
    def contact(p, q, u):
        # v = r ω × g
        return (p.r * (u.w2 * q.g3 - u.w3 * q.g2), p.r * (u.w3 * q.g1 - u.w1 * q.g3),
                p.r * (u.w1 * q.g2 - u.w2 * q.g1))

    def bodies(p, q, u):
        spin = (u.w1, u.w2, u.w3)
        return [(p.m, (p.I1, p.I2, p.I3), (u.v1, u.v2, u.v3), spin, spin)]

    return SimpleNamespace(
        parameters="I1 I2 I3 m r", coordinates="g1 g2 g3", speeds="w1 w2 w3 v1 v2 v3", kept="w1 w2 w3", inputs="",
        rates=lambda q, u: [q.g2 * u.w3 - q.g3 * u.w2, q.g3 * u.w1 - q.g1 * u.w3, q.g1 * u.w2 - q.g2 * u.w1],
        bodies=bodies,
        forces=lambda p, q, u, i: {},
        constraints=lambda p, q, u: [v - c for v, c in zip((u.v1, u.v2, u.v3), contact(p, q, u))],
        solved=lambda p, q, u: dict(zip(("v1", "v2", "v3"), contact(p, q, u))),
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

    return SimpleNamespace(
        parameters="mc mb J l g", coordinates="x y th al be", speeds="v side omega ad bd", kept="v omega ad bd",
        inputs="push steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.ad, u.bd],
        bodies=bodies,
        forces=forces,
        constraints=lambda p, q, u: [u.side],
        solved=lambda p, q, u: dict(side=0),
    )


SYSTEMS = {
    "sleigh": sleigh, "veselova": veselova, "snakeboard": snakeboard, "robot": robot, "ball on table": ball,
    "tractor, 1 trailer": tractor(1),
    **{f"tractor, {n} trailers": tractor(n) for n in range(2, 7)},
    "car": car, "roller racer": roller_racer, "hitched trailer": hitched_trailer, "balancing robot": balancing_robot,
    "satellite": satellite, "Chaplygin ball": chaplygin_ball, "pendulum": pendulum,
}
