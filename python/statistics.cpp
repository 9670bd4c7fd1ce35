#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>

#include "evaluator/stats/bayes.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/confidence_sequence.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/counts/most_kicks.hpp"
#include "evaluator/stats/paired.hpp"
#include "evaluator/stats/poisson.hpp"
#include "evaluator/stats/test_plan.hpp"
#include "python/checks.hpp"

namespace trivela::python {
namespace {

namespace stats = evaluator::stats;
using stats::Counts;
using Whole = Flat<std::int64_t>;

template <std::size_t width>
using Cells = std::array<double, width>;

Cells<1> cells(double value) { return {value}; }
Cells<1> cells(std::optional<double> value) { return {value.value_or(kNone)}; }
Cells<2> cells(stats::Interval interval) { return {interval.lo, interval.hi}; }
Cells<3> cells(const std::optional<stats::Ratio>& ratio) {
  return ratio ? Cells<3>{ratio->value, ratio->ci.lo, ratio->ci.hi} : Cells<3>{kNone, kNone, kNone};
}
Cells<3> cells(const stats::PosteriorDifference& posterior) {
  return {posterior.median, posterior.central.lo, posterior.central.hi};
}

void require_all_counts(const char* inside_name, const char* n_name, const Whole& inside, const Whole& n) {
  const auto k = span_of(inside), all = span_of(n);
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (k[i] >= 0 && k[i] <= all[i] && all[i] <= stats::kMaxKicks) continue;  // without making up names
    require_counts(fmt::format("{}[{}]", inside_name, i), fmt::format("{}[{}]", n_name, i), {k[i], all[i]});
  }
}

void require_confidence(double confidence) { require_level("confidence", confidence); }

/// Rows of `f` for one group of kicks: (inside, n, confidence).
template <class F>
auto of_group(F f) {
  return [f](const Whole& inside, const Whole& n, double confidence) {
    require_all_counts("inside", "n", inside, n);
    require_confidence(confidence);
    std::vector<double> flat;
    const auto k = span_of(inside), all = span_of(n);
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < k.size(); ++i) {
      const auto row = cells(f(Counts{k[i], all[i]}, confidence));
      flat.insert(flat.end(), row.begin(), row.end());
    }
    const py::gil_scoped_acquire python;
    return array_of(std::move(flat));
  };
}

/// Rows of `f` for two groups: (older, newer, confidence).
template <class F>
auto of_groups(F f) {
  return [f](const Whole& older_inside, const Whole& older_n, const Whole& newer_inside, const Whole& newer_n,
             double confidence) {
    require_all_counts("older_inside", "older_n", older_inside, older_n);
    require_all_counts("newer_inside", "newer_n", newer_inside, newer_n);
    require_confidence(confidence);
    std::vector<double> flat;
    const auto k1 = span_of(older_inside), n1 = span_of(older_n), k2 = span_of(newer_inside), n2 = span_of(newer_n);
    const py::gil_scoped_release others;
    for (std::size_t i = 0; i < k1.size(); ++i) {
      const auto row = cells(f(Counts{k1[i], n1[i]}, Counts{k2[i], n2[i]}, confidence));
      flat.insert(flat.end(), row.begin(), row.end());
    }
    const py::gil_scoped_acquire python;
    return array_of(std::move(flat));
  };
}

/// The same where `f` has no confidence.
template <class F>
auto of_counts(F f) {
  return of_groups([f](Counts older, Counts newer, double) { return f(older, newer); });
}

stats::PairedCounts pairs_of(std::int64_t both, std::int64_t newer_only, std::int64_t older_only,
                             std::int64_t neither) {
  require_count("both", both);
  require_count("newer_only", newer_only);
  require_count("older_only", older_only);
  require_count("neither", neither);
  return {both, newer_only, older_only, neither};
}

/// `whose`: what the arguments' names begin with.
stats::Rate rate_of(const std::string& whose, std::int64_t events, double minutes) {
  require_count(whose + "events", events);
  if (!(minutes > 0.0 && std::isfinite(minutes)))
    throw py::value_error(fmt::format("{}minutes {:g}: is not above 0", whose, minutes));
  return {events, minutes};
}

