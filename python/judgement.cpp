#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "config/settings_fields.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/outcome/outcome.hpp"
#include "python/checks.hpp"

namespace trivela::python {
namespace {

using Numbers = Flat<double>;

py::array judge(const Numbers& x_cross_m, const Numbers& z_cross_m, const kicking::Goal& goal, double ball_radius_m) {
  require_ball_radius(ball_radius_m);
  const auto x = span_of(x_cross_m), z = span_of(z_cross_m);
  std::vector<std::int8_t> outcomes(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    outcomes[i] = static_cast<std::int8_t>(kicking::classify(x[i], z[i], goal, {.radius_m = ball_radius_m}));
  return array_of(std::move(outcomes));
}

py::dict judge_probabilities(const Numbers& x_cross_m, const Numbers& sd_x_m, const Numbers& z_cross_m,
                             const Numbers& sd_z_m, const kicking::Goal& goal, double ball_radius_m) {
  const auto x = span_of(x_cross_m), sd_x = span_of(sd_x_m), z = span_of(z_cross_m), sd_z = span_of(sd_z_m);
  require_finite("x_cross_m", x);
  require_finite("z_cross_m", z);
  require_positive("sd_x_m", sd_x);
  require_positive("sd_z_m", sd_z);
  require_ball_radius(ball_radius_m);
  constexpr std::size_t kinds = std::tuple_size_v<kicking::OutcomeProbabilities>;
  std::vector<std::vector<double>> p(kinds, std::vector<double>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto row = kicking::crossing_probabilities(x[i], sd_x[i], z[i], sd_z[i], goal, {.radius_m = ball_radius_m});
    for (std::size_t kind = 0; kind < kinds; ++kind) p[kind][i] = row[kind];
  }
  py::dict columns;
  for (std::size_t kind = 0; kind < kinds; ++kind) columns[kicking::kOutcomeNames[kind]] = array_of(std::move(p[kind]));
  return columns;
}

kicking::Goal goal_of(double y_m, double half_width_m, double height_m, double post_width_m) {
  const auto require = [](const char* name, double value) {
    require_within(name, value, range_of<kicking::Goal>(name));
  };
  require("y_m", y_m);
  require("half_width_m", half_width_m);
  require("height_m", height_m);
  require("post_width_m", post_width_m);
  return {y_m, half_width_m, height_m, post_width_m};
}

}  // namespace

void add_judgement(py::module_& module) {
  module.attr("outcomes") = py::tuple(py::cast(kicking::kOutcomeNames));
  const kicking::Goal goal;
  py::class_<kicking::Goal>(
      module, "Goal",
      "The opponents' goal: its line in the field frame, inner half-width, height, width of the frame [m].\n"
      "Raises ValueError for a number outside the range that the settings allow.")
      .def(py::init(&goal_of), py::kw_only(), py::arg("y_m") = goal.y_m, py::arg("half_width_m") = goal.half_width_m,
           py::arg("height_m") = goal.height_m, py::arg("post_width_m") = goal.post_width_m)
      .def(py::pickle(
          [](const kicking::Goal& of) { return std::tuple(of.y_m, of.half_width_m, of.height_m, of.post_width_m); },
          [](const std::tuple<double, double, double, double>& state) { return std::apply(goal_of, state); }))
      .def_readonly("y_m", &kicking::Goal::y_m)
      .def_readonly("half_width_m", &kicking::Goal::half_width_m)
      .def_readonly("height_m", &kicking::Goal::height_m)
      .def_readonly("post_width_m", &kicking::Goal::post_width_m);
  module.def("judge", judge);
  module.def("judge_probabilities", judge_probabilities);
}

}  // namespace trivela::python
