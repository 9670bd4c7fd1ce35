#include "calibration/rows/trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "calibration/rows/lobs_of_scans.hpp"
#include "calibration/rows/number_table.hpp"
#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::calibration {
namespace {

using config::BadArgument;
using config::Row;
using kicking::TableKind;

// No kicker of the league comes near them.
constexpr double kHighest_m = 15.0;
constexpr double kFarthest_m = 40.0;
constexpr double kFastest_mps = 40.0;  // what a robot's file may hold

const char* counted(std::size_t n) { return n == 1 ? "lob" : "lobs"; }

/// Trials of heights and distances. Those are of the parabola, whatever the drag.
void add_parabolas(const NumberTable& table, const std::string& file, const TrialFlags& flags, Trials& trials) {
  if (flags.kind == TableKind::kTrue) {
    throw BadArgument(
        fmt::format("{} true: {} has heights and distances, which give effective values", flags.kind_called, file));
  }
  if (flags.exit_angle_rad) {
    throw BadArgument(fmt::format("{}: {} has heights and distances, which give the angle", flags.angle_called, file));
  }
  table.require_one_of({"distance_m"});
  table.for_each([&](const config::Row& row) {
    const double power = row.positive("power");
    const double height_m = row.length_m("height_m", kHighest_m);
    trials.trials.push_back(kicking::trial_of_lob(power, height_m, row.length_m("distance_m", kFarthest_m)));
  });
}

double speed_mps(const config::Row& row) {
  const double value = row.positive("exit_speed_mps");
  if (value <= kFastest_mps) return value;
  throw config::CellError("exit_speed_mps", *row.word("exit_speed_mps"), fmt::format("is above {} m/s", kFastest_mps));
}

void add_speeds(const NumberTable& table, const std::string& file, const TrialFlags& flags, Trials& trials) {
  const bool with_angle = table.has("exit_angle_deg");
  if (with_angle && flags.exit_angle_rad) {
    throw BadArgument(fmt::format("{}: {} has a column exit_angle_deg", flags.angle_called, file));
  }
  if (!with_angle && !flags.exit_angle_rad) {
    throw BadArgument(fmt::format("{} has exit speeds and no column exit_angle_deg; give one angle with {}", file,
                                  flags.angle_called));
  }
  table.for_each([&](const config::Row& row) {
    trials.trials.push_back({row.positive("power"),
                             with_angle ? row.acute_angle_rad("exit_angle_deg") : *flags.exit_angle_rad,
                             speed_mps(row)});
  });
}

Trials trials_of_numbers(const std::string& file, const TrialFlags& flags) {
  const NumberTable table = NumberTable::read(file, flags.columns, flags.columns_called);
  table.require_one_of({"power"});
  table.require_one_of({"height_m", "exit_speed_mps"});
  Trials trials;
  if (table.has("height_m")) {
    add_parabolas(table, file, flags, trials);
  } else {
    add_speeds(table, file, flags, trials);
  }
  return trials;
}

Trials trials_of_scans(const std::string& file, const TrialFlags& flags) {
  if (flags.exit_angle_rad)
    throw BadArgument(fmt::format("{}: the lobs of {} give the angle", flags.angle_called, file));
  const log::ScanReader scans(file);
  Trials trials = trials_of_lobs(lobs_of_scans(scans, {}, verdicts_beside(file)), flags.kind, file);
  trials.simulated = scans.session().simulated;
  return trials;
}

}  // namespace

Trials trials_of_lobs(const std::vector<kicking::lob::LobRecord>& lobs, TableKind kind, const std::string& file) {
  Trials trials;
  std::map<std::string, std::size_t> left_out;
  for (const kicking::lob::LobRecord& lob : lobs) {
    if (lob.refusal != kicking::lob::Refusal::kNone) {
      ++left_out[name(lob.refusal)];
    } else if (!lob.power) {
      ++left_out["no set-point known"];
    } else if (kind == TableKind::kEffective && lob.effective) {
      trials.trials.push_back({*lob.power, lob.effective->exit_angle_rad.value, lob.effective->exit_speed_mps.value});
    } else if (kind == TableKind::kTrue && lob.true_values) {
      trials.trials.push_back(
          {*lob.power, lob.true_values->exit_angle_rad.value, lob.true_values->exit_speed_mps.value});
    } else {
      ++left_out[kind == TableKind::kTrue ? "no true fit" : "no effective fit"];
    }
  }
  for (const auto& [why, n] : left_out) {
    trials.warnings.push_back(fmt::format("{}: {} {} left out: {}", file, n, counted(n), why));
  }
  return trials;
}

Trials read_trials(const std::vector<std::string>& files, const TrialFlags& flags) {
  Trials all;
  for (const std::string& file : files) {
    const InputKind kind = input_kind(file);
    if (kind == InputKind::kMatchLog) {
      throw std::runtime_error(file + " is a match log; a table needs a scan record or a table of numbers");
    }
    Trials trials = kind == InputKind::kScanRecord ? trials_of_scans(file, flags) : trials_of_numbers(file, flags);
    std::ranges::move(trials.trials, std::back_inserter(all.trials));
    std::ranges::move(trials.warnings, std::back_inserter(all.warnings));
    all.simulated = all.simulated || trials.simulated;
  }
  if (all.trials.empty()) {
    throw std::runtime_error(fmt::format("no lob in {} can be used{}{}", fmt::join(files, ", "),
                                         all.warnings.empty() ? "" : ": ", fmt::join(all.warnings, "; ")));
  }
  return all;
}

InputKind input_kind(const std::string& file) {
  if (file == "-") return InputKind::kNumbers;
  std::ifstream in = config::open_file(file);
  const std::string magic = "SQLite format 3";
  std::string start(magic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != magic) return InputKind::kNumbers;
  return log::is_scan_log(file) ? InputKind::kScanRecord : InputKind::kMatchLog;
}

}  // namespace trivela::calibration
