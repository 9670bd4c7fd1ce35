"""The kick solver, alignment, prediction and judgement, for arrays of kicks at once."""
from __future__ import annotations

from typing import Any

import numpy
from numpy.typing import ArrayLike

from . import _trivela
from ._arrays import flat, records
from ._trivela import Flight, Goal, Robot

#: What may become of a kick: "on_target" is between the posts and below the bar.
OUTCOMES: tuple[str, ...] = _trivela.outcomes

_RANGES = numpy.asarray(["below", "in", "above", ""])


def solve(
    distance_m: ArrayLike,
    height_m: ArrayLike,
    exit_angle_rad: ArrayLike,
    v_front_mps: ArrayLike = 0.0,
    transfer: ArrayLike = 1.0,
    drag_coefficient: ArrayLike | None = None,
    *,
    robot: Robot | None = None,
    flight: Flight = Flight(),
) -> numpy.recarray[Any, Any]:
    """Exit speed and power for a height at a distance, as `trivela solve`.

    distance_m        ball centre to the goal line, above 0 [m]
    height_m          wanted height of the ball's centre over its launch [m]
    exit_angle_rad    of the kick over the floor, between 0 and pi / 2
    v_front_mps       forward speed of the robot [m/s]
    transfer          share of it that the ball takes over, 0 to 10
    drag_coefficient  adds v0_drag_mps, 0 to 10
    robot             adds power and power_range by its table

    The arguments may have any shapes that numpy brings to one; the record array has that shape:

    v0_mps            robot at rest: sqrt(g d^2 / (2 cos^2(theta) (d tan(theta) - h))); NaN where no speed reaches the point
    vk_exact_mps      moving robot, through the point
    vk_paper_mps      moving robot, the paper's law V0 - u cos(theta)
    feasible          some speed reaches the point
    descending        the ball passes the point on its way down
    v0_drag_mps       robot at rest, with drag (a = -k |v| v)
    power             set-point for vk_exact_mps; power_range: "below", "in" or "above" the table, "" without a speed

    Raises ValueError naming argument, place and value.
    """
    shape, arrays = flat(distance_m, height_m, exit_angle_rad, v_front_mps, transfer, *([] if drag_coefficient is None else [drag_coefficient]))
    drag = arrays[5] if drag_coefficient is not None else None
    columns = _trivela.solve(*arrays[:5], drag, robot, flight)
    if robot is not None:
        columns["power_range"] = _RANGES[columns["power_range"]]
    return records(columns, shape)


def align(
    x_m: ArrayLike,
    y_m: ArrayLike,
    heading_rad: ArrayLike,
    alpha_rad: ArrayLike,
    target_x_m: ArrayLike,
    target_y_m: ArrayLike,
    beta_rad: ArrayLike,
    omega_radps: ArrayLike,
    *,
    rule: str = "max",
) -> numpy.recarray[Any, Any]:
    """Is the robot aligned with the target? As `trivela align` (the paper's sections 3.1 and 3.4).

    x_m, y_m, heading_rad     robot in the field frame
    alpha_rad                 deflection by the lateral velocity, right positive, -pi to pi
    target_x_m, target_y_m    target in the field frame [m]
    beta_rad                  lead angle of the rotation, -2 pi to 2 pi
    omega_radps               turn rate, counter-clockwise positive
    rule                      how beta lengthens the target's segment: "max" or "add"

    The record array has the arguments' common shape: distance_m from the robot's centre to the target, offset_right_m where the kick's
    line meets the target's (NaN: it does not), left_m and right_m, the reach of the target's segment, and aligned.
    Raises ValueError naming argument, place and value.
    """
    if rule not in ("max", "add"):
        raise ValueError(f"rule: '{rule}' is neither max nor add")
    shape, arrays = flat(x_m, y_m, heading_rad, alpha_rad, target_x_m, target_y_m, beta_rad, omega_radps)
    return records(_trivela.align(*arrays, rule == "add"), shape)


def predict(
    x_m: ArrayLike,
    y_m: ArrayLike,
    heading_rad: ArrayLike,
    vx_mps: ArrayLike,
    vy_mps: ArrayLike,
    omega_radps: ArrayLike,
    v_kick_mps: ArrayLike,
    exit_angle_rad: ArrayLike,
    *,
    transfer: ArrayLike = 1.0,
    delay_s: ArrayLike = 0.06,
    ball_offset_m: ArrayLike = 0.27,
    goal_y_m: ArrayLike = 9.0,
    flight: Flight = Flight(),
) -> numpy.recarray[Any, Any]:
    """Where the ball crosses the goal line if the order goes out now, as `trivela predict`: free flight without drag.

    x_m, y_m, heading_rad        robot in the field frame
    vx_mps, vy_mps, omega_radps  its twist: to its right, forward, counter-clockwise
    v_kick_mps, exit_angle_rad   exit speed, above 0, and elevation, between 0 and pi / 2
    transfer                     share of the robot's velocity that the ball takes over, 0 to 10
    delay_s                      from the order to the release, 0 to 10 s
    ball_offset_m                robot centre to ball centre, 0 to 10 m
    goal_y_m                     goal line in the field frame [m]

    The record array has the arguments' common shape: x_cross_m, z_cross_m (below 0: it touched the floor before) and t_flight_s, all NaN
    where the ball never crosses. Raises ValueError naming argument, place and value.
    """
    shape, arrays = flat(x_m, y_m, heading_rad, vx_mps, vy_mps, omega_radps, v_kick_mps, exit_angle_rad, transfer, delay_s, ball_offset_m, goal_y_m)
    return records(_trivela.predict(*arrays, flight), shape)


def judge(x_cross_m: ArrayLike, z_cross_m: ArrayLike, *, goal: Goal = Goal(), ball_radius_m: float = 0.11) -> numpy.ndarray[Any, Any]:
    """One of OUTCOMES for each ball whose centre crosses the goal line at x [m], z [m over the floor], in the arguments' common shape.

    NaN is "unknown". A ball that bounced or rolls counts as inside; "short" and "blocked" never cross. Raises ValueError for a
    ball_radius_m outside 0.02 to 0.25 m.
    """
    shape, (x, z) = flat(x_cross_m, z_cross_m)
    return numpy.asarray(OUTCOMES)[_trivela.judge(x, z, goal, ball_radius_m)].reshape(shape)


def judge_probabilities(
    x_cross_m: ArrayLike, sd_x_m: ArrayLike, z_cross_m: ArrayLike, sd_z_m: ArrayLike, *, goal: Goal = Goal(), ball_radius_m: float = 0.11
) -> numpy.recarray[Any, Any]:
    """Probability of each of OUTCOMES but "unknown" for a crossing that is known to a normal error, x and z apart.

    sd_x_m and sd_z_m are standard deviations, above 0 [m]. The record array has the arguments' common shape and a field for each outcome; they
    sum to 1. Raises ValueError naming argument, place and value.
    """
    shape, arrays = flat(x_cross_m, sd_x_m, z_cross_m, sd_z_m)
    return records(_trivela.judge_probabilities(*arrays, goal, ball_radius_m), shape)