void add_intervals(py::module_& module) {
  module.def("wilson", of_group([](Counts c, double confidence) { return stats::wilson(c, confidence); }));
  module.def("clopper_pearson",
             of_group([](Counts c, double confidence) { return stats::clopper_pearson(c, confidence); }));
  module.def("confidence_sequence",
             of_group([](Counts c, double confidence) { return stats::confidence_sequence(c, confidence); }));
  module.def("newcombe", of_groups([](Counts a, Counts b, double confidence) { return newcombe(a, b, confidence); }));
  module.def("agresti_caffo",
             of_groups([](Counts a, Counts b, double confidence) { return agresti_caffo(a, b, confidence); }));
  module.def("difference_sequence",
             of_groups([](Counts a, Counts b, double confidence) { return difference_sequence(a, b, confidence); }));
  module.def("risk_ratio",
             of_groups([](Counts a, Counts b, double confidence) { return risk_ratio(a, b, confidence); }));
  module.def("odds_ratio",
             of_groups([](Counts a, Counts b, double confidence) { return odds_ratio(a, b, confidence); }));
  module.def("posterior_difference",
             of_groups([](Counts a, Counts b, double confidence) { return posterior_difference(a, b, confidence); }));
}

void add_tests(py::module_& module) {
  module.def("fisher_one_sided", of_counts([](Counts a, Counts b) { return stats::fisher_one_sided(a, b); }));
  module.def("fisher_two_sided", of_counts([](Counts a, Counts b) { return stats::fisher_two_sided(a, b); }));
  module.def("boschloo_one_sided", of_counts([](Counts a, Counts b) { return stats::boschloo_one_sided(a, b); }));
  module.def("boschloo_two_sided",
             of_counts([](Counts a, Counts b) { return stats::boschloo_two_sided_doubled(a, b); }));
  module.def("p_newer_better", of_counts([](Counts a, Counts b) { return stats::p_new_better(a, b); }));
  module.def("expected_loss_of_newer",
             of_counts([](Counts a, Counts b) { return stats::expected_loss_of_newer(a, b); }));
  module.def("always_valid_p", of_counts([](Counts a, Counts b) { return stats::always_valid_p(a, b); }));
}

void add_pairs_and_plans(py::module_& module) {
  module.def(
      "mcnemar",
      [](std::int64_t both, std::int64_t newer_only, std::int64_t older_only, std::int64_t neither) {
        return stats::mcnemar_two_sided(pairs_of(both, newer_only, older_only, neither));
      },
      "p of McNemar's exact test (1947), two-sided; 1 where the two never differ.", py::arg("both"),
      py::arg("newer_only"), py::arg("older_only"), py::arg("neither"));
  module.def("paired_newcombe", [](std::int64_t both, std::int64_t newer_only, std::int64_t older_only,
                                   std::int64_t neither, double confidence) {
    require_confidence(confidence);
    return cells(stats::paired_newcombe(pairs_of(both, newer_only, older_only, neither), confidence));
  });
  module.def(
      "kicks_per_policy",
      [](double p1, double p2, double power, double alpha) {
        require_within("p1", p1, {0.0, 1.0});
        require_within("p2", p2, {0.0, 1.0});
        require_level("power", power);
        require_level("alpha", alpha);
        return stats::kicks_per_policy(p1, p2, power, alpha);
      },
      "Kicks of each policy with which the two-sided test of level alpha finds p1 against p2 with this power (R's\n"
      "power.prop.test), not rounded; None: p1 == p2.",
      py::arg("p1"), py::arg("p2"), py::arg("power") = stats::kPower, py::arg("alpha") = 0.05);
}

void add_rates(py::module_& module) {
  module.def("rate_interval", [](std::int64_t events, double minutes, double confidence) {
    require_confidence(confidence);
    return cells(stats::rate_interval(rate_of("", events, minutes), confidence));
  });
  module.def("rate_ratio",
             [](std::int64_t older_events, double older_minutes, std::int64_t newer_events, double newer_minutes,
                double confidence) -> std::optional<Cells<4>> {
               require_confidence(confidence);
               const auto ratio = stats::rate_ratio(rate_of("older_", older_events, older_minutes),
                                                    rate_of("newer_", newer_events, newer_minutes), confidence);
               if (!ratio) return std::nullopt;
               return Cells<4>{ratio->value, ratio->ci.lo, ratio->ci.hi, ratio->p};
             });
}

}  // namespace

void add_statistics(py::module_& module) {
  add_intervals(module);
  add_tests(module);
  add_pairs_and_plans(module);
  add_rates(module);
  module.def("holm", [](const Flat<double>& p) {
    require("p", span_of(p), "is not from 0 to 1", [](double x) { return x >= 0.0 && x <= 1.0; });
    return array_of(stats::holm(span_of(p)));
  });
}

}  // namespace trivela::python
