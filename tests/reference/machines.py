"""Writes the reference data of machines that are declared by their geometry.

A machine is given by where its bodies are: positions and rotation matrices as functions of coordinates, of which
there may be more than degrees of freedom, and by constraints between the velocities of points, written out as
vectors. Nothing is differentiated by formula: rates of positions and attitudes, partial velocities and the rates of
constraints are differences at 200 digits, in steps so small that 50 digits and more are left. The equations are those
of Newton and Euler for each body, summed along partial velocities (Jourdain), with one multiplier for each constraint:

    [ sum J^T M J   -F^T ] [ q'' ]   [ Q - sum J^T (M J' q' + w x I w) ]
    [ F              0   ] [ l   ] = [ -F' q'                          ]

No Lagrangian, quasi-velocity, bracket or elimination of constraints occurs.

Usage: python3 machines.py, in this directory.
"""

import random

import mpmath
from mpmath import mpf

mpmath.mp.dps = 200
# rates of positions, and rates of what contains such rates: errors h^2 of the differences, and what is left of the first
FINE, COARSE = mpf(10) ** -60, mpf(10) ** -30
SHOWN = 40


def vec(*entries):
    return mpmath.matrix([mpf(e) if not isinstance(e, mpmath.mpf) else e for e in entries])


def cross(a, b):
    return vec(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def rx(a):
    c, s = mpmath.cos(a), mpmath.sin(a)
    return mpmath.matrix([[1, 0, 0], [0, c, -s], [0, s, c]])


def ry(a):
    c, s = mpmath.cos(a), mpmath.sin(a)
    return mpmath.matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def rz(a):
    c, s = mpmath.cos(a), mpmath.sin(a)
    return mpmath.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def about(n, a):
    """Rodrigues: the rotation about a unit vector."""
    c, s = mpmath.cos(a), mpmath.sin(a)
    k = mpmath.matrix([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return mpmath.eye(3) + s * k + (1 - c) * (k * k)


def axial(skew):
    return vec((skew[2, 1] - skew[1, 2]) / 2, (skew[0, 2] - skew[2, 0]) / 2, (skew[1, 0] - skew[0, 1]) / 2)


def along(f, q, v, h):
    """The rate of f(q) where q moves with v."""
    return (f([a + h * b for a, b in zip(q, v)]) - f([a - h * b for a, b in zip(q, v)])) / (2 * h)


class Machine:
    """coordinates; parameters by name; bodies(q) -> [(m, I, p, R)], R may be None; rows(q, v) -> constraints, all of
    them linear in v; force(q, v) -> generalized forces along the coordinates; auxiliary: names of further states, and
    rates(q, v) -> theirs, with the values of these states among q."""

    def __init__(self, name, head, coordinates, parameters, bodies, rows, potential, force=None, auxiliary=None, spread=None):
        self.name, self.head, self.coordinates = name, head, coordinates
        self.p = {k: mpf(x) for k, x in parameters.items()}
        self.texts = parameters
        self.bodies, self.rows, self.potential = bodies, rows, potential
        self.force = force or (lambda q, v: [mpf(0)] * len(coordinates))
        self.spread = spread or {}
        self.poses = {}
        self.further, self.rates = auxiliary or ([], None)
        self.values = []

    def named(self, q):
        return dict(zip([*self.coordinates, *self.further], [*q, *self.values]))

    def pose(self, q):
        key = tuple(q)
        if key not in self.poses:
            self.poses[key] = self.bodies(dict(zip(self.coordinates, q)))
        return self.poses[key]

    def twist(self, k, q, v):
        """The velocity of the centre of mass and the angular velocity in the axes of the body."""
        position = lambda q: self.pose(q)[k][2]
        linear = along(position, q, v, FINE)
        r = self.pose(q)[k][3]
        if r is None:
            return [*linear, mpf(0), mpf(0), mpf(0)]
        attitude = lambda q: self.pose(q)[k][3]
        return [*linear, *axial(r.T * along(attitude, q, v, FINE))]

    def constraints(self, q, v):
        names = dict(zip(self.coordinates, q))
        rate = lambda f: along(lambda x: f(dict(zip(self.coordinates, x))), q, v, FINE)
        return self.rows(names, dict(zip(self.coordinates, v)), rate)

    def accelerations(self, q, v):
        n = len(q)
        unit = [[mpf(int(i == j)) for j in range(n)] for i in range(n)]
        mass, right = mpmath.zeros(n), [mpf(0)] * n
        for k, (m, inertia, _, r) in enumerate(self.pose(q)):
            partial = [self.twist(k, q, e) for e in unit]
            now = self.twist(k, q, v)
            turned = along(lambda x: mpmath.matrix(self.twist(k, x, v)), q, v, COARSE)
            w = now[3:]
            apply = lambda t: [*[m * x for x in t[:3]], *((inertia * mpmath.matrix(t[3:])) if r is not None else [0] * 3)]
            bias = apply(list(turned))
            if r is not None:
                gyro = cross(w, inertia * mpmath.matrix(w))
                bias = [*bias[:3], *[a + b for a, b in zip(bias[3:], gyro)]]
            for i in range(n):
                momentum = apply(partial[i])
                right[i] -= dot(partial[i], bias)
                for j in range(n):
                    mass[i, j] += dot(partial[j], momentum)
        value = lambda x: mpmath.matrix([self.potential(dict(zip(self.coordinates, x)))])
        for i in range(n):
            right[i] -= along(value, q, unit[i], FINE)[0]
        forces = self.force(self.named(q), dict(zip(self.coordinates, v)))
        right = [a + b for a, b in zip(right, forces)]
        rows = [self.constraints(q, e) for e in unit]
        count = len(rows[0])
        drift = along(lambda x: mpmath.matrix(self.constraints(x, v)), q, v, COARSE) if count else []
        a, b = mpmath.zeros(n + count), mpmath.zeros(n + count, 1)
        for i in range(n):
            b[i] = right[i]
            for j in range(n):
                a[i, j] = mass[i, j]
            for c in range(count):
                a[i, n + c], a[n + c, i] = -rows[i][c], rows[i][c]
        for c in range(count):
            b[n + c] = -drift[c]
        found = mpmath.lu_solve(a, b)
        return list(found[:n]), list(found[n:])

    def energy(self, q, v):
        total = self.potential(dict(zip(self.coordinates, q)))
        for k, (m, inertia, _, r) in enumerate(self.pose(q)):
            t = self.twist(k, q, v)
            total += m * dot(t[:3], t[:3]) / 2
            if r is not None:
                w = mpmath.matrix(t[3:])
                total += dot(w, inertia * w) / 2
        return total

    def write(self, samples=3):
        chance = random.Random(self.name)
        lines = [f"# {line}" for line in self.head.strip().splitlines()]
        lines.append("# parameters: " + ", ".join(f"{k} = {x}" for k, x in self.texts.items()))
        rates = [c.replace("[", "_dot[") if "[" in c else c + "_dot" for c in self.coordinates]
        lines.append("names " + " ".join([*self.coordinates, *rates, *self.further]))
        for _ in range(samples):
            q = [mpf(f"{chance.uniform(*self.spread.get(c, (-1.0, 1.0))):.4f}") for c in self.coordinates]
            v = [mpf(f"{chance.uniform(-1.5, 1.5):.4f}") for _ in self.coordinates]
            unit = [[mpf(int(i == j)) for j in range(len(q))] for i in range(len(q))]
            rows = [self.constraints(q, e) for e in unit]
            if rows[0]:
                # the nearest velocities that the constraints allow
                f = mpmath.matrix([[rows[i][c] for i in range(len(q))] for c in range(len(rows[0]))])
                correction = f.T * mpmath.lu_solve(f * f.T, f * mpmath.matrix(v))
                v = [a - b for a, b in zip(v, correction)]
            self.values = [mpf(f"{chance.uniform(*self.spread.get(z, (-1.0, 1.0))):.4f}") for z in self.further]
            acceleration, multipliers = self.accelerations(q, v)
            further = self.rates(self.named(q), dict(zip(self.coordinates, v))) if self.further else []
            shown = lambda xs: " ".join(mpmath.nstr(x, SHOWN) if abs(x) > mpf(10) ** -45 else "0.0" for x in xs)
            lines.append("at 0.0")
            lines.append("state " + shown([*q, *v, *self.values]))
            lines.append("rate " + shown([*v, *acceleration, *further]))
            lines.append("energy " + shown([self.energy(q, v)]))
            if multipliers:
                lines.append("multipliers " + shown(multipliers))
        with open(f"more/{self.name}.txt", "w") as file:
            file.write("\n".join(lines) + "\n")
        print(self.name, len(lines))


def diagonal(*entries):
    return mpmath.diag([mpf(e) for e in entries])


def rolls(rate, q, centre, attitude, contact):
    """The velocity of the material point of a body that is at a contact."""
    c, r = centre(q), attitude(q)
    omega = axial(rate(attitude) * r.T)
    return list(rate(centre) + cross(omega, contact(q) - c))


MACHINES = []


def machine(f):
    MACHINES.append(f)
    return f


@machine
def disk_on_a_surface():
    p = dict(m="2.0", r="0.4", A="0.09", C="0.17", k1="0.3", k2="-0.2", k3="0.15", g="9.81")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["x", "y", "yaw", "lean", "spin"]
    contact = lambda q: vec(q["x"], q["y"], P["k1"] * q["x"] ** 2 + P["k2"] * q["y"] ** 2 + P["k3"] * q["x"] * q["y"])
    slopes = lambda q: (2 * P["k1"] * q["x"] + P["k3"] * q["y"], 2 * P["k2"] * q["y"] + P["k3"] * q["x"])

    def surface(q):
        # columns: the tangent over the x axis, the other tangent, the normal
        a, b = slopes(q)
        t, n = vec(1, 0, a), vec(-a, -b, 1)
        t, n = t / mpmath.sqrt(dot(t, t)), n / mpmath.sqrt(dot(n, n))
        s = cross(n, t)
        return mpmath.matrix([[t[k], s[k], n[k]] for k in range(3)])

    carrier = lambda q: surface(q) * rz(q["yaw"]) * rx(q["lean"])
    attitude = lambda q: carrier(q) * ry(q["spin"])
    centre = lambda q: contact(q) + carrier(q) * vec(0, 0, P["r"])

    return Machine(
        "disk_on_a_surface",
        "A disk that rolls on the surface z = k1 x^2 + k2 y^2 + k3 x y. (x, y) is below the point of contact; with the\n"
        "tangent t over the x axis, the normal n, and n x t as columns of S, the attitude is S rz(yaw) rx(lean) ry(spin).\n"
        "Multipliers: of the velocity of the material point at the contact, along the two tangents.",
        names, p,
        lambda q: [(P["m"], diagonal(P["A"], P["C"], P["A"]), centre(q), attitude(q))],
        lambda q, v, rate: list(surface(q).T * mpmath.matrix(rolls(rate, q, centre, attitude, contact)))[:2],
        lambda q: P["m"] * P["g"] * centre(q)[2],
    )


@machine
def ball_bot():
    p = dict(M="3.0", r="0.12", Jb="0.02", m="9.0", l="0.35", I1="0.6", I2="0.5", I3="0.2", g="9.81")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["x", "y", "a", "b", "c", "yaw", "pitch", "roll"]
    ball = lambda q: vec(q["x"], q["y"], P["r"])
    ball_r = lambda q: rz(q["a"]) * rx(q["b"]) * rz(q["c"])
    body_r = lambda q: rz(q["yaw"]) * ry(q["pitch"]) * rx(q["roll"])
    body = lambda q: ball(q) + body_r(q) * vec(0, 0, P["l"])

    def rows(q, v, rate):
        slip = rolls(rate, q, ball, ball_r, lambda q: vec(q["x"], q["y"], 0))
        return slip[:2]

    return Machine(
        "ball_bot",
        "A body that balances on a ball: the ball rolls on the plane, with the attitude rz(a) rx(b) rz(c), the body turns\n"
        "about the centre of the ball, with the attitude rz(yaw) ry(pitch) rx(roll). Multipliers: of the two components of\n"
        "the slip.",
        names, p,
        lambda q: [
            (P["M"], diagonal(P["Jb"], P["Jb"], P["Jb"]), ball(q), ball_r(q)),
            (P["m"], diagonal(P["I1"], P["I2"], P["I3"]), body(q), body_r(q)),
        ],
        rows,
        lambda q: P["m"] * P["g"] * body(q)[2],
        spread={"b": (0.4, 1.4)},
    )


@machine
def unicycle():
    p = dict(mw="1.5", r="0.3", Aw="0.04", Cw="0.08", mf="8.0", h="0.7", I1="0.9", I2="0.8", I3="0.3", md="2.0",
             hd="1.1", Ad="0.05", Cd="0.1", g="9.81")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["x", "y", "yaw", "lean", "spin", "pitch", "wheel"]
    lean_r = lambda q: rz(q["yaw"]) * rx(q["lean"])
    contact = lambda q: vec(q["x"], q["y"], 0)
    hub = lambda q: contact(q) + lean_r(q) * vec(0, 0, P["r"])
    wheel_r = lambda q: lean_r(q) * ry(q["spin"])
    frame_r = lambda q: lean_r(q) * ry(q["pitch"])
    frame = lambda q: hub(q) + frame_r(q) * vec(0, 0, P["h"])
    disk = lambda q: hub(q) + frame_r(q) * vec(0, 0, P["hd"])
    disk_r = lambda q: frame_r(q) * rx(q["wheel"])
    return Machine(
        "unicycle",
        "A unicycle with a flywheel about the axis of travel. (x, y) is where the wheel touches the plane; its attitude is\n"
        "rz(yaw) rx(lean) ry(spin), that of the frame rz(yaw) rx(lean) ry(pitch), and the flywheel turns by rx(wheel) in\n"
        "the frame. Multipliers: of two components of the velocity of the wheel's lowest point.",
        names, p,
        lambda q: [
            (P["mw"], diagonal(P["Aw"], P["Cw"], P["Aw"]), hub(q), wheel_r(q)),
            (P["mf"], diagonal(P["I1"], P["I2"], P["I3"]), frame(q), frame_r(q)),
            (P["md"], diagonal(P["Cd"], P["Ad"], P["Ad"]), disk(q), disk_r(q)),
        ],
        lambda q, v, rate: rolls(rate, q, hub, wheel_r, contact)[:2],
        lambda q: P["g"] * (P["mw"] * hub(q)[2] + P["mf"] * frame(q)[2] + P["md"] * disk(q)[2]),
    )


@machine
def quadrotor_with_load():
    p = dict(m="1.2", I1="0.02", I2="0.025", I3="0.04", ml="0.4", l="0.9", d="0.05", g="9.81", f="14.0", t1="0.1",
             t2="-0.05", t3="0.02")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["p[0]", "p[1]", "p[2]", "yaw", "pitch", "roll", "swing", "turn"]
    body = lambda q: vec(q["p[0]"], q["p[1]"], q["p[2]"])
    body_r = lambda q: rz(q["yaw"]) * ry(q["pitch"]) * rx(q["roll"])
    hook = lambda q: body(q) - body_r(q) * vec(0, 0, P["d"])
    load = lambda q: hook(q) + rx(q["swing"]) * ry(q["turn"]) * vec(0, 0, -P["l"])
    m = None

    def force(q, v):
        # thrust along the axis of the body, torques about its axes: virtual power along each coordinate
        values = [q[c] for c in names]
        found = []
        for c in names:
            twist = m.twist(0, values, [mpf(int(c == other)) for other in names])
            thrust = body_r(q) * vec(0, 0, P["f"])
            found.append(dot(thrust, twist[:3]) + dot([P["t1"], P["t2"], P["t3"]], twist[3:]))
        return found

    m = Machine(
        "quadrotor_with_load",
        "A quadrotor with the attitude rz(yaw) ry(pitch) rx(roll) that carries a load on a cable which stays tight. The\n"
        "cable hangs from a hook below the centre of mass, along rx(swing) ry(turn) (0, 0, -l). The thrust f acts along the\n"
        "axis of the body, the torques t1, t2, t3 about its axes.",
        names, p,
        lambda q: [
            (P["m"], diagonal(P["I1"], P["I2"], P["I3"]), body(q), body_r(q)),
            (P["ml"], None, load(q), None),
        ],
        lambda q, v, rate: [],
        lambda q: P["g"] * (P["m"] * q["p[2]"] + P["ml"] * load(q)[2]),
        force=force,
    )
    return m


@machine
def bicycle():
    p = dict(w="1.02", c="0.08", tilt="0.31415926535897931", g="9.81", rR="0.3", rF="0.35", mR="2.0", IRx="0.0603",
             IRy="0.12", mF="3.0", IFx="0.1405", IFy="0.28", mB="85.0", xB="0.3", zB="-0.9", IBx="9.2", IBxz="2.4",
             IBy="11.0", IBz="2.8", mH="4.0", xH="0.9", zH="-0.7", IHx="0.05892", IHxz="-0.00756", IHy="0.06",
             IHz="0.00708")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["x", "y", "z", "yaw", "lean", "pitch", "steer", "turn[0]", "turn[1]"]
    frame_r = lambda q: rz(q["yaw"]) * rx(q["lean"]) * ry(q["pitch"])
    axis = vec(mpmath.sin(P["tilt"]), 0, mpmath.cos(P["tilt"]))
    fork_r = lambda q: frame_r(q) * about(axis, q["steer"])
    rear = lambda q: vec(q["x"], q["y"], q["z"])
    head = lambda q: rear(q) + frame_r(q) * vec(P["w"] + P["c"], 0, P["rR"])
    front = lambda q: head(q) + fork_r(q) * vec(-P["c"], 0, -P["rF"])
    frame = lambda q: rear(q) + frame_r(q) * vec(P["xB"], 0, P["zB"] + P["rR"])
    fork = lambda q: head(q) + fork_r(q) * vec(P["xH"] - P["w"] - P["c"], 0, P["zH"])
    rear_r = lambda q: frame_r(q) * ry(q["turn[0]"])
    front_r = lambda q: fork_r(q) * ry(q["turn[1]"])

    def lowest(centre, carrier, radius):
        def found(q):
            axle = carrier(q) * vec(0, 1, 0)
            down = vec(0, 0, 1) - axle * axle[2]
            return centre(q) + down * (radius / mpmath.sqrt(dot(down, down)))
        return found

    def full(xx, xz, yy, zz):
        return mpmath.matrix([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]])

    def rows(q, v, rate):
        slip = [
            rolls(rate, q, rear, rear_r, lowest(rear, frame_r, P["rR"])),
            rolls(rate, q, front, front_r, lowest(front, fork_r, P["rF"])),
        ]
        return [slip[0][2], slip[1][2], *slip[0][:2], *slip[1][:2]]

    return Machine(
        "bicycle_by_geometry",
        "The bicycle of Meijaard, Papadopoulos, Ruina and Schwab (2007) with its 25 parameters: x forwards, z down. The\n"
        "coordinates are those of the centre of the rear wheel, the attitude rz(yaw) rx(lean) ry(pitch) of the rear frame,\n"
        "the steering angle about the tilted axis and the turns of the wheels. Multipliers: of the velocities of the lowest\n"
        "points of the rear and of the front wheel, downwards, then along the ground. The states need not stand on the\n"
        "ground: the constraints are on velocities.",
        names, p,
        lambda q: [
            (P["mR"], diagonal(P["IRx"], P["IRy"], P["IRx"]), rear(q), rear_r(q)),
            (P["mF"], diagonal(P["IFx"], P["IFy"], P["IFx"]), front(q), front_r(q)),
            (P["mB"], full(P["IBx"], P["IBxz"], P["IBy"], P["IBz"]), frame(q), frame_r(q)),
            (P["mH"], full(P["IHx"], P["IHxz"], P["IHy"], P["IHz"]), fork(q), fork_r(q)),
        ],
        rows,
        lambda q: -P["g"] * (P["mR"] * rear(q)[2] + P["mF"] * front(q)[2] + P["mB"] * frame(q)[2] + P["mH"] * fork(q)[2]),
        spread={c: (-0.5, 0.5) for c in ["lean", "pitch", "steer"]},
    )


@machine
def snake():
    p = dict(m="0.7", J="0.012", l="0.15", t1="0.05", t2="-0.12", t3="0.2", t4="0.08")
    P = {k: mpf(x) for k, x in p.items()}
    n = 5
    names = ["x", "y", *[f"q[{i}]" for i in range(n)]]
    turn = lambda q, i: rz(q[f"q[{i}]"])

    def link(i):
        def place(q):
            found = vec(q["x"], q["y"], 0)
            for j in range(i):
                found += turn(q, j) * vec(2 * P["l"], 0, 0)
            return found + turn(q, i) * vec(P["l"], 0, 0)
        return place

    def force(q, v):
        t = [P["t1"], P["t2"], P["t3"], P["t4"]]
        # a motor between two links turns the one behind it forwards and the one before it back
        return [mpf(0), mpf(0), *[(t[i - 1] if i > 0 else 0) - (t[i] if i < n - 1 else 0) for i in range(n)]]

    return Machine(
        "snake",
        "A snake of five links of length 2 l in the plane; (x, y) is its tail, the angles are absolute. Wheels at the centres\n"
        "of the links do not slip sideways; motors with the torques t1 to t4 are in the joints.",
        names, p,
        lambda q: [(P["m"], diagonal(1, 1, P["J"]), link(i)(q), turn(q, i)) for i in range(n)],
        lambda q, v, rate: [dot(turn(q, i) * vec(0, 1, 0), rate(link(i))) for i in range(n)],
        lambda q: mpf(0),
        force=force,
    )


@machine
def tractor():
    p = dict(wheelbase="2.4", behind1="0.8", behind2="0.5", drawbar1="3.0", drawbar2="2.6", b1="0.9", b2="0.3", b3="0.2",
             m1="3200.0", m2="1800.0", m3="1500.0", J1="4100.0", J2="2600.0", J3="2100.0", mf="220.0", Jf="14.0",
             drive="5000.0", steering="30.0")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["rear[0]", "rear[1]", "yaw", "steer", "hitch[0]", "hitch[1]"]
    R0 = lambda q: rz(q["yaw"])
    R1 = lambda q: R0(q) * rz(q["hitch[0]"])
    R2 = lambda q: R1(q) * rz(q["hitch[1]"])
    Rf = lambda q: R0(q) * rz(q["steer"])
    rear = lambda q: vec(q["rear[0]"], q["rear[1]"], 0)
    front = lambda q: rear(q) + R0(q) * vec(P["wheelbase"], 0, 0)
    first = lambda q: rear(q) - R0(q) * vec(P["behind1"], 0, 0) - R1(q) * vec(P["drawbar1"], 0, 0)
    second = lambda q: first(q) - R1(q) * vec(P["behind2"], 0, 0) - R2(q) * vec(P["drawbar2"], 0, 0)
    ahead = lambda place, r, b: lambda q: place(q) + r(q) * vec(P[b], 0, 0)
    turning = lambda m, j, place, r, q: (P[m], diagonal(1, 1, P[j]), place(q), r(q))

    def rows(q, v, rate):
        axles = [(rear, R0), (front, Rf), (first, R1), (second, R2)]
        return [dot(r(q) * vec(0, 1, 0), rate(place)) for place, r in axles]

    def force(q, v):
        push = R0(q) * vec(P["drive"], 0, 0)
        return [push[0], push[1], mpf(0), P["steering"], mpf(0), mpf(0)]

    return Machine(
        "tractor",
        "A tractor with steered front wheels and two trailers in the plane, each hitched behind the axle of what draws it.\n"
        "hitch[0] and hitch[1] are the angles between the bodies. The drive pushes the rear axle along the tractor, the\n"
        "steering turns the front wheels. Multipliers: of the sideways velocities of the rear axle, the front axle and the\n"
        "axles of the trailers.",
        names, p,
        lambda q: [
            turning("m1", "J1", ahead(rear, R0, "b1"), R0, q), turning("mf", "Jf", front, Rf, q),
            turning("m2", "J2", ahead(first, R1, "b2"), R1, q), turning("m3", "J3", ahead(second, R2, "b3"), R2, q),
        ],
        rows,
        lambda q: mpf(0),
        force=force,
        spread={"steer": (-0.6, 0.6)},
    )


@machine
def satellite_with_boom():
    p = dict(m="120.0", Ixx="25.0", Iyy="32.0", Izz="28.0", Ixy="1.5", Ixz="-0.8", Iyz="0.6", mb="6.0", root="0.6",
             length="4.0", mw="3.0", Aw="0.012", Cw="0.02", d="0.25", k1="5.0", k2="180.0", c1="0.05", c2="0.3", t1="0.02",
             t2="-0.03", t3="0.01")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["p[0]", "p[1]", "p[2]", "yaw", "pitch", "roll", "wheel[0]", "wheel[1]", "wheel[2]", "bend[0]", "bend[1]"]
    hub = lambda q: vec(q["p[0]"], q["p[1]"], q["p[2]"])
    hub_r = lambda q: rz(q["yaw"]) * ry(q["pitch"]) * rx(q["roll"])
    inertia = mpmath.matrix([[P["Ixx"], P["Ixy"], P["Ixz"]], [P["Ixy"], P["Iyy"], P["Iyz"]], [P["Ixz"], P["Iyz"], P["Izz"]]])

    def piece(i, q):
        s = mpf(i) / 8
        y = q["bend[0]"] * (1 - mpmath.cos(mpmath.pi * s / 2)) + q["bend[1]"] * (1 - mpmath.cos(3 * mpmath.pi * s / 2))
        return hub(q) + hub_r(q) * vec(P["root"] + P["length"] * s, y, 0)

    def bodies(q):
        r = hub_r(q)
        wheels = [
            (vec(P["d"], 0, 0), rx(q["wheel[0]"]), diagonal(P["Cw"], P["Aw"], P["Aw"])),
            (vec(0, P["d"], 0), ry(q["wheel[1]"]), diagonal(P["Aw"], P["Cw"], P["Aw"])),
            (vec(0, 0, P["d"]), rz(q["wheel[2]"]), diagonal(P["Aw"], P["Aw"], P["Cw"])),
        ]
        found = [(P["m"], inertia, hub(q), r)]
        found += [(P["mw"], own, hub(q) + r * place, r * turn) for place, turn, own in wheels]
        return found + [(P["mb"] / 8, None, piece(i, q), None) for i in range(1, 9)]

    def force(q, v):
        damping = [-P["c1"] * v["bend[0]"], -P["c2"] * v["bend[1]"]]
        return [*[mpf(0)] * 6, P["t1"], P["t2"], P["t3"], *damping]

    return Machine(
        "satellite_with_boom",
        "A satellite with three reaction wheels and a boom along its x axis that bends towards its y axis in two modes,\n"
        "1 - cos(pi s / 2) and 1 - cos(3 pi s / 2); its mass is in eight pieces at s = 1/8 ... 1. The torques t1, t2, t3 act\n"
        "between the body and the wheels, c1 and c2 damp the modes.",
        names, p, bodies,
        lambda q, v, rate: [],
        lambda q: (P["k1"] * q["bend[0]"] ** 2 + P["k2"] * q["bend[1]"] ** 2) / 2,
        force=force,
    )


@machine
def car():
    p = dict(m="1200.0", I1="400.0", I2="1500.0", I3="1700.0", a="1.2", b="1.4", w="0.75", h="0.25", g="9.81", caster="0.1",
             arm="0.15", inset="0.05", reach="0.4", rod_length="0.3", mw="30.0", A="0.7", C="1.1", r="0.31", mr="4.0",
             ks="25000.0", cs="1800.0", kt="180000.0", ct="9000.0", push="150.0", drive="220.0")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["p[0]", "p[1]", "p[2]", "yaw", "pitch", "roll", *[f"travel[{i}]" for i in range(4)],
             *[f"spin[{i}]" for i in range(4)], "steer[0]", "steer[1]", "rack"]
    body = lambda q: vec(q["p[0]"], q["p[1]"], q["p[2]"])
    body_r = lambda q: rz(q["yaw"]) * ry(q["pitch"]) * rx(q["roll"])
    kingpin = vec(-mpmath.sin(P["caster"]), 0, mpmath.cos(P["caster"]))
    side = [1, -1, 1, -1]
    mount = lambda i, q: vec(P["a"] if i < 2 else -P["b"], side[i] * P["w"], -P["h"] + q[f"travel[{i}]"])
    turned = lambda i, q: about(kingpin, q[f"steer[{i}]"]) if i < 2 else mpmath.eye(3)
    centre = lambda i: lambda q: body(q) + body_r(q) * mount(i, q)
    wheel = lambda i: lambda q: body_r(q) * turned(i, q) * ry(q[f"spin[{i}]"])
    lowest = lambda i: lambda q: centre(i)(q) - vec(0, 0, P["r"])
    m = None

    def rod(i, q):
        outer = mount(i, q) + turned(i, q) * vec(-P["arm"], -side[i] * P["inset"], 0)
        return outer - vec(P["a"] - P["arm"], side[i] * P["reach"] + q["rack"], -P["h"])

    def slips(q, v):
        rate = lambda f: along(lambda x: f(dict(zip(names, x))), [q[c] for c in names], v, FINE)
        return [rolls(rate, q, centre(i), wheel(i), lowest(i))[:2] for i in range(4)]

    def force(q, v):
        now = slips(q, [v[c] for c in names])
        found = []
        for c in names:
            # the power of the tyres along a virtual velocity
            virtual = slips(q, [mpf(int(c == other)) for other in names])
            power = -P["ct"] * sum(dot(x, y) for x, y in zip(now, virtual))
            if c.startswith("travel"):
                power -= P["cs"] * v[c]
            found.append(power + {"spin[2]": P["drive"], "spin[3]": P["drive"], "rack": P["push"]}.get(c, 0))
        return found

    def potential(q):
        found = P["m"] * P["g"] * q["p[2]"]
        for i in range(4):
            height = centre(i)(q)[2]
            found += P["mw"] * P["g"] * height + P["kt"] / 2 * (height - P["r"]) ** 2 + P["ks"] / 2 * q[f"travel[{i}]"] ** 2
        return found

    m = Machine(
        "car",
        "A car whose wheels travel along the z axis of the body, on springs (ks, cs), with tyres that are springs downwards\n"
        "(kt) and resist the velocity of their lowest points along the ground (ct). The front wheels turn about kingpins that\n"
        "lean back by the caster; tie rods of constant length join their steering arms to a rack of the mass mr, which moves\n"
        "relative to the body; its kinetic energy is that of this motion alone. Multipliers: of half the rates of the squared\n"
        "lengths of the tie rods, doubled.",
        names, p,
        lambda q: [
            (P["m"], diagonal(P["I1"], P["I2"], P["I3"]), body(q), body_r(q)),
            *[(P["mw"], diagonal(P["A"], P["C"], P["A"]), centre(i)(q), wheel(i)(q)) for i in range(4)],
            (P["mr"], None, vec(0, q["rack"], 0), None),
        ],
        lambda q, v, rate: [2 * dot(rod(i, q), rate(lambda q: rod(i, q))) for i in range(2)],
        potential,
        force=force,
        spread={c: (-0.3, 0.3) for c in ["pitch", "roll", "steer[0]", "steer[1]"]}
        | {f"travel[{i}]": (-0.08, 0.08) for i in range(4)} | {"p[2]": (0.5, 0.6), "rack": (-0.05, 0.05)},
    )
    return m


@machine
def arm_on_platform():
    p = dict(M="60.0", Jp="4.5", a="0.35", b="0.25", r="0.1", mw="2.5", Aw="0.009", Cw="0.014", h="0.5", l1="0.5", l2="0.45",
             l3="0.12", g="9.81", **{f"m{k + 1}": m for k, m in enumerate(["6.0", "8.0", "4.0", "2.5", "1.5", "0.8"])},
             **{f"I{k + 1}{j + 1}": f"0.0{9 - k}{j + 1}" for k in range(6) for j in range(3)},
             **{f"drive{k + 1}": x for k, x in enumerate(["1.5", "-0.5", "0.8", "1.1"])},
             **{f"torque{k + 1}": x for k, x in enumerate(["2.0", "30.0", "12.0", "0.7", "-1.2", "0.3"])})
    P = {k: mpf(x) for k, x in p.items()}
    names = ["x", "y", "yaw", *[f"wheel[{k}]" for k in range(4)], *[f"q[{k}]" for k in range(6)]]
    corner = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
    slant = [1, -1, -1, 1]
    platform = lambda q: rz(q["yaw"])
    hub = lambda k: lambda q: vec(q["x"], q["y"], 0) + platform(q) * vec(corner[k][0] * P["a"], corner[k][1] * P["b"], P["r"])
    wheel = lambda k: lambda q: platform(q) * ry(q[f"wheel[{k}]"])
    axes = [rz, ry, ry, rx, ry, rx]

    def bodies(q):
        r = [platform(q)]
        for k, turn in enumerate(axes):
            r.append(r[-1] * turn(q[f"q[{k}]"]))
        shoulder = vec(q["x"], q["y"], P["h"])
        elbow = shoulder + r[2] * vec(0, 0, P["l1"])
        wrist = elbow + r[3] * vec(P["l2"], 0, 0)
        places = [
            shoulder, shoulder + r[2] * vec(0, 0, P["l1"] / 2), elbow + r[3] * vec(P["l2"] / 4, 0, 0),
            elbow + r[4] * vec(3 * P["l2"] / 4, 0, 0), wrist, wrist + r[6] * vec(P["l3"], 0, 0),
        ]
        found = [(P["M"], diagonal(0, 0, P["Jp"]), vec(q["x"], q["y"], P["r"]), r[0])]
        found += [(P["mw"], diagonal(P["Aw"], P["Cw"], P["Aw"]), hub(k)(q), wheel(k)(q)) for k in range(4)]
        own = lambda k: diagonal(*[P[f"I{k + 1}{j + 1}"] for j in range(3)])
        return found + [(P[f"m{k + 1}"], own(k), places[k], r[k + 1]) for k in range(6)]

    def rows(q, v, rate):
        below = lambda k: lambda q: hub(k)(q) - vec(0, 0, P["r"])
        return [dot(platform(q) * vec(1, slant[k], 0), rolls(rate, q, hub(k), wheel(k), below(k))) for k in range(4)]

    def force(q, v):
        return [*[mpf(0)] * 3, *[P[f"drive{k + 1}"] for k in range(4)], *[P[f"torque{k + 1}"] for k in range(6)]]

    return Machine(
        "arm_on_platform",
        "An arm with six joints, about the axes z, y, y, x, y, x of the link before, on a platform with four wheels whose rollers\n"
        "stand at 45 degrees. Multipliers: of the velocities of the lowest points of the wheels along (1, 1), (1, -1), (1, -1),\n"
        "(1, 1) in the axes of the platform, which are not of length 1.",
        names, p, bodies, rows,
        lambda q: P["g"] * sum(P[f"m{k + 1}"] * bodies(q)[5 + k][2][2] for k in range(6)),
        force=force,
    )


@machine
def robot_with_motors():
    p = dict(m="6.0", J="0.25", a="0.05", b="0.2", r="0.07", Jw="0.004", K="0.3", Rm="0.9", Lm="0.02", c="0.01", volts1="4.0",
             volts2="6.5")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["p[0]", "p[1]", "yaw", "wheel[0]", "wheel[1]"]
    turn = lambda q: rz(q["yaw"])
    place = lambda q: vec(q["p[0]"], q["p[1]"], 0)
    hub = lambda i: lambda q: place(q) + turn(q) * vec(0, P["b"] if i else -P["b"], 0)

    def rows(q, v, rate):
        ahead, across = turn(q) * vec(1, 0, 0), turn(q) * vec(0, 1, 0)
        return [dot(across, rate(place)), *[dot(ahead, rate(hub(i))) - P["r"] * v[f"wheel[{i}]"] for i in range(2)]]

    def force(q, v):
        return [mpf(0)] * 3 + [P["K"] * q[f"current[{i}]"] - P["c"] * v[f"wheel[{i}]"] for i in range(2)]

    def rates(q, v):
        current = [q["current[0]"], q["current[1]"]]
        volts = [P["volts1"], P["volts2"]]
        found = [(volts[i] - P["K"] * v[f"wheel[{i}]"] - P["Rm"] * current[i]) / P["Lm"] for i in range(2)]
        return [*found, P["Rm"] * dot(current, current)]

    # a wheel turns about its axle as a body of its own, its mass is in the mass of the robot
    turning = lambda i, q: (mpf(0), diagonal(P["Jw"], 0, 0), vec(0, 0, 0), rx(q[f"wheel[{i}]"]))
    return Machine(
        "robot_with_motors",
        "A robot in the plane with two wheels, at b to the right and to the left of p, each driven by a motor: the current\n"
        "follows L i' = u - K w - R i, the torque is K i less friction, and heat' = R i^2. Its mass is at a before p.\n"
        "Multipliers: of the sideways velocity and of the rolling of each wheel.",
        names, p,
        lambda q: [
            (P["m"], diagonal(0, 0, P["J"]), place(q) + turn(q) * vec(P["a"], 0, 0), turn(q)), turning(0, q), turning(1, q),
        ],
        rows,
        lambda q: mpf(0),
        force=force,
        auxiliary=(["current[0]", "current[1]", "heat"], rates),
    )


@machine
def single_track_with_relaxation():
    p = dict(m="1300.0", J="2000.0", a="1.1", b="1.4", stiffness1="52000.0", stiffness2="61000.0", relaxation="0.4",
             lag="0.15", push="900.0", command="0.12")
    P = {k: mpf(x) for k, x in p.items()}
    names = ["p[0]", "p[1]", "yaw"]
    place = lambda q: vec(q["p[0]"], q["p[1]"], 0)
    axle = lambda i: lambda q: place(q) + rz(q["yaw"]) * vec(-P["b"] if i else P["a"], 0, 0)
    wheel = lambda i, q: rz(q["yaw"]) if i else rz(q["yaw"]) * rz(q["delta"])

    def velocity(i, q, v):
        values = {c: q[c] for c in names}
        return along(lambda x: axle(i)(dict(zip(names, x))), list(values.values()), [v[c] for c in names], FINE)

    def force(q, v):
        push = rz(q["yaw"]) * vec(P["push"], 0, 0)
        sides = [q[f"side[{i}]"] * (wheel(i, q) * vec(0, 1, 0)) for i in range(2)]
        found = []
        for c in names:
            virtual = {other: mpf(int(c == other)) for other in names}
            power = sum(dot(sides[i], velocity(i, q, virtual)) for i in range(2))
            found.append(power + dot(push, vec(virtual["p[0]"], virtual["p[1]"], 0)))
        return found

    def rates(q, v):
        found = []
        for i in range(2):
            own = wheel(i, q).T * velocity(i, q, v)
            found.append(-(P[f"stiffness{i + 1}"] * own[1] + own[0] * q[f"side[{i}]"]) / P["relaxation"])
        return [*found, (P["command"] - q["delta"]) / P["lag"]]

    return Machine(
        "single_track_with_relaxation",
        "A car on one track in the plane, the front axle at a before and the rear axle at b behind the centre of mass. The\n"
        "side force f of a tyre follows s f' = -(C u + w f), with its velocities u sideways and w along; the steering angle\n"
        "delta follows a command with a lag.",
        names, p,
        lambda q: [(P["m"], diagonal(0, 0, P["J"]), place(q), rz(q["yaw"]))],
        lambda q, v, rate: [],
        lambda q: mpf(0),
        force=force,
        auxiliary=(["side[0]", "side[1]", "delta"], rates),
    )


if __name__ == "__main__":
    import sys

    for build in MACHINES:
        if len(sys.argv) == 1 or build.__name__ in sys.argv[1:]:
            build().write()
