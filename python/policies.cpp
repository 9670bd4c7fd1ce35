#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <map>

#include "kicking/policy/drive.hpp"
#include "kicking/policy/policy.hpp"
#include "kicking/policy/policy_output.hpp"
#include "python/arrays.hpp"

namespace trivela::python {
namespace {

using namespace kicking;

/// A dict that any thread may copy and let go.
class HeldDict {
 public:
  HeldDict() = default;
  HeldDict(const HeldDict& other) { *this = other; }
  HeldDict& operator=(const HeldDict& other) {
    const py::gil_scoped_acquire python;
    dict_ = other.dict_ ? py::reinterpret_steal<py::object>(PyDict_Copy(other.dict_.ptr())) : py::object{};
    return *this;
  }
  ~HeldDict() {
    if (!dict_) return;
    const py::gil_scoped_acquire python;
    dict_ = py::object{};
  }
  py::object& get() {
    if (!dict_) dict_ = py::dict{};
    return dict_;
  }

 private:
  py::object dict_;
};

struct PythonMemory : PossessionMemory {
  HeldDict dict;
  // Of the built-in rules that the policy may ask.
  StoppedMemory stopped;
  MovingMemory moving;
  PredictiveMemory predictive;

  void watch(const PolicyConfig& config, const PolicyInput& input) override { predictive.watch(config, input); }
};

/// What one cycle knows, while it is asked.
struct Cycle {
  const PolicyConfig* config = nullptr;  // nullptr: it is over
  const RobotModel* robot = nullptr;
  const Goal* goal = nullptr;
  const PolicyInput* input = nullptr;
  PythonMemory* memory = nullptr;
  const std::map<std::string, double>* settings = nullptr;

  void require_now() const {
    if (config == nullptr) throw py::value_error("a cycle is known while evaluate() is asked, and not later");
  }

  /// What a built-in rule says; the possession is the policy's.
  template <class Memory>
  PolicyOutput ask(Rule<Memory>* rule, Memory PythonMemory::*part) const {
    require_now();
    PossessionMemory& own = *memory;
    PossessionMemory& rules = memory->*part;
    rules = own;
    PolicyOutput output = rule(*config, *robot, *goal, *input, memory->*part);
    own = rules;
    return output;
  }

  PolicyOutput shot(double target_x_m) const {
    require_now();
    const Eigen::Vector2d target_m{target_x_m, goal->y_m};
    PolicyOutput output = describe(*config, *goal, moving_shot(*config, *robot, *goal, *input, target_m));
    output.target_x_m = target_x_m;
    return output;
  }

  double setting(const std::string& key) const {
    require_now();
    const auto found = settings->find(key);
    if (found == settings->end()) throw py::key_error(key);
    return found->second;
  }
};

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
  void replace(const py::function& evaluate) { evaluate_ = py::function(evaluate).release().ptr(); }

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

void add_policies(py::module_& module) {
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
  module.def("register_policy", register_python, py::arg("name"), py::arg("settings"), py::arg("evaluate"));
}

}  // namespace trivela::python
