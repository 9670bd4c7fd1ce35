"""The statistics against the values that R gives (docs/evaluation.md), and against the program."""
import numpy
import pytest
import trivela
from trivela import stats

from conftest import answer, program, refusal, vectors

TABLE2 = (34, 65, 100, 132)


def test_table_2_has_its_published_statistics():
    known = {row["quantity"]: float(row["value"]) for row in vectors("table2_statistics.csv")}
    assert stats.wilson(34, 65) == pytest.approx([known["Wilson95 IranOpen lo"], known["Wilson95 IranOpen hi"]], abs=5e-7)
    assert stats.wilson(100, 132) == pytest.approx([known["Wilson95 Robotica lo"], known["Wilson95 Robotica hi"]], abs=5e-7)
    assert stats.newcombe(*TABLE2) == pytest.approx([known["Newcombe95 diff lo"], known["Newcombe95 diff hi"]], abs=5e-7)
    assert stats.risk_ratio(*TABLE2)[1:] == pytest.approx([known["risk ratio CI95 lo"], known["risk ratio CI95 hi"]], abs=5e-7)
    assert stats.odds_ratio(*TABLE2)[0] == pytest.approx(known["odds ratio (sample)"], abs=5e-7)
    assert stats.fisher_two_sided(*TABLE2) == pytest.approx(known["Fisher exact two-sided p"], abs=5e-10)


def test_kicks_per_policy_are_those_of_rs_power_prop_test():
    assert stats.kicks_per_policy(0.52, 0.76) == pytest.approx(61.6, abs=0.05)
    assert stats.kicks_per_policy(0.52, 0.76, power=0.9) == pytest.approx(82.0, abs=0.05)
    assert stats.kicks_per_policy(0.5, 0.5) is None


def test_rates_are_those_of_rs_poisson_test():
    assert stats.rate_ratio(34, 180.0, 100, 300.0) == pytest.approx((1.764706, 1.185109, 2.686664, 0.004115647), abs=5e-7)
    assert stats.rate_ratio(0, 10.0, 0, 10.0) is None
    low, high = stats.rate_interval(34, 180.0)
    assert low < 34 / 180 < high
    with pytest.raises(ValueError, match="minutes 0: is not above 0"):
        stats.rate_interval(3, 0.0)


def test_holm_is_rs_p_adjust():
    numpy.testing.assert_allclose(stats.holm([[0.01, 0.04], [0.03, 0.005]]), [[0.03, 0.06], [0.06, 0.02]], rtol=1e-12)


def test_paired_counts_are_those_of_rs_binom_test():
    assert stats.mcnemar(20, 9, 3, 10) == pytest.approx(0.1459961, abs=5e-8)
    low, high = stats.paired_newcombe(20, 9, 3, 10)
    assert low < 6 / 42 < high


def test_counts_of_the_program_bit_for_bit():
    theirs = answer("compare", "--counts", "old=34/65", "new=100/132")
    ours = trivela.compare_counts(("old", 34, 65), ("new", 100, 132))
    assert ours == theirs
    assert ours.text == program("compare", "--counts", "old=34/65", "new=100/132", "--all")
    assert stats.newcombe(*TABLE2).tolist() == theirs["newcombe95"]
    assert stats.agresti_caffo(3, 8, 7, 9).tolist() == answer("compare", "--counts", "old=3/8", "new=7/9")["agresti_caffo95"]
    for name in ("fisher_one_sided", "fisher_two_sided", "boschloo_one_sided", "boschloo_two_sided"):
        assert getattr(stats, name)(*TABLE2) == theirs[f"{name}_p"]
    assert stats.p_newer_better(*TABLE2) == theirs["p_new_better"]
    assert stats.expected_loss_of_newer(*TABLE2) == theirs["expected_loss_of_new"]
    assert stats.posterior_difference(*TABLE2).tolist() == [theirs["posterior_median"], *theirs["posterior_ci95"]]


def test_counts_may_be_arrays():
    intervals = stats.wilson([[0, 3], [5, 10]], 10)
    assert intervals.shape == (2, 2, 2)
    assert intervals[1, 0].tolist() == stats.wilson(5, 10).tolist()
    assert stats.fisher_two_sided([3, 5], 10, 8, 10).shape == (2,)
    assert stats.wilson(0, 0).tolist() == [0.0, 1.0]
    assert numpy.isnan(stats.odds_ratio(0, 4, 2, 4)).all()
    assert (stats.confidence_sequence(5, 10)[0] < stats.wilson(5, 10)[0]) and stats.always_valid_p(5, 10, 6, 10) == 1.0


