"""Reports and comparisons of match logs."""
from __future__ import annotations

import json
import os
from typing import Any

from . import _trivela


class Result(dict):  # type: ignore[type-arg]
    """What the program writes with --json, as a dict; `text` is what it writes for people."""

    def __init__(self, answer: tuple[str, str]) -> None:
        super().__init__(json.loads(answer[0]))
        self.text: str = answer[1]


def _check(name: str, value: str, allowed: tuple[str, str]) -> None:
    if value not in allowed:
        raise ValueError(f"{name}: '{value}' is neither {allowed[0]} nor {allowed[1]}")


def report(*logs: "str | os.PathLike[str]", blocked: str = "outside") -> Result:
    """Table 2 of match logs and how far it can be trusted, as `trivela report --json`; each kick counts once.

    blocked  "outside", as in the paper's Table 2, or "apart": efficiency is of the others

    Raises FileNotFoundError and ValueError as Log.
    """
    _check("blocked", blocked, ("outside", "apart"))
    if not logs:
        raise ValueError("report needs a match log")
    return Result(_trivela.report([os.fspath(log) for log in logs], blocked == "apart"))


def compare(
    *logs: "str | os.PathLike[str]",
    by: str = "",
    stratify: str = "",
    baseline: str = "",
    design: str = "",
    outcome: str = "observed",
    blocked: str = "outside",
    smallest_effect: float = 0.05,
) -> Result:
    """Policies, tables, robots, arms or logs side by side: how much, how sure, why; as `trivela compare --json`.

    by               "policy", "table", "robot", "arm" or "log"; "": arm where a log has several, else policy, or log where there is one
    stratify         situations to compare within: "distance", "start_distance", "robot", "half", ...
    baseline         the group that the others are compared with; "": the first
    design           "before_after", "alternating", "randomised" or "paired", where the data do not say it
    outcome          "observed" by the robots and by hand, or "truth", the simulator's
    blocked          "outside", as in the paper's Table 2, or "apart"
    smallest_effect  smallest difference of interest, a share between 0 and 1

    Keys are explained in docs/evaluation.md. Raises ValueError in a sentence that begins with the argument; FileNotFoundError.
    """
    _check("outcome", outcome, ("observed", "truth"))
    _check("blocked", blocked, ("outside", "apart"))
    if not logs:
        raise ValueError("compare needs match logs")
    question = _trivela.ComparisonQuestion(by, stratify, baseline, design, outcome == "truth", blocked == "apart", smallest_effect)
    return Result(_trivela.compare_logs([os.fspath(log) for log in logs], question))


def compare_counts(older: tuple[str, int, int], newer: tuple[str, int, int], *, smallest_effect: float = 0.05) -> Result:
    """Two counts (name, inside, kicks) side by side, as `trivela compare --counts --json`.

    compare_counts(("old", 34, 65), ("new", 100, 132)) is the paper's Table 2. Raises ValueError where a count makes no sense.
    """
    return Result(_trivela.compare_counts(older, newer, smallest_effect))
