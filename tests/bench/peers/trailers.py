"""Tractors and cars with what they pull."""

from types import SimpleNamespace

from pieces import on_the_plane, planar, two_by_two


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
            run, turn, found = 1, -u.omega, dict(side=0)
            for i in range(n):
                angle, before = get(q, f"rel{i}"), turn
                turn = f.named(f.named(run * f.sin(angle)) * f.named(1 / get(p, f"d{i}"))) * u.v
                found[f"rd{i}"], run = f.named(before - turn), f.named(run * f.cos(angle))
            return found

        def constraints(p, q, u):
            return [u.side] + [f.cos(angle) * vy - f.sin(angle) * vx for angle, _, vx, vy in chain(p, q, u)]

        each = range(n)
        def explicit(p, q, u, i):
            # speed, yaw and their rates along the chain for v = 1, the mass that v moves and half its rate
            name = f.named
            run, run_rate, mass, bias = 1, 0, p.m, 0
            for k in range(n):
                m, J, d, angle = get(p, f"m{k}"), get(p, f"J{k}"), get(p, f"d{k}"), get(q, f"rel{k}")
                sin, cos, over, rate = f.sin(angle), f.cos(angle), name(1 / d), get(u, f"rd{k}")
                side, next = name(run * sin), name(run * cos)
                spin = name(side * over)
                spin_rate = name((run_rate * sin + next * rate) * over)
                run, run_rate = next, name(run_rate * cos - side * rate)
                momentum, moment = name(m * run), name(J * spin)
                mass = name(mass + momentum * run + moment * spin)
                bias = name(bias + momentum * run_rate + moment * spin_rate)
            ma = name(p.m * p.a)
            pull = name(ma * u.omega)
            return [(pull * u.omega - u.v * bias + i.push) / mass, (i.steer - pull * u.v) / (ma * p.a + p.J)]

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
            explicit=explicit,
        )

    return of


def hitched_trailer(f):
    def spinning(p, q, u):
        return f.named(-f.named(1 / p.d) * (f.sin(q.rel) * u.v + f.named(p.h * f.cos(q.rel)) * u.omega))

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

    def explicit(p, q, u, i):
        # the trailer runs along its axis, and turns at −(v sin + ω h cos) / d
        name = f.named
        sin, cos, over = f.sin(q.rel), f.cos(q.rel), name(1 / p.d)
        across, ahead = name(p.h * sin), name(p.h * cos)
        spin, rate = spinning(p, q, u), u.rd
        pull, twist = name(p.mt * rate * p.d * spin), name(-p.Jt * over * rate * (cos * u.v - across * u.omega))
        by_v, by_omega = name(sin * over), name(ahead * over)
        moment, momentum = name(p.Jt * by_v), name(p.mt * cos)
        m11, m12 = name(momentum * cos + moment * by_v + p.m), name(moment * by_omega - momentum * across)
        m22 = name(p.mt * across * across + p.Jt * by_omega * by_omega + p.J)
        right = name(by_v * twist - cos * pull + i.push), name(by_omega * twist + across * pull + i.steer)
        return list(two_by_two(f, m11, m12, m22, right))

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
            side=0, rd=f.named(spinning(p, q, u) - u.omega)),
        explicit=explicit,
    )


def off_axle(f):
    def moving(p, q, u):
        """Along and across each trailer, and its turning."""
        ahead, across, spin, found = u.v, u.side, u.omega, []
        for k in range(2):
            sin, cos = f.sin(getattr(q, f"rel{k}")), f.cos(getattr(q, f"rel{k}"))
            hitch, spin = across - p.h * spin, spin + getattr(u, f"rd{k}")
            ahead, across = ahead * cos + hitch * sin, hitch * cos - ahead * sin - p.d * spin
            found.append((ahead, across, spin))
        return found

    def bodies(p, q, u):
        return [planar(p.m, p.J, u.v, u.side, u.omega, u.omega)] + [
            planar(p.mt, p.Jt, ahead, across, spin, spin) for ahead, across, spin in moving(p, q, u)]

    def rolling(p, q, u):
        ahead, spin, found = u.v, u.omega, []
        for k in range(2):
            sin, cos = f.sin(getattr(q, f"rel{k}")), f.cos(getattr(q, f"rel{k}"))
            arm = f.named(p.h * spin)
            ahead, spin = f.named(cos * ahead - sin * arm), f.named(-f.named(1 / p.d) * (sin * ahead + cos * arm))
            found.append((ahead, spin))
        return found

    def by_an_expert(p, q, u):
        return [planar(p.m, p.J, u.v, 0, u.omega, u.omega)] + [
            planar(p.mt, p.Jt, ahead, 0, spin, spin) for ahead, spin in rolling(p, q, u)]

    def balance(p, q, u, i, z, via):
        # what the accelerations of the tractor make of those of the trailers, and of these by the former
        changes, back, spin = (z[0], z[1]), ((1, 0), (0, 1)), u.omega
        forces = [p.m * z[0] - i.push, p.J * z[1] - i.steer]
        for k, (ahead, turned) in enumerate(rolling(p, q, u)):
            sin, cos = f.sin(getattr(q, f"rel{k}")), f.cos(getattr(q, f"rel{k}"))
            through = lambda a, w: (cos * a - p.h * sin * w, -(sin * a + p.h * cos * w) / p.d)
            rate, (along, twist) = turned - spin, through(*changes)
            changes = along + p.d * turned * rate, twist - ahead * rate / p.d
            back, spin = tuple(through(*each) for each in back), turned
            forces = [force + p.mt * changes[0] * a + p.Jt * changes[1] * w for force, (a, w) in zip(forces, back)]
        return forces

    def solved(p, q, u):
        (_, first), (_, second) = rolling(p, q, u)
        return dict(side=0, rd0=f.named(first - u.omega), rd1=f.named(second - first))

    return SimpleNamespace(
        parameters="m J mt Jt h d", coordinates="x y th rel0 rel1", speeds="v side omega rd0 rd1", kept="v omega",
        inputs="push steer",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.rd0, u.rd1],
        bodies=bodies,
        bodies_by_an_expert=by_an_expert,
        balance=balance,
        relative=lambda z: z,
        forces=lambda p, q, u, i: dict(v=i.push, omega=i.steer),
        constraints=lambda p, q, u: [u.side] + [across for _, across, _ in moving(p, q, u)],
        solved=solved,
    )


