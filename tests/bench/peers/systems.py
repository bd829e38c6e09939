"""The systems of the benchmark, as a user of a tool without brackets would describe them: bodies with
their velocities, constraints on the speeds, and, for an expert's version, the dependent speeds solved
(`solved`, and where it pays bodies in other axes), the accelerations written out (`explicit`), or both.

Functions of kinds take `sin`, `cos`, `sqrt`, and `named`, by which a tool that would write an intermediate
result out again gives it a name.
"""

from jointed import arm, elbow, furuta, leg
from linkages import five_bar, four_bar, slider_crank
from rolling import ball, ball_with_rotors, chaplygin_ball, disk, paraboloid, rattleback
from spinning import finned_body, four_wheels, heavy_top, quadrotor, satellite, veselova
from trailers import hitched_trailer, off_axle, rear_steered, tractor
from wheeled import balancing_robot, car, pendulum, robot, roller_racer, roller_walker, sleigh, snakeboard

SYSTEMS = {
    "sleigh": sleigh, "veselova": veselova, "snakeboard": snakeboard, "robot": robot, "ball on table": ball,
    "tractor, 1 trailer": tractor(1),
    **{f"tractor, {n} trailers": tractor(n) for n in range(2, 7)},
    "car": car, "roller racer": roller_racer, "hitched trailer": hitched_trailer, "balancing robot": balancing_robot,
    "satellite": satellite, "Chaplygin ball": chaplygin_ball, "pendulum": pendulum,
    **{f"arm, {n} links": arm(n) for n in (2, 4, 6)},
    "quadrotor": quadrotor, "four-bar linkage": four_bar, "roller walker": roller_walker, "rattleback": rattleback,
    "stone on a paraboloid": paraboloid, "satellite, 4 wheels": four_wheels, "body with fins": finned_body,
    "ball with rotors": ball_with_rotors, "heavy top": heavy_top, "leaning disk": disk,
    "car, rear steering and trailer": rear_steered, "Furuta's pendulum": furuta, "leg on a foot": leg,
    "arm in space, 3 joints": elbow, "five-bar linkage": five_bar, "slider crank": slider_crank,
    "trailers off the axle": off_axle,
}
