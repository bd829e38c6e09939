"""What descriptions of systems share: bodies, rates of coordinates, small linear systems.

A body is (mass, inertia, velocity, spin of the axes in which that is written, angular velocity in axes of its
own), and where those axes do not turn with it, as those of a disk need not, their spin. An inertia is three
principal moments, or six numbers: xx, yy, zz, xy, yz, zx.
"""


def planar(mass, moment, vx, vy, axes, spin):
    return mass, (0, 0, moment), (vx, vy, 0), (0, 0, axes), (0, 0, spin)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def several(space, name, count, first=0):
    """`name0`, `name1`, …"""
    return [getattr(space, f"{name}{k}") for k in range(first, first + count)]


def numbered(name, count, first=0):
    return " ".join(f"{name}{k}" for k in range(first, first + count))


def on_the_plane(f, q, u):
    """Rates of place and heading, from velocities in the axes of a body."""
    return [u.v * f.cos(q.th) - u.side * f.sin(q.th), u.v * f.sin(q.th) + u.side * f.cos(q.th), u.omega]


def attitude(q, w):
    """Rates of a quaternion, from the angular velocity in the axes of the body."""
    a, b, c, d = q
    x, y, z = w
    return [-(b * x + c * y + d * z) / 2, (a * x + c * z - d * y) / 2, (a * y + d * x - b * z) / 2,
            (a * z + b * y - c * x) / 2]


def halved(q, w):
    """The same with halves taken once."""
    a, b, c, d = q
    x, y, z = (each / 2 for each in w)
    return [-b * x - c * y - d * z, a * x + c * z - d * y, a * y + d * x - b * z, a * z + b * y - c * x]


def two_by_two(f, a, b, c, right):
    """The solution of (a b; b c) x = right, by one division."""
    over = f.named(1 / (a * c - b * b))
    return f.named((c * right[0] - b * right[1]) * over), f.named((a * right[1] - b * right[0]) * over)


def three_by_three(f, m, right):
    """The solution with the symmetric matrix m = (11, 22, 33, 12, 13, 23), by its cofactors."""
    a, b, c, d, e, g = (f.named(each) for each in m)
    x, y, z = (f.named(each) for each in right)
    over_a, over_d, over_e = f.named(b * c - g * g), f.named(e * g - d * c), f.named(d * g - e * b)
    over_b, over_g, over_c = f.named(a * c - e * e), f.named(d * e - a * g), f.named(a * b - d * d)
    over = f.named(1 / (a * over_a + d * over_d + e * over_e))
    return (over * (over_a * x + over_d * y + over_e * z), over * (over_d * x + over_b * y + over_g * z),
            over * (over_e * x + over_g * y + over_c * z))


def factorised(f, matrix, right):
    """The solution with a symmetric matrix, as L D Lᵀ."""
    size = len(right)
    lower, over, found = [[None] * size for _ in range(size)], [None] * size, list(right)
    for j in range(size):
        column = {}
        for i in range(j, size):
            entry = matrix[i][j]
            for k in range(j):
                # of column k, before and after the division
                entry = entry - lower[i][k][0] * lower[j][k][1]
            column[i] = f.named(entry)
        over[j] = f.named(1 / column[j])
        for i in range(j + 1, size):
            lower[i][j] = column[i], f.named(column[i] * over[j])
            found[i] = f.named(found[i] - lower[i][j][1] * found[j])
    for i in reversed(range(size)):
        found[i] = found[i] * over[i]
        for k in range(i + 1, size):
            found[i] = found[i] - lower[k][i][1] * found[k]
        found[i] = f.named(found[i])
    return found