def rear_steered(f):
    def bodies(p, q, u):
        spin = u.omega + u.rd
        return [planar(p.m, p.J, u.v, u.side + p.a * u.omega, u.omega, u.omega),
                planar(0, p.Jf, 0, 0, u.omega, u.omega + u.fd), planar(0, p.Jb, 0, 0, u.omega, u.omega + u.bd),
                planar(p.mt, p.Jt, u.v + p.d * f.sin(q.rel) * spin,
                       u.side - p.h * u.omega - p.d * f.cos(q.rel) * spin, u.omega, spin)]

    def multiples(p, q):
        """Velocities for v = 1: sideways, of yaw, of the hitch and of the trailer sideways, of the trailer's yaw."""
        name = f.named
        side = name(f.sin(q.b) * name(1 / f.cos(q.b)))
        yaw = name(name(1 / p.L) * (f.sin(q.f) * name(1 / f.cos(q.f)) - side))
        hitch = name(side - p.h * yaw)
        across = name(hitch * f.cos(q.rel) - f.sin(q.rel))
        return side, yaw, hitch, across, name(across * name(1 / p.d))

    def solved(p, q, u):
        side, yaw, *_, spin = multiples(p, q)
        omega = f.named(yaw * u.v)
        return dict(side=side * u.v, omega=omega, rd=f.named(spin * u.v - omega))

    def by_an_expert(p, q, u):
        # the trailer in its own axes: no sideways velocity
        along = u.v * f.cos(q.rel) + (u.side - p.h * u.omega) * f.sin(q.rel)
        spin = ((u.side - p.h * u.omega) * f.cos(q.rel) - u.v * f.sin(q.rel)) / p.d
        return bodies(p, q, u)[:3] + [planar(p.mt, p.Jt, along, 0, spin, spin)]

    def explicit(p, q, u, i):
        name = f.named
        sin, cos = f.sin(q.rel), f.cos(q.rel)
        over_f, over_b, over, over_d = (name(1 / each) for each in (f.cos(q.f), f.cos(q.b), p.L, p.d))
        side, yaw, hitch, across, spin = multiples(p, q)
        side_rate = name(over_b * over_b * u.bd)
        yaw_rate = name(over * (over_f * over_f * u.fd - side_rate))
        mid, mid_rate = name(p.a * yaw + side), name(p.a * yaw_rate + side_rate)
        hitch_rate, along = name(side_rate - p.h * yaw_rate), name(hitch * sin + cos)
        rate = u.rd
        along_rate = name(rate * across + hitch_rate * sin)
        spin_rate = name(over_d * (hitch_rate * cos - rate * along))
        pairs = [(p.m, mid, mid_rate), (p.J, yaw, yaw_rate), (p.mt, along, along_rate), (p.Jt, spin, spin_rate)]
        momenta = [name(mass * each) for mass, each, _ in pairs]
        mass = p.m + sum(a * each for a, (_, each, _) in zip(momenta, pairs))
        change = sum(a * each for a, (*_, each) in zip(momenta, pairs))
        ahead = name((i.drive - u.v * change - yaw * (i.front + i.rear)) / mass)
        turned = name(yaw * ahead + yaw_rate * u.v)
        return [ahead, i.front / p.Jf - turned, i.rear / p.Jb - turned]

    return SimpleNamespace(
        parameters="m J Jf Jb a L mt Jt h d", coordinates="x y th f b rel", speeds="v side omega fd bd rd",
        kept="v fd bd", inputs="drive front rear",
        rates=lambda q, u: on_the_plane(f, q, u) + [u.fd, u.bd, u.rd],
        bodies=bodies,
        bodies_by_an_expert=by_an_expert,
        explicit=explicit,
        forces=lambda p, q, u, i: dict(v=i.drive, fd=i.front, bd=i.rear),
        constraints=lambda p, q, u: [
            u.side * f.cos(q.b) - u.v * f.sin(q.b), (u.side + p.L * u.omega) * f.cos(q.f) - u.v * f.sin(q.f),
            (u.side - p.h * u.omega) * f.cos(q.rel) - u.v * f.sin(q.rel) - p.d * (u.omega + u.rd)],
        solved=solved,
    )
