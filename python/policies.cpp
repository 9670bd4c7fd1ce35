#include "python/policies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "kicking/policy/drive.hpp"
#include "log/schema/digest.hpp"

namespace trivela::python {
namespace {

Reason reason_named(const std::string& text) {
  const auto found = std::ranges::find(kReasonNames, text);
  if (found == kReasonNames.end())
    throw py::value_error(fmt::format("'{}' is no reason; there are {}", text, fmt::join(kReasonNames, ", ")));
  return static_cast<Reason>(found - kReasonNames.begin());
}

std::optional<double> of(OptionalDouble number) { return number; }

using OutputClass = py::class_<PolicyOutput>;
using CycleClass = py::class_<Cycle, std::shared_ptr<Cycle>>;

void add_number(OutputClass& output, const char* key, OptionalDouble PolicyOutput::*field, const char* what) {
  output.def_property(
      key, [field](const PolicyOutput& out) { return of(out.*field); },
      [field](PolicyOutput& out, std::optional<double> value) { out.*field = value; }, what);
}

void add_drive(OutputClass& output, const char* key, double Twist::*part, const char* what) {
  output.def_property(
      key, [part](const PolicyOutput& out) { return out.drive.*part; },
      [part](PolicyOutput& out, double value) { out.drive.*part = value; }, what);
}

void add_rules(CycleClass& cycle) {
  cycle
      .def(
          "stopped", [](const Cycle& c) { return c.ask(&evaluate_stopped, &PythonMemory::stopped); },
          "The Output of the policy `stopped` in this cycle.")
      .def(
          "moving", [](const Cycle& c) { return c.ask(&evaluate_moving, &PythonMemory::moving); },
          "The Output of the policy `moving` in this cycle.")
      .def(
          "predictive", [](const Cycle& c) { return c.ask(&evaluate_predictive, &PythonMemory::predictive); },
          "The Output of the policy `predictive` in this cycle. Its drive is for the kick that it fires: where you "
          "hold that kick back, give the Output a drive of your own.")
      .def("shot", &Cycle::shot, py::arg("target_x_m"),
           "Power and predicted crossing of a kick at this point of the goal line, as an Output that holds.")
      .def("setting", &Cycle::setting, py::arg("key"),
           "A setting of the policy. KeyError where it has none of this key.")
      .def(
          "turn_rate_radps",
          [](const Cycle& c, double heading_error_rad) {
            c.require_now();
            return turn_rate_for(heading_error_rad, c.config->moving_turn_gain_hz, *c.config);
          },
          py::arg("heading_error_rad"),
          "Turn rate [rad/s] that takes away an error of heading [rad], within the robot's limits.");
}
/// A number that is known while evaluate() is asked.
void known(CycleClass& cycle, const char* key, auto get, const char* what) {
  const auto now = [get](const Cycle& c) {
    c.require_now();
    return get(c);
  };
  cycle.def_property_readonly(key, now, what);
}

void add_motion(CycleClass& cycle) {
  known(
      cycle, "t_s", [](const Cycle& c) { return 1e-9 * static_cast<double>(c.input->t_ns); }, "Time of the match [s].");
  known(
      cycle, "x_m", [](const Cycle& c) { return c.input->pose.x_m; }, "Robot's place to the right [m].");
  known(
      cycle, "y_m", [](const Cycle& c) { return c.input->pose.y_m; }, "Robot's place towards the goal [m].");
  known(
      cycle, "heading_rad", [](const Cycle& c) { return c.input->pose.heading_rad; },
      "Heading [rad], counter-clockwise; 0 faces +y.");
  known(
      cycle, "vx_mps", [](const Cycle& c) { return c.input->twist.vx_mps; }, "Speed to the robot's right [m/s].");
  known(
      cycle, "vy_mps", [](const Cycle& c) { return c.input->twist.vy_mps; }, "Speed forward [m/s].");
  known(
      cycle, "omega_radps", [](const Cycle& c) { return c.input->twist.omega_radps; },
      "Turn rate [rad/s], counter-clockwise.");
}

void add_surroundings(CycleClass& cycle) {
  known(
      cycle, "sd_position_m", [](const Cycle& c) { return c.input->sd_position_m; },
      "Standard deviation of the place, each axis [m].");
  known(
      cycle, "sd_heading_rad", [](const Cycle& c) { return c.input->sd_heading_rad; },
      "Standard deviation of the heading [rad].");
  known(
      cycle, "opponent_distance_m", [](const Cycle& c) { return of(c.input->opponent_distance_m); },
      "From the nearest opponent to the ball [m]; None: none is seen.");
  known(
      cycle, "keeper_x_m",
      [](const Cycle& c) { return c.input->keeper ? std::optional{c.input->keeper->x_m} : std::nullopt; },
      "Keeper's place to the right [m]; None: no keeper is tracked.");
  known(
      cycle, "opponents_m",
      [](const Cycle& c) {
        std::vector<std::pair<double, double>> places;
        for (std::size_t i = 0; i < c.input->opponent_count; ++i)
          places.emplace_back(c.input->opponents[i].position_m.x(), c.input->opponents[i].position_m.y());
        return places;
      },
      "Places (x_m, y_m) of the opponents that are tracked, the keeper aside.");
  known(
      cycle, "goal_y_m", [](const Cycle& c) { return c.goal->y_m; }, "Goal line's place [m].");
  known(
      cycle, "goal_half_width_m", [](const Cycle& c) { return c.goal->half_width_m; },
      "Half of the goal's inner width [m].");
  known(
      cycle, "goal_height_m", [](const Cycle& c) { return c.goal->height_m; }, "Goal's inner height [m].");
}

}  // namespace

void add_output(py::module_& module) {
  using Output = PolicyOutput;
  const std::string reasons = fmt::format("{}", fmt::join(kReasonNames, ", "));
  py::class_<Output> output(module, "Output",
                            "What a policy decides in a cycle. `reason`, `power`, `kick_kind`, `lever_kind` and the "
                            "drive act; the other numbers are recorded.");
  output.def(py::init<>(), "Holds (reason not_playing) and stops the robot.")
      .def_property(
          "reason", [](const Output& out) { return name(out.reason); },
          [](Output& out, const std::string& text) { out.reason = reason_named(text); },
          ("\"fire\" kicks, any other one says why not: " + reasons + ". ValueError for another text.").c_str())
      .def_readwrite("target_x_m", &Output::target_x_m, "Aim point along the goal line, right positive [m].")
      .def_readwrite("target_z_m", &Output::target_z_m, "Aim point's height [m].")
      .def_readwrite("distance_m", &Output::distance_m, "From ball to aim point over ground [m].")
      .def_readwrite("aligned", &Output::aligned, "Does the alignment condition of the paper hold?")
      .def_readwrite("fire_after_s", &Output::fire_after_s, "Kick so much later, within this cycle [s].")
      .def_readwrite("kick_kind", &Output::kick_kind, "Kind of kick, 0 for the robot file's first.")
      .def_readwrite("lever_kind", &Output::lever_kind, "Kind of kick that the lever is to stand for meanwhile.")
      .def_property_readonly(
          "predicted_x_cross_m", [](const Output& out) { return of(predicted<&PredictedCrossing::x_m>(out)); },
          "Where the ball is predicted to cross the goal line, right positive [m]; None: it does not.")
      .def_property_readonly(
          "predicted_z_cross_m", [](const Output& out) { return of(predicted<&PredictedCrossing::z_m>(out)); },
          "Its centre's height there [m]; None: it does not cross.");
  add_number(output, "power", &Output::power,
             "Set-point in the unit of the robot's table; None: no kick reaches the target.");
  add_number(output, "v_kick_mps", &Output::v_kick_mps, "Exit speed that the set-point is for [m/s], or None.");
  add_number(output, "p_on_target", &Output::p_on_target, "Probability of a ball on target, or None.");
  add_number(output, "p_goal", &Output::p_goal, "The same, and past the keeper; None: no keeper is tracked.");
  add_drive(output, "vx_mps", &Twist::vx_mps, "Drive to the robot's right until the next cycle [m/s].");
  add_drive(output, "vy_mps", &Twist::vy_mps, "Drive forward until the next cycle [m/s].");
  add_drive(output, "omega_radps", &Twist::omega_radps, "Turn counter-clockwise until the next cycle [rad/s].");
}

void add_cycle(py::module_& module) {
  CycleClass cycle(
      module, "Cycle",
      "What a robot knows in one cycle, and what the built-in policies would do in it. The field's origin is its "
      "centre spot, +y points to the opponents' goal, +x to the right. ValueError once evaluate() has returned.");
  add_rules(cycle);
  add_motion(cycle);
  add_surroundings(cycle);
}

namespace {

/// A policy whose rule is a function of Python. Nothing of it is let go: it lives as long as the process.
class PythonPolicy final : public PolicyOf<PythonMemory> {
 public:
  using Settings = std::map<std::string, std::array<double, 3>>;  // usual, least, most

