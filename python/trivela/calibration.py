"""The height calibration: lobs of scan records, and the table of a robot's powers."""
from __future__ import annotations

import os
from dataclasses import dataclass

import pandas
from numpy.typing import ArrayLike

from . import _trivela
from ._arrays import flat, frame


def lobs(scans: "str | os.PathLike[str]") -> pandas.DataFrame:
    """The lobs of a scan record in the order of their flights, refused ones too, with the verdicts of the record.

    launch_t_ns   by the record's clock; power: set-point of the kick (NaN: not known); centres: of the ball that were seen
    accepted      else `refusal` and `why` say what is wrong
    exit_angle_rad, exit_speed_mps, height_m, distance_m      effective: of the drag-free parabola; NaN without one
    true_exit_angle_rad, true_exit_speed_mps, drag_coefficient    of the fit with drag

    Each has its standard error: exit_speed_se_mps, drag_coefficient_se. Raises FileNotFoundError, and ValueError where the file is no scan record.
    """
    return frame(_trivela.lobs(os.fspath(scans)))


@dataclass(frozen=True)
class TableFit:
    """A height table with the figures behind it."""

    #: power, trials, exit_speed_mps and exit_angle_rad with exit_speed_sd_mps and exit_angle_sd_rad from kick to kick, powers rising.
    set_points: pandas.DataFrame
    exit_angle_rad: float  #: mean over the trials, as in the paper
    exit_angle_se_rad: float
    exit_speed_sd_mps: float  #: from kick to kick, pooled over the set-points; NaN: no power has two trials
    rises: bool  #: each speed lies above its predecessor: the table can be used
    isotonic: bool  #: the isotonic fit changed the speeds
    warnings: list[str]


def fit_table(power: ArrayLike, exit_speed_mps: ArrayLike, exit_angle_rad: ArrayLike, *, isotonic: bool = False) -> TableFit:
    """Averages the trials of each power, as `trivela calibrate table`.

    power, exit_speed_mps, exit_angle_rad  one kick each, above 0; an angle of NaN was not seen, one at least was
    isotonic                               make a table that does not rise usable by pooling neighbours

    Raises ValueError for fewer than two powers, and for a number that is not finite and positive.
    """
    _, (powers, speeds_mps, angles_rad) = flat(power, exit_speed_mps, exit_angle_rad)
    set_points, whole = _trivela.fit_table(powers, speeds_mps, angles_rad, isotonic)
    return TableFit(set_points=frame(set_points), **whole)
