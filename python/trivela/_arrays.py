"""Brings arguments to one shape, and columns into record arrays and data frames."""
from __future__ import annotations

from typing import Any, Mapping

import numpy
import pandas

from . import _trivela

Column = Any  # a tuple of python/columns.hpp


def flat(*arguments: Any, kind: Any = numpy.float64) -> tuple[tuple[int, ...], list[numpy.ndarray[Any, Any]]]:
    """The arguments as flat arrays of one length, and their common shape."""
    arrays = numpy.broadcast_arrays(*(_numbers(argument, kind) for argument in arguments))
    return arrays[0].shape, [numpy.ascontiguousarray(array).ravel() for array in arrays]


def _numbers(argument: Any, kind: Any) -> numpy.ndarray[Any, Any]:
    if isinstance(argument, numpy.ma.MaskedArray) and numpy.any(argument.mask):
        raise ValueError("an array hides numbers under its mask: leave them out or fill them")
    array = numpy.asarray(argument)
    if kind is numpy.int64 and not numpy.can_cast(array.dtype, numpy.int64):
        with numpy.errstate(invalid="ignore"):
            if not numpy.all(array % 1 == 0):
                raise ValueError("counts are whole numbers")
        if not numpy.all(abs(array) < 2**63):
            raise ValueError(f"a count cannot be {array.flat[numpy.argmax(abs(array))]}")
    return array.astype(kind)


def records(columns: Mapping[str, Any], shape: tuple[int, ...] | None = None) -> numpy.recarray[Any, Any]:
    """The record array of named arrays, all of one length."""
    types = [(name, column.dtype) for name, column in columns.items()]
    table: numpy.recarray[Any, Any] = numpy.rec.fromarrays(list(columns.values()), dtype=types)
    return table if shape is None else table.reshape(shape).view(numpy.recarray)


def plain(column: Column) -> Any:
    """A column without missing cells as an array; texts as str of numpy."""
    kind, values, rest = column
    if kind == "text":
        return numpy.asarray(["", *rest[1:]])[values]
    return values.astype(bool) if kind == "truth" else values


_KINDS = {name: kind for name, (kind, _) in _trivela.column_kinds().items()}
_NUMBERS = ("_m", "_mps", "_rad", "_radps", "_s", "_probability", "_doubt", "power")


def _kind(name: str) -> str:
    for known in (name, name.removeprefix("truth_"), name.removeprefix("observed_")):
        if known in _KINDS:
            return _KINDS[known]
    return "number" if name.endswith(_NUMBERS) else ""


def series(name: str, column: Column) -> Any:
    """A column of a data frame. Numbers are float64 with NaN where there is none, truths are boolean, whole numbers int64, or Int64
    where some are missing, texts object with None."""
    kind, values, rest = column
    wanted = _kind(name)
    if kind == "text":
        return numpy.asarray(rest, dtype=object)[values]
    if kind == "number" or wanted == "number":
        numbers = values.astype(numpy.float64)
        return numpy.where(rest, numpy.nan, numbers)
    if kind == "truth" or wanted == "truth":
        return pandas.arrays.BooleanArray(values.astype(bool), rest.copy())
    if kind == "none":
        return numpy.full(len(values), None, dtype=object)
    return pandas.arrays.IntegerArray(values, rest.copy()) if rest.any() else values


def frame(columns: Mapping[str, Column]) -> pandas.DataFrame:
    """The data frame of columns."""
    return pandas.DataFrame({name: series(name, column) for name, column in columns.items()})
