#pragma once

#include <map>
#include <string>
#include <utility>

#include "kicking/policy/policy.hpp"
#include "kicking/policy/policy_output.hpp"
#include "python/arrays.hpp"

namespace trivela::python {

using namespace kicking;

/// A dict that any thread may copy and let go.
class HeldDict {
 public:
  HeldDict() = default;
  HeldDict(const HeldDict& other) { *this = other; }
  HeldDict(HeldDict&& other) noexcept : dict_(std::move(other.dict_)) {}
  HeldDict& operator=(HeldDict&& other) noexcept {
    std::swap(dict_, other.dict_);
    return *this;
  }
  HeldDict& operator=(const HeldDict& other) {
    const py::gil_scoped_acquire python;
    dict_ = other.dict_ ? py::reinterpret_steal<py::object>(PyDict_Copy(other.dict_.ptr())) : py::object{};
    return *this;
  }
  ~HeldDict() {  // NOLINT(bugprone-exception-escape): without an interpreter nothing is held
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
    if (found == settings->end()) throw py::key_error("the policy has no setting " + key);
    return found->second;
  }
};

/// Adds the classes Output and Cycle.
void add_output(py::module_& module);
void add_cycle(py::module_& module);

}  // namespace trivela::python
