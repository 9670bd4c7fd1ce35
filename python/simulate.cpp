#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>

#include "config/arms.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/experiment.hpp"
#include "experiment/run/match_play.hpp"
#include "kicking/outcome/outcome.hpp"
#include "python/arrays.hpp"
#include "python/columns.hpp"
#include "sim/truth.hpp"

namespace trivela::python {
namespace {

/// What trivela.simulate() was asked for, as its Python side has it.
struct Asked {
  std::string arms;  // policies, a .toml file, or a text of [[arm]] tables
  bool arms_are_text = false;
  std::string scenario;
  std::vector<std::string> world;
  std::string config;
  std::vector<std::string> settings;
  std::vector<std::string> robots;
  std::uint32_t matches = 1, possessions = 1, calibrations = 0;
  std::uint64_t seed = 1;
  unsigned jobs = 1;
  std::string out;  // empty: no log
  bool shadows = false, every_cycle = false;
};

/// Calls Python from whatever thread plays. What the callback raises, and Ctrl-C, stop the play: they are raised again
/// once the matches under way have ended.
class Callback {
 public:
  explicit Callback(py::object callback) : callback_(std::move(callback)) {}

  void progress(double done, double all, const std::string& what) {
    const py::gil_scoped_acquire python;
    if (raised_) return;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!callback_.is_none()) callback_(static_cast<std::int64_t>(done), static_cast<std::int64_t>(all), what);
    } catch (...) {
      raised_ = std::current_exception();
    }
  }

  bool raised() const { return raised_ != nullptr; }
  void raise_again() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  py::object callback_;
  std::exception_ptr raised_;  // one thread at a time
};

experiment::ExperimentPlan plan_of(const Asked& asked, Callback& callback) {
  const experiment::ArmBase base{asked.config, asked.settings, asked.robots};
  experiment::ExperimentPlan plan;
  plan.scenario = config::load_scenario(asked.scenario);
  plan.scenario_name = std::filesystem::path{asked.scenario}.stem().string();
  for (const std::string& line : asked.world) {
    config::override_scenario(plan.scenario, line, "world");
    plan.scenario_name += ", " + line;
  }
  plan.arms = asked.arms_are_text ? experiment::arms_of(config::parse_arms(asked.arms, "arms"), base)
                                  : experiment::arms_of(asked.arms, base);
  plan.seed = asked.seed;
  plan.matches = asked.matches;
  plan.possessions = asked.possessions;
  plan.jobs = asked.jobs;
  plan.options = {.shadows = asked.shadows, .every_cycle = asked.every_cycle};
  experiment::check_calibrations(base, asked.calibrations, asked.matches);
  const auto calibrated = [&](std::size_t done, std::size_t all) {
    callback.progress(static_cast<double>(done), static_cast<double>(all), "calibrations");
    if (callback.raised()) throw std::runtime_error("stopped");
  };
  plan.calibrations = experiment::calibrated_teams(plan.scenario, asked.calibrations, plan, calibrated);
  experiment::check_playable(plan);
  return plan;
}

void add_kick(Columns& row, const std::optional<experiment::PlayedKick>& kick) {
  const auto number = [&](double experiment::PlayedKick::*field) { return kick ? (*kick).*field : kNone; };
  const auto crossing = [&](double kicking::PredictedCrossing::*field) {
    return kick && kick->predicted ? (*kick->predicted).*field : kNone;
  };
  row.add("kicked", kick.has_value());
  row.add("distance_m", number(&experiment::PlayedKick::distance_m));
  row.add("vx_mps", number(&experiment::PlayedKick::vx_mps));
  row.add("vy_mps", number(&experiment::PlayedKick::vy_mps));
  row.add("omega_radps", number(&experiment::PlayedKick::omega_radps));
  row.add("opponent_distance_m", kick ? kick->opponent_distance_m.to_message() : kNone);
  row.add("power", number(&experiment::PlayedKick::power));
  row.add("kick_kind", kick ? int{kick->kind} : -1);
  row.add("v_kick_mps", number(&experiment::PlayedKick::v_kick_mps));
  row.add("p_on_target", kick ? kick->p_on_target.to_message() : kNone);
  row.add("predicted_x_cross_m", crossing(&kicking::PredictedCrossing::x_m));
  row.add("predicted_z_cross_m", crossing(&kicking::PredictedCrossing::z_m));
  row.add("predicted_t_flight_s", crossing(&kicking::PredictedCrossing::t_flight_s));
  row.add("outcome", kick ? kicking::name(kick->observed) : "");
  row.add("truth_outcome", kick && kick->truth ? kicking::name(*kick->truth) : "");
  row.add("truth_saved", kick && kick->truth_saved);
  row.add("truth_bounced", kick && kick->truth_bounced);
}

