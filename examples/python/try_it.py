"""What the package of this folder does: run by .ci/python, and to be read as an example."""

import math
import time

import nh_robot

robot = nh_robot.Robot(m=10.0, J=0.6, l=0.1, c=0.2, r=0.05)
assert nh_robot.Robot.state_names() == ["x", "y", "theta", "v", "omega"]

# without torques the energy stays: that of the robot, coasting and turning
start = [0.0, 0.0, 0.0, 1.0, 2.0]
end = robot.advance(start, [0.0, 0.0], 10.0)
assert abs(robot.energy(end) - robot.energy(start)) < 1e-7 * robot.energy(start)

# m v' = m l omega^2 + (torques) / r
rates = robot.derivative(start, [0.3, 0.2])
assert math.isclose(rates[3], 0.1 * 2.0**2 + 0.5 / (10.0 * 0.05), rel_tol=1e-14)

# the Jacobian against difference quotients
jacobian = robot.state_jacobian(start, [0.3, 0.2])
for j in range(5):
    ahead, behind = list(start), list(start)
    ahead[j] += 1e-5
    behind[j] -= 1e-5
    ahead, behind = robot.derivative(ahead, [0.3, 0.2]), robot.derivative(behind, [0.3, 0.2])
    for i in range(5):
        assert abs(jacobian[i][j] - (ahead[i] - behind[i]) / 2e-5) < 1e-8

# a model that is none is refused where it is made, by name
try:
    nh_robot.Robot(m=-1.0)
except ValueError as error:
    print("refused:", error)
else:
    raise AssertionError("a negative mass was accepted")

sequences = [[[0.1 + 0.001 * k, 0.1 - 0.001 * k]] * 100 for k in range(200)]
began = time.perf_counter()
ends = [states[-1] for states in robot.rollouts(start, sequences, 0.01)]
microseconds = 1e6 * (time.perf_counter() - began) / (200 * 100)
assert len({round(x, 6) for x, *_ in ends}) == 200
print(f"200 rollouts of 100 steps: {microseconds:.2f} microseconds a step, with the conversion of every number")
