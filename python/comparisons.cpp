#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/table2/table2.hpp"
#include "python/checks.hpp"
#include "python/signals.hpp"

namespace trivela::python {
namespace {

using Texts = std::pair<std::string, std::string>;  // JSON, and what the program prints

Texts texts_of(const auto& comparison) { return {evaluator::to_json(comparison), evaluator::to_text(comparison)}; }

Texts compare_logs(const std::vector<std::string>& logs, const evaluator::ComparisonQuestion& question) {
  evaluator::check(question);
  return reading([&] { return texts_of(evaluator::compare_logs({logs.begin(), logs.end()}, question)); });
}

evaluator::NamedCounts counts_of(const std::string& name, std::int64_t inside, std::int64_t n) {
  const evaluator::stats::Counts counts{inside, n};
  require_counts(name, name, counts);
  if (n == 0) throw py::value_error(fmt::format("{}: without a kick there is nothing to compare", name));
  return {name, counts};
}

using Group = std::tuple<std::string, std::int64_t, std::int64_t>;

Texts compare_counts(const Group& older, const Group& newer, double smallest_effect) {
  evaluator::check({.smallest_effect = smallest_effect});
  const auto counts = [](const Group& group) { return std::apply(counts_of, group); };
  return texts_of(evaluator::compare(counts(older), counts(newer), smallest_effect));
}

Texts report(const std::vector<std::string>& paths, bool blocked_apart) {
  return reading([&] {
    std::vector<std::unique_ptr<log::Reader>> readers;
    std::vector<evaluator::OpenLog> logs;
    for (const std::string& path : paths) {
      readers.push_back(std::make_unique<log::Reader>(path));
      logs.push_back({readers.back().get(), path});
    }
    return texts_of(evaluator::make_report(logs, blocked_apart));
  });
}

}  // namespace

void add_comparisons(py::module_& module) {
  using evaluator::ComparisonQuestion;
  py::class_<ComparisonQuestion>(module, "ComparisonQuestion")
      .def(py::init([](const std::string& by, const std::string& stratify, const std::string& baseline,
                       const std::string& design, bool truth, bool blocked_apart, double smallest_effect) {
        return ComparisonQuestion{.kicks = {by, stratify, truth, blocked_apart},
                                  .baseline = baseline,
                                  .design = design,
                                  .smallest_effect = smallest_effect};
      }));
  module.def("compare_logs", compare_logs);
  module.def("compare_counts", compare_counts, py::call_guard<py::gil_scoped_release>());
  module.def("report", report);
}

}  // namespace trivela::python
