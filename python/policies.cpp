#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <memory>
#include <string>

#include "log/schema/digest.hpp"
#include "python/cycle.hpp"

namespace trivela::python {
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