  PythonPolicy(const std::string& name, const Settings& settings, const py::function& evaluate)
      : PolicyOf(name), settings_of_(settings) {
    for (const auto& [key, values] : settings) handles_.emplace(key, setting(key, values[0], {values[1], values[2]}));
    replace(evaluate);
  }

  const Settings& described() const { return settings_of_; }
  void replace(const py::function& evaluate) {
    if (evaluate.ptr() == evaluate_) return;
    evaluate_ = py::function(evaluate).release().ptr();
    code_ = log::make_uuid();
  }
  /// Two functions cannot be compared: nothing but this function goes on.
  std::string code() const override { return code_; }

  PolicyOutput evaluate(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                        PythonMemory& memory) const override {
    const py::gil_scoped_acquire python;
    std::map<std::string, double> values;
    for (const auto& [key, handle] : handles_) values[key] = handle.of(config);
    const auto cycle = std::make_shared<Cycle>(Cycle{&config, &robot, &goal, &input, &memory, &values});
    const auto over = [&] { *cycle = Cycle{}; };
    try {
      const py::object said = py::reinterpret_borrow<py::function>(evaluate_)(cycle, memory.dict.get());
      over();
      if (!py::isinstance<PolicyOutput>(said))
        throw py::type_error(fmt::format("policy {}: evaluate() must return an Output", facts().name));
      PolicyOutput output = said.cast<PolicyOutput>();
      if (output.reason == Reason::kFire && !output.power)
        throw py::value_error(fmt::format("policy {}: reason is fire, but power is None", facts().name));
      return output;
    } catch (...) {
      over();
      throw;
    }
  }

 private:
  Settings settings_of_;
  std::map<std::string, Setting> handles_;
  PyObject* evaluate_ = nullptr;
  std::string code_;
};

void register_python(const std::string& name, const PythonPolicy::Settings& settings, const py::function& evaluate) {
  static std::map<std::string, PythonPolicy*> ours;
  if (const auto known = ours.find(name); known != ours.end()) {
    if (known->second->described() != settings)
      throw py::value_error(fmt::format("policy {}: its settings cannot change in one process", name));
    return known->second->replace(evaluate);
  }
  auto policy = std::make_unique<PythonPolicy>(name, settings, evaluate);
  PythonPolicy* const made = policy.get();
  register_policy(std::move(policy));
  ours.emplace(name, made);
}

}  // namespace

void add_policies(py::module_& module) {
  add_output(module);
  add_cycle(module);
  module.def("register_policy", register_python, py::arg("name"), py::arg("settings"), py::arg("evaluate"));
}

}  // namespace trivela::python
