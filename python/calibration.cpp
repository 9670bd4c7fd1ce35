#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "calibration/rows/lobs_of_scans.hpp"
#include "kicking/fit/table_fit.hpp"
#include "log/write/scan_log.hpp"
#include "python/arrays.hpp"
#include "python/columns.hpp"

namespace trivela::python {
namespace {

using kicking::Estimate;
using kicking::lob::LobRecord;

void add_lob(Columns& row, const LobRecord& lob) {
  const auto estimate = [&](const char* name, const char* se_name, const Estimate* value) {
    row.add(name, value != nullptr ? std::optional(value->value) : std::nullopt);
    row.add(se_name, value != nullptr ? std::optional(value->se) : std::nullopt);
  };
  row.begin_row();
  row.add("launch_t_ns", lob.launch_t_ns);
  row.add("power", lob.power);
  row.add("accepted", lob.refusal == kicking::lob::Refusal::kNone);
  row.add("refusal", kicking::lob::name(lob.refusal));
  row.add("why", lob.why);
  row.add("centres", lob.centres.size());
  const auto* const effective = lob.effective ? &*lob.effective : nullptr;
  estimate("exit_angle_rad", "exit_angle_se_rad", effective ? &effective->exit_angle_rad : nullptr);
  estimate("exit_speed_mps", "exit_speed_se_mps", effective ? &effective->exit_speed_mps : nullptr);
  estimate("height_m", "height_se_m", effective ? &effective->height_m : nullptr);
  estimate("distance_m", "distance_se_m", effective ? &effective->distance_m : nullptr);
  const auto* const fit = lob.true_values ? &*lob.true_values : nullptr;
  estimate("true_exit_angle_rad", "true_exit_angle_se_rad", fit ? &fit->exit_angle_rad : nullptr);
  estimate("true_exit_speed_mps", "true_exit_speed_se_mps", fit ? &fit->exit_speed_mps : nullptr);
  estimate("drag_coefficient", "drag_coefficient_se", fit ? &fit->drag_coefficient : nullptr);
}

py::dict lobs(const std::string& path) {
  Columns columns;
  {
    const py::gil_scoped_release others;
    const log::ScanReader scans(path);
    for (const LobRecord& lob : calibration::lobs_of_scans(scans)) add_lob(columns, lob);
  }
  return columns.arrays();
}

py::tuple fit_table(const Flat<double>& power, const Flat<double>& exit_speed_mps, const Flat<double>& exit_angle_rad,
                    bool isotonic) {
  const auto powers = span_of(power), speeds = span_of(exit_speed_mps), angles = span_of(exit_angle_rad);
  std::vector<kicking::Trial> trials;
  for (std::size_t i = 0; i < powers.size(); ++i) trials.push_back({powers[i], angles[i], speeds[i]});
  const kicking::TableFit fit = kicking::fit_table(trials, {.isotonic = isotonic});
  Columns row;
  for (const kicking::TrialMean& point : fit.set_points) {
    row.begin_row();
    row.add("power", point.power);
    row.add("trials", point.trials);
    row.add("exit_speed_mps", point.exit_speed_mps.mean);
    row.add("exit_speed_sd_mps", point.exit_speed_mps.sd);
    row.add("exit_angle_rad", point.exit_angle_rad.mean);
    row.add("exit_angle_sd_rad", point.exit_angle_rad.sd);
  }
  py::dict whole;
  whole["exit_angle_rad"] = fit.exit_angle_rad.value;
  whole["exit_angle_se_rad"] = fit.exit_angle_rad.se;
  whole["exit_speed_sd_mps"] = fit.exit_speed_sd_mps;
  whole["rises"] = fit.rises();
  whole["isotonic"] = fit.isotonic;
  whole["warnings"] = fit.warnings;
  return py::make_tuple(row.arrays(), whole);
}

}  // namespace

void add_calibration(py::module_& module) {
  module.def("lobs", lobs);
  module.def("fit_table", fit_table);
}

}  // namespace trivela::python