def test_counts_that_make_no_sense_are_refused():
    with pytest.raises(ValueError, match=r"inside\[1\]: 11 inside of only 10 kicks"):
        stats.wilson([3, 11], 10)
    assert "11 inside of only 10 kicks" in refusal("compare", "--counts", "a=11/10", "b=1/2")
    with pytest.raises(ValueError, match="a count cannot be negative"):
        stats.newcombe(-1, 3, 1, 3)
    with pytest.raises(ValueError, match="whole numbers"):
        stats.wilson(0.5, 3)
    with pytest.raises(ValueError, match="confidence 2 is not between 0 and 1"):
        stats.wilson(1, 3, confidence=2)
    with pytest.raises(ValueError, match="confidence nan is not between 0 and 1"):
        stats.wilson(1, 3, confidence=float("nan"))
    with pytest.raises(ValueError, match="without a kick there is nothing to compare"):
        trivela.compare_counts(("old", 0, 0), ("new", 1, 2))
    with pytest.raises(ValueError, match="smallest-effect"):
        trivela.compare_counts(("old", 1, 2), ("new", 1, 2), smallest_effect=3.0)


GROUPS = ("newcombe", "agresti_caffo", "difference_sequence", "risk_ratio", "odds_ratio", "posterior_difference", "fisher_one_sided", "fisher_two_sided",
          "boschloo_one_sided", "boschloo_two_sided", "p_newer_better", "expected_loss_of_newer", "always_valid_p")


def test_counts_that_the_program_refuses_are_refused():
    most = 10**9
    assert f"more than {most} kicks" in refusal("compare", "--counts", f"a=1/{most + 1}", "b=1/2")
    for name in ("wilson", "clopper_pearson", "confidence_sequence"):
        assert getattr(stats, name)(1, most).shape == (2,)
        with pytest.raises(ValueError, match=rf"^n\[0\]: '{most + 1}' is more than {most}$"):
            getattr(stats, name)(1, most + 1)
    with pytest.raises(ValueError, match="is more than"):
        stats.clopper_pearson(10**15, 10**16)
    for name in GROUPS:
        with pytest.raises(ValueError, match=r"^newer_n\[0\]: '1000000001' is more than"):
            getattr(stats, name)(1, 2, 1, most + 1)
    for counts, name in (((most + 1, 0, 0, 0), "both"), ((0, most + 1, 0, 0), "newer_only"), ((0, 0, -1, 0), "older_only"), ((0, 0, 0, -1), "neither")):
        for test in (stats.mcnemar, stats.paired_newcombe):
            with pytest.raises(ValueError, match=f"^{name}: '"):
                test(*counts)
    with pytest.raises(ValueError, match="^events: '1000000001' is more than"):
        stats.rate_interval(most + 1, 1.0)
    with pytest.raises(ValueError, match="^newer_events: '-1': a count cannot be negative"):
        stats.rate_ratio(1, 1.0, -1, 1.0)
    with pytest.raises(ValueError, match="^new: '1000000001' is more than"):
        trivela.compare_counts(("old", 1, 2), ("new", 1, most + 1))


@pytest.mark.parametrize("count", [1e300, 2.0**63, 10**30, 2**64 - 1])
def test_counts_beyond_64_bits_are_refused(count):
    with pytest.raises(ValueError, match="a count cannot be"):
        stats.wilson(1, count)


@pytest.mark.parametrize("count", [float("nan"), float("inf"), 0.5])
def test_counts_are_whole(count):
    with pytest.raises(ValueError, match="whole numbers"):
        stats.wilson(1, count)


def test_levels_at_0_or_1_are_refused():
    near = numpy.nextafter(1.0, 0.0)
    with pytest.raises(ValueError, match="^confidence 0.9999999999999999 is nearer to 0 or 1 than 1e-15$"):
        stats.wilson(1, 3, confidence=near)
    for power, alpha, name in ((1.0, 0.05, "power"), (0.0, 0.05, "power"), (near, 0.05, "power"), (1e-300, 0.05, "power"), (0.8, 0.0, "alpha"), (0.8, 1e-20, "alpha")):
        with pytest.raises(ValueError, match=f"^{name} "):
            stats.kicks_per_policy(0.5, 0.6, power, alpha)
    with pytest.raises(ValueError, match="^p2: '1.5' is not from 0 to 1$"):
        stats.kicks_per_policy(0.5, 1.5)
    for level in (1.1e-15, 1.0 - 1.2e-15):
        assert numpy.isfinite(stats.clopper_pearson(3, 10, level)).all() and numpy.isfinite(stats.newcombe(*TABLE2, level)).all()
        assert stats.kicks_per_policy(0.5, 0.6, level, level) >= 0.0
        stats.rate_ratio(3, 1.0, 5, 1.0, level)


def test_what_a_mask_hides_is_refused():
    with pytest.raises(ValueError, match="mask"):
        stats.wilson(numpy.ma.masked_greater([1, 5], 3), 10)
    with pytest.raises(ValueError, match="mask"):
        stats.holm(numpy.ma.masked_greater([0.1, 0.5], 0.3))
