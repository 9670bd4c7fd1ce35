"""Intervals and tests of counts: k of n kicks were on target. As in docs/evaluation.md, checked against R.

Counts may have any shapes that numpy brings to one. An interval has that shape with one axis more, for low and high end; a ratio or
a posterior difference three numbers: value, low, high. NaN: there is no such number. Two groups are the older and the newer one, and
a difference is newer - older. Raises ValueError for counts that make no sense or lie above 1e9, and for a
confidence that is not between 0 and 1.
"""
from __future__ import annotations

from typing import Any, Callable

import numpy
from numpy.typing import ArrayLike

from . import _trivela
from ._trivela import kicks_per_policy, mcnemar

Array = numpy.ndarray[Any, Any]

__all__ = [
    "agresti_caffo", "always_valid_p", "boschloo_one_sided", "boschloo_two_sided", "clopper_pearson", "confidence_sequence", "difference_sequence",
    "expected_loss_of_newer", "fisher_one_sided", "fisher_two_sided", "holm", "kicks_per_policy", "mcnemar", "newcombe", "odds_ratio", "p_newer_better",
    "paired_newcombe", "posterior_difference", "rate_interval", "rate_ratio", "risk_ratio", "wilson",
]


def _rows(function: Callable[..., Array], counts: tuple[ArrayLike, ...], confidence: float, width: int) -> Array:
    from ._arrays import flat

    shape, arrays = flat(*counts, kind=numpy.int64)
    return function(*arrays, confidence).reshape(shape if width == 1 else (*shape, width))


def wilson(inside: ArrayLike, n: ArrayLike, confidence: float = 0.95) -> Array:
    """Wilson's score interval of a proportion (Wilson 1927). No kick: 0 to 1."""
    return _rows(_trivela.wilson, (inside, n), confidence, 2)


def clopper_pearson(inside: ArrayLike, n: ArrayLike, confidence: float = 0.95) -> Array:
    """Exact interval of a proportion (Clopper and Pearson 1934). No kick: 0 to 1."""
    return _rows(_trivela.clopper_pearson, (inside, n), confidence, 2)


def confidence_sequence(inside: ArrayLike, n: ArrayLike, confidence: float = 0.95) -> Array:
    """Interval that holds at every look at once (Robbins 1970): for who looks after each kick. No kick: 0 to 1."""
    return _rows(_trivela.confidence_sequence, (inside, n), confidence, 2)


def newcombe(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """Newcombe's hybrid interval of the difference (Newcombe 1998, method 10)."""
    return _rows(_trivela.newcombe, (older_inside, older_n, newer_inside, newer_n), confidence, 2)


def agresti_caffo(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """Agresti and Caffo's interval of the difference (2000), for small groups."""
    return _rows(_trivela.agresti_caffo, (older_inside, older_n, newer_inside, newer_n), confidence, 2)


def difference_sequence(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """Interval of the difference that holds at every look at once (Turner, Ly and Gruenwald 2024)."""
    return _rows(_trivela.difference_sequence, (older_inside, older_n, newer_inside, newer_n), confidence, 2)


def risk_ratio(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """p_new / p_old with Katz's interval."""
    return _rows(_trivela.risk_ratio, (older_inside, older_n, newer_inside, newer_n), confidence, 3)


def odds_ratio(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """Sample odds ratio with Woolf's interval."""
    return _rows(_trivela.odds_ratio, (older_inside, older_n, newer_inside, newer_n), confidence, 3)


def posterior_difference(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike, confidence: float = 0.95) -> Array:
    """Median and central interval of p_new - p_old with uniform priors."""
    return _rows(_trivela.posterior_difference, (older_inside, older_n, newer_inside, newer_n), confidence, 3)


def fisher_one_sided(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """p of Fisher's exact test that the newer group is better."""
    return _rows(_trivela.fisher_one_sided, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def fisher_two_sided(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """p of Fisher's exact test, two-sided as R's fisher.test."""
    return _rows(_trivela.fisher_two_sided, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def boschloo_one_sided(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """p of Boschloo's exact test that the newer group is better; NaN above 10,000 kicks."""
    return _rows(_trivela.boschloo_one_sided, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def boschloo_two_sided(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """Twice the smaller of Boschloo's two one-sided p, at most 1; NaN above 10,000 kicks."""
    return _rows(_trivela.boschloo_two_sided, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def p_newer_better(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """Posterior probability that the newer group is better, with uniform priors."""
    return _rows(_trivela.p_newer_better, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def expected_loss_of_newer(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """Efficiency that is lost on average by choosing the newer group, with uniform priors."""
    return _rows(_trivela.expected_loss_of_newer, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def always_valid_p(older_inside: ArrayLike, older_n: ArrayLike, newer_inside: ArrayLike, newer_n: ArrayLike) -> Array:
    """p that holds at every look at once."""
    return _rows(_trivela.always_valid_p, (older_inside, older_n, newer_inside, newer_n), 0.95, 1)


def paired_newcombe(both: int, newer_only: int, older_only: int, neither: int, confidence: float = 0.95) -> tuple[float, float]:
    """Newcombe's interval of the difference on the same opportunities (1998b, method 10)."""
    low, high = _trivela.paired_newcombe(both, newer_only, older_only, neither, confidence)
    return low, high


def rate_interval(events: int, minutes: float, confidence: float = 0.95) -> tuple[float, float]:
    """Exact interval of events a minute (Garwood 1936)."""
    low, high = _trivela.rate_interval(events, minutes, confidence)
    return low, high


def rate_ratio(
    older_events: int, older_minutes: float, newer_events: int, newer_minutes: float, confidence: float = 0.95
) -> tuple[float, float, float, float] | None:
    """Ratio newer / older of events a minute: value, low, high, and p that they are equal (R's poisson.test). None: neither has an event."""
    ratio = _trivela.rate_ratio(older_events, older_minutes, newer_events, newer_minutes, confidence)
    return None if ratio is None else (ratio[0], ratio[1], ratio[2], ratio[3])


def holm(p: ArrayLike) -> Array:
    """p values adjusted by Holm's step-down method (1979), in their order and shape."""
    from ._arrays import flat

    shape, (flat_p,) = flat(p)
    return _trivela.holm(flat_p).reshape(shape)
