"""Many simulated matches in this process, with any number of threads."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Iterator, Mapping, Sequence

import numpy

from . import _trivela
from ._arrays import plain, records

#: Called after each match, and after each calibration before the matches: how many are done, of how many, and a few words.
Progress = Callable[[int, int, str], None]

_LIMITS = {"matches": 1 << 20, "possessions": 100_000, "jobs": 1024, "seed": 9_000_000_000_000_000, "calibrations": 1000}


def _toml(value: Any) -> str:
    """A text, number, truth or list of them as TOML; JSON's are TOML's."""
    return json.dumps(os.fspath(value) if isinstance(value, os.PathLike) else value, ensure_ascii=False)


def lines_of(settings: "Mapping[str, Any] | Sequence[str]", before: str = "") -> Iterator[str]:
    """Settings as lines of TOML: {"policy": {"predictive": {"threshold": 0.4}}} is "policy.predictive.threshold = 0.4"."""
    if isinstance(settings, str):
        raise ValueError(f"'{settings}': a list of lines or a dict is needed, such as ['{settings}']")
    if not isinstance(settings, Mapping):
        yield from settings
        return
    for key, value in settings.items():
        if isinstance(value, Mapping):
            yield from lines_of(value, f"{before}{key}.")
        else:
            yield f"{before}{key} = {_toml(value)}"


def _arm_text(arm: Mapping[str, Any]) -> str:
    fields = dict(arm)
    if "set" in fields:
        fields["set"] = list(lines_of(fields["set"]))
    if "robots" in fields:
        fields["robots"] = [os.fspath(robot) for robot in fields["robots"]]
    return "[[arm]]\n" + "".join(f"{key} = {_toml(value)}\n" for key, value in fields.items())


def simulate(
    arms: "str | os.PathLike[str] | Mapping[str, Any] | Sequence[Mapping[str, Any]]",
    *,
    world: "Mapping[str, Any] | Sequence[str]" = (),
    matches: int = 100,
    possessions: int = 60,
    calibrations: int = 0,
    seed: int = 1,
    jobs: int = 1,
    scenario: "str | os.PathLike[str] | None" = None,
    settings: "Mapping[str, Any] | Sequence[str]" = (),
    config: "str | os.PathLike[str] | None" = None,
    robots: "Sequence[str | os.PathLike[str]]" = (),
    out: "str | os.PathLike[str] | None" = None,
    shadows: bool = False,
    every_cycle: bool = False,
    progress: Progress | None = None,
) -> numpy.recarray[Any, Any]:
    """Plays the same matches with every arm, as `trivela simulate`: possession n of match m is the same situation with the same noise
    for each.

    arms          policies, "stopped,moving,predictive", each with "@old" or "@new" for its height table; a file of arms (.toml); a text of
                  [[arm]] tables; or such tables as dicts: name, policy, table, robots, config, set, random, random_probabilities, where
                  `set` may be a dict of settings or lines
    world         values on top of the scenario, {"keeper": {"reaction_s": 0.15}} or ["keeper.reaction_s=0.15"]
    matches       of each arm, 1 to 2^20, of `possessions` opportunities each, 1 to 100,000
    calibrations  simulated calibrations that the robots come from, match m with calibration m mod that; 0: robot files
    seed          same seed, same matches
    jobs          threads, 1 to 1024; the rows do not depend on it. Other threads of Python run meanwhile. With a policy in Python one
                  thread plays: the interpreter's lock would make several slower
    scenario      the world's file; None: the shipped default.toml
    settings      settings of the nodes on top of the file `config` (None: the shipped default.toml), as `world`
    robots        robot files, robot n's at n - 1; (): the shipped calibrated ones
    out           match log to write, new or of the same call; None: none. Matches that are in it already are played once more for their
                  rows, and not written. With a policy in Python the same call is one of the same process with the same function
    shadows, every_cycle  what the log has besides
    progress      called as progress(done, all, words). What it raises, and Ctrl-C, end the play after the matches under way; the log keeps
                  what was played, and the same call goes on from there

    The record array has one row for each opportunity, by match and arm:

    arm, match_id, calibration_id (-1: none), possession_id, robot_id, policy, assignment_probability
    ending                "kicked", "disputed", "timed_out" or "stopped"; played_s: time of play; start_distance_m: to the goal, true
    kicked                the rest is of the last accepted kick; without one numbers are NaN, names "" and kick_kind -1
    distance_m, vx_mps, vy_mps, omega_radps, opponent_distance_m   as the robot believed
    power, kick_kind, v_kick_mps, p_on_target, predicted_x_cross_m, predicted_z_cross_m, predicted_t_flight_s
    outcome               as observed; truth_outcome, truth_saved, truth_bounced: the simulator's

    Raises ValueError in a sentence that names the arm, key and value; FileNotFoundError.
    """
    given = {"matches": matches, "possessions": possessions, "jobs": jobs, "seed": seed, "calibrations": calibrations}
    for name, value in given.items():
        least = 0 if name in ("seed", "calibrations") else 1
        if not least <= value <= _LIMITS[name]:
            raise ValueError(f"{name} {value} is not within {least} to {_LIMITS[name]}")
    asked = _trivela.Asked()
    if isinstance(arms, Mapping):
        arms = [arms]
    if isinstance(arms, (str, os.PathLike)):
        asked.arms = os.fspath(arms)
        asked.arms_are_text = "[[arm]]" in asked.arms
    else:
        asked.arms = "\n".join(map(_arm_text, arms))
        asked.arms_are_text = True
    shipped = _trivela.configuration_folder()
    asked.scenario = os.path.join(shipped, "scenarios", "default.toml") if scenario is None else os.fspath(scenario)
    asked.config = os.path.join(shipped, "default.toml") if config is None else os.fspath(config)
    asked.world = list(lines_of(world))
    asked.settings = list(lines_of(settings))
    asked.robots = [os.fspath(robot) for robot in robots]
    asked.matches, asked.possessions, asked.calibrations = matches, possessions, calibrations
    asked.seed, asked.jobs = seed, jobs
    asked.out = "" if out is None else os.fspath(out)
    asked.shadows, asked.every_cycle = shadows, every_cycle
    columns = _trivela.simulate(asked, progress)
    return records({name: plain(column) for name, column in columns.items()})
