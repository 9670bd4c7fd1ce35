#include "python/cycle.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "kicking/policy/drive.hpp"

namespace trivela::python {
namespace {

Reason reason_named(const std::string& text) {
  const auto found = std::ranges::find(kReasonNames, text);
  if (found == kReasonNames.end()) throw py::value_error(fmt::format("'{}' is no reason", text));
  return static_cast<Reason>(found - kReasonNames.begin());
}

std::optional<double> of(Maybe number) { return number; }

/// A number of the cycle.
template <class Get>
auto known(Get get) {
  return [get](const Cycle& cycle) {
    cycle.require_now();
    return get(cycle);
  };
}

}  // namespace

void add_output(py::module_& module) {
  using Output = PolicyOutput;
  const auto maybe = [](Maybe Output::*field) {
    return std::pair{[field](const Output& output) { return of(output.*field); },
                     [field](Output& output, std::optional<double> value) { output.*field = value; }};
  };
  const auto drive = [](double Twist::*part) {
    return std::pair{[part](const Output& output) { return output.drive.*part; },
                     [part](Output& output, double value) { output.drive.*part = value; }};
  };
  py::class_<Output> output(module, "Output",
                            "What a policy decides in a cycle: reason, power, drive, and the numbers behind them.");
  output.def(py::init<>())
      .def_property(
          "reason", [](const Output& out) { return name(out.reason); },
          [](Output& out, const std::string& text) { out.reason = reason_named(text); })
      .def_readwrite("target_x_m", &Output::target_x_m)
      .def_readwrite("target_z_m", &Output::target_z_m)
      .def_readwrite("distance_m", &Output::distance_m)
      .def_readwrite("aligned", &Output::aligned)
      .def_readwrite("fire_after_s", &Output::fire_after_s)
      .def_readwrite("kick_kind", &Output::kick_kind)
      .def_readwrite("lever_kind", &Output::lever_kind)
      .def_property_readonly("predicted_x_cross_m",
                             [](const Output& out) { return of(predicted<&PredictedCrossing::x_m>(out)); })
      .def_property_readonly("predicted_z_cross_m",
                             [](const Output& out) { return of(predicted<&PredictedCrossing::z_m>(out)); });
  const std::pair<const char*, Maybe Output::*> numbers[] = {{"power", &Output::power},
                                                             {"v_kick_mps", &Output::v_kick_mps},
                                                             {"p_on_target", &Output::p_on_target},
                                                             {"p_goal", &Output::p_goal}};
  for (const auto& [key, field] : numbers) {
    const auto [get, set] = maybe(field);
    output.def_property(key, get, set);
  }
  const std::pair<const char*, double Twist::*> parts[] = {
      {"vx_mps", &Twist::vx_mps}, {"vy_mps", &Twist::vy_mps}, {"omega_radps", &Twist::omega_radps}};
  for (const auto& [key, part] : parts) {
    const auto [get, set] = drive(part);
    output.def_property(key, get, set);
  }
}

void add_cycle(py::module_& module) {
  py::class_<Cycle, std::shared_ptr<Cycle>> cycle(
      module, "Cycle", "What a robot knows in one cycle, and what the built-in policies would do in it.");
  cycle.def("stopped", [](const Cycle& c) { return c.ask(&evaluate_stopped, &PythonMemory::stopped); })
      .def("moving", [](const Cycle& c) { return c.ask(&evaluate_moving, &PythonMemory::moving); })
      .def("predictive", [](const Cycle& c) { return c.ask(&evaluate_predictive, &PythonMemory::predictive); })
      .def("shot", &Cycle::shot, py::arg("target_x_m"))
      .def("setting", &Cycle::setting, py::arg("key"))
      .def(
          "turn_rate_radps",
          [](const Cycle& c, double heading_error_rad) {
            c.require_now();
            return turn_rate_for(heading_error_rad, c.config->moving_turn_gain_hz, *c.config);
          },
          py::arg("heading_error_rad"));
  const auto number = [&](const char* key, auto get) { cycle.def_property_readonly(key, known(get)); };
  number("t_s", [](const Cycle& c) { return 1e-9 * static_cast<double>(c.input->t_ns); });
  number("x_m", [](const Cycle& c) { return c.input->pose.x_m; });
  number("y_m", [](const Cycle& c) { return c.input->pose.y_m; });
  number("heading_rad", [](const Cycle& c) { return c.input->pose.heading_rad; });
  number("vx_mps", [](const Cycle& c) { return c.input->twist.vx_mps; });
  number("vy_mps", [](const Cycle& c) { return c.input->twist.vy_mps; });
  number("omega_radps", [](const Cycle& c) { return c.input->twist.omega_radps; });
  number("sd_position_m", [](const Cycle& c) { return c.input->sd_position_m; });
  number("sd_heading_rad", [](const Cycle& c) { return c.input->sd_heading_rad; });
  number("opponent_distance_m", [](const Cycle& c) { return of(c.input->opponent_distance_m); });
  number("keeper_x_m",
         [](const Cycle& c) { return c.input->keeper ? std::optional{c.input->keeper->x_m} : std::nullopt; });
  number("opponents_m", [](const Cycle& c) {
    std::vector<std::pair<double, double>> places;
    for (std::size_t i = 0; i < c.input->opponent_count; ++i)
      places.emplace_back(c.input->opponents[i].position_m.x(), c.input->opponents[i].position_m.y());
    return places;
  });
  number("goal_y_m", [](const Cycle& c) { return c.goal->y_m; });
  number("goal_half_width_m", [](const Cycle& c) { return c.goal->half_width_m; });
  number("goal_height_m", [](const Cycle& c) { return c.goal->height_m; });
}

}  // namespace trivela::python