void add_match(Columns& row, const experiment::ExperimentPlan& plan, std::uint32_t match_id,
               const std::vector<experiment::ArmMatch>& arms) {
  for (std::size_t arm = 0; arm < arms.size(); ++arm) {
    for (const experiment::PlayedPossession& possession : arms[arm].played.possessions) {
      row.begin_row();
      row.add("arm", plan.arms[arm].name);
      row.add("match_id", match_id);
      row.add("calibration_id", plan.calibrations.empty() ? -1 : static_cast<int>(match_id % plan.calibrations.size()));
      row.add("possession_id", possession.possession_id);
      row.add("robot_id", possession.robot_id);
      row.add("policy", kicking::name(possession.policy));
      row.add("assignment_probability", possession.assignment_probability);
      row.add("ending", sim::kPossessionEndNames.at(static_cast<std::size_t>(possession.ending)));
      row.add("played_s", possession.played_s);
      row.add("start_distance_m", possession.start_distance_m);
      add_kick(row, possession.kick);
    }
  }
}

/// Threads that get the interpreter's lock in turn are slower than one, which Ctrl-C stops in the middle of a match.
bool plays_python(const experiment::ExperimentPlan& plan) {
  return std::ranges::any_of(plan.arms, [](const experiment::Arm& arm) {
    return std::ranges::any_of(experiment::policies_in(arm), &kicking::from_outside);
  });
}

Columns play(const Asked& asked, Callback& callback) {
  experiment::ExperimentPlan plan = plan_of(asked, callback);
  if (plays_python(plan)) plan.jobs = 1;
  Columns columns;
  const auto take = [&](std::uint32_t match_id, const std::vector<experiment::ArmMatch>& arms) {
    add_match(columns, plan, match_id, arms);
  };
  experiment::ExperimentWatch watch{
      {},
      [&](double done, double all, const std::string& what) { callback.progress(done, all, what); },
      [&] { return callback.raised(); },
      take};
  const auto play_unrecorded = [&](std::int64_t matches) {
    experiment::ExperimentPlan part = plan;
    part.matches = static_cast<std::uint32_t>(matches);
    experiment::play_matches(part, 0, false, watch, take);
  };
  if (asked.out.empty()) {
    play_unrecorded(plan.matches);
  } else {
    watch.found = play_unrecorded;  // in the log already: played again for their rows
    experiment::run_experiment(plan, asked.out, watch);
  }
  return columns;
}

py::dict simulate(const Asked& asked, py::object progress) {
  Callback callback(std::move(progress));
  Columns columns;
  try {
    const py::gil_scoped_release others;
    columns = play(asked, callback);
  } catch (const std::exception& error) {
    callback.raise_again();
    std::rethrow_if_nested(error);  // what a policy's function raised
    throw;
  }
  callback.raise_again();
  return columns.arrays();
}

}  // namespace

void add_simulate(py::module_& module) {
  py::class_<Asked>(module, "Asked")
      .def(py::init<>())
      .def_readwrite("arms", &Asked::arms)
      .def_readwrite("arms_are_text", &Asked::arms_are_text)
      .def_readwrite("scenario", &Asked::scenario)
      .def_readwrite("world", &Asked::world)
      .def_readwrite("config", &Asked::config)
      .def_readwrite("settings", &Asked::settings)
      .def_readwrite("robots", &Asked::robots)
      .def_readwrite("matches", &Asked::matches)
      .def_readwrite("possessions", &Asked::possessions)
      .def_readwrite("calibrations", &Asked::calibrations)
      .def_readwrite("seed", &Asked::seed)
      .def_readwrite("jobs", &Asked::jobs)
      .def_readwrite("out", &Asked::out)
      .def_readwrite("shadows", &Asked::shadows)
      .def_readwrite("every_cycle", &Asked::every_cycle);
  module.def("simulate", simulate);
}

}  // namespace trivela::python
