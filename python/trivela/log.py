"""Match logs as pandas data frames."""
from __future__ import annotations

import os
from typing import Any

import pandas

from . import _trivela
from ._arrays import frame


_OUTCOMES = [
    "session_id", "robot_id", "kick_id", "t_ns", "half", "possession_id", "policy", "outcome", "observed_outcome", "hand_outcome", "no_goal", "settled_t_ns",
    "x_cross_m", "z_cross_m", "sd_cross_m", "exit_speed_mps", "observations", "observed_p_on_target", "observed_p_saved", "bounced", "saved",
    "truth_outcome", "truth_x_cross_m", "truth_z_cross_m", "truth_margin_m", "truth_bounced", "truth_saved",
]


class Log:
    """One match log, or several whose kicks are taken together: what two recorders have of one play counts once, as in
    `trivela report`, and a label that a person gave counts before what the robot saw.

    The logs are only read, and opened anew for each question: a log that is still being recorded may have gained rows.
    In the data frames numbers are float64 (NaN: there is none), truths boolean, whole numbers int64, or Int64 where some are
    missing, names str (None: there is none). Units are in the columns' names; `meaning` explains a column. Ctrl-C ends a question.

    Raises FileNotFoundError where a log is not there, ValueError where a file is no match log.
    """

    def __init__(self, log: "str | os.PathLike[str]", *more: "str | os.PathLike[str]") -> None:
        self.paths: list[str] = [os.fspath(path) for path in (log, *more)]
        #: Sentences on sessions that were not closed, on lost rows and on rows that nobody verified.
        self.warnings: list[str] = _trivela.warnings(self.paths)

    def __repr__(self) -> str:
        return f"trivela.Log({', '.join(map(repr, self.paths))})"

    def query(self, sql: str) -> pandas.DataFrame:
        """The rows of one SELECT, as `trivela query`: tables and columns are those of log/schema/schema.sql, the view counted_kicks has
        each kick once. Of several logs each is asked, and `log` says which a row is from. Raises ValueError where the log cannot be asked that, or
        where two columns have one name.
        """
        names, columns, logs = _trivela.ask(self.paths, sql)
        table = frame(dict(zip(names, columns)))
        if len(self.paths) > 1:
            table.insert(0, "log", frame({"log": logs})["log"] if len(table) else pandas.Series(dtype=object))
        return table

    def metric(self, name: str) -> pandas.DataFrame:
        """One of `trivela query --list`. Raises ValueError for a name that is none."""
        known = _trivela.metrics()
        if name not in known:
            raise ValueError(f"there is no metric '{name}': {', '.join(known)}")
        return self.query(known[name][0])

    def kicks(self) -> pandas.DataFrame:
        """Kicks that the driver did not refuse, one row each in the order of their time: the decision, where the robot was, what it
        predicted, what became of it (`outcome`; None: nobody knows) and the simulator's truth, where there is one.
        """
        return self.metric("listed_kicks")

    def outcomes(self) -> pandas.DataFrame:
        """What became of the same kicks: `outcome` counts, `observed_outcome` is the robot's, `hand_outcome` a person's, `truth_outcome`
        the simulator's; crossings, their standard deviation, probabilities, bounces and saves.
        """
        return self.kicks()[(["log"] if len(self.paths) > 1 else []) + _OUTCOMES]

    def decisions(self) -> pandas.DataFrame:
        """Every recorded decision to fire or to hold, with every number behind it (table kick_decisions), once each: of several recordings
        of a play the first has it, and sessions that do not count, such as replays, are left out. Of an experiment without
        every_cycle these are the decisions that fired.
        """
        sessions = self.sessions()
        sessions = sessions[sessions["counts"]]
        place = ["log", "session_id"] if len(self.paths) > 1 else ["session_id"]
        table = self.query("SELECT * FROM kick_decisions ORDER BY session_id, robot_id, seq")
        table = table.merge(sessions[[*place, "play", "half_1_left_out", "half_2_left_out"]], on=place)
        left_out = ((table["half"] == 1) & table["half_1_left_out"]) | ((table["half"] == 2) & table["half_2_left_out"])
        table = table[~left_out.astype(bool)].drop_duplicates(["play", "robot_id", "seq", "t_ns"])
        return table.drop(columns=["play", "half_1_left_out", "half_2_left_out"]).reset_index(drop=True)

    def opportunities(self, outcome: str = "observed") -> pandas.DataFrame:
        """Opportunities to kick, with or without one, as `trivela compare` counts them: `ending` is "no_kick", "inside", "outside"
        (`blocked` or not) or "unknown". `outcome`: "observed" by the robots and by hand, or "truth", the simulator's.
        `attrs["remarks"]` has sentences on what does not count.
        """
        if outcome not in ("observed", "truth"):
            raise ValueError(f"outcome: '{outcome}' is neither observed nor truth")
        columns, remarks = _trivela.opportunities(self.paths, outcome == "truth")
        table = frame(columns)
        table.attrs["remarks"] = remarks
        return table

    def sessions(self) -> pandas.DataFrame:
        """The recorded sessions: which match and play each is of, whether it counts, world, arm and table."""
        return frame(_trivela.sessions(self.paths))

    def meaning(self, column: str) -> str:
        """What a recorded column is, with its unit, as log/schema/schema.sql says. Raises KeyError for a name that is none."""
        return str(_trivela.column_kinds()[column][1])

    def report(self, *, blocked: str = "outside") -> Any:
        """trivela.report() of these logs."""
        from .comparison import report

        return report(*self.paths, blocked=blocked)
