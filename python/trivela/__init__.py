"""Trivela from Python: the kick solver, simulated matches, match logs, comparisons and statistics.

Everything is computed by the code of the programs, so that the numbers are theirs to the last bit. Units are in the names:
metres, seconds, radians, m/s. The field's origin is its centre spot, +y points to the opponents' goal, +x to the right; a heading
of 0 faces the goal and grows counter-clockwise. ValueError: an argument or a file makes no sense; FileNotFoundError: a file is not there;
RuntimeError: anything else that went wrong. Each says in a sentence what is wrong.
"""
from . import stats
from ._trivela import Cycle, Flight, Goal, Output, Robot, configuration_folder
from ._trivela import version as __version__
from .calibration import TableFit, fit_table, lobs
from .comparison import Result, compare, compare_counts, report
from .kicks import OUTCOMES, align, judge, judge_probabilities, predict, solve
from .log import Log
from .policy import register_policy
from .simulation import simulate

__all__ = [
    "OUTCOMES", "Cycle", "Flight", "Goal", "Log", "Output", "Result", "Robot", "TableFit", "__version__", "align", "compare", "compare_counts",
    "configuration_folder", "fit_table", "judge", "judge_probabilities", "lobs", "predict", "register_policy", "report", "simulate", "solve", "stats",
]
