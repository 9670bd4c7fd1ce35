#include "cli/lob_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "cli/kick/csv_rows.hpp"
#include "cli/options/number_checks.hpp"
#include "evaluator/render/lob_json.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::cli {
namespace {

using evaluator::Json;
using kicking::Estimate;
using kicking::nanoseconds;
using kicking::lob::ForegroundReturn;
using kicking::lob::LobRecord;

const double kDegrees = kicking::degrees(1.0);

/// Checks each row against those before it.
class ReturnRows {
 public:
  ForegroundReturn read(const Row& row) {
    const double scan = row.number_in("scan", 0.0, 1e15);
    if (scan != std::floor(scan)) throw CellError("scan", *row.word("scan"), "is not a whole number");
    const ForegroundReturn seen{
        static_cast<std::int64_t>(scan), nanoseconds(row.number_in("t_scan_start_s", -1e9, 1e9)),
        nanoseconds(row.number_in("t_beam_s", -1e9, 1e9)), kicking::radians(row.number_in("angle_deg", -360.0, 360.0)),
        row.length_m("range_m", 200.0)};
    const auto start = starts_.try_emplace(seen.scan, seen.scan_t_ns).first->second;
    if (start != seen.scan_t_ns) {
      throw CellError("t_scan_start_s", *row.word("t_scan_start_s"),
                      fmt::format("differs from an earlier row of scan {}: {} s", seen.scan, 1e-9 * start));
    }
    if (seen.beam_t_ns < seen.scan_t_ns)
      throw CellError("t_beam_s", *row.word("t_beam_s"), "is before the start of the scan");
    if (!beams_.insert({seen.scan, std::lround(1e6 * seen.elevation_rad)}).second)
      throw CellError("angle_deg", *row.word("angle_deg"), fmt::format("stands twice in scan {}", seen.scan));
    return seen;
  }

 private:
  std::map<std::int64_t, std::int64_t> starts_;
  std::set<std::pair<std::int64_t, long>> beams_;
};

/// What is wrong with the scans' instants as a whole; none: they follow each other at one pace. A scanner's clock may
/// start over, and whoever wrote the table may have lost or added time.
std::optional<std::string> wrong_stamps(const std::vector<ForegroundReturn>& returns) {
  std::map<std::int64_t, std::int64_t> starts;  // by scan
  for (const ForegroundReturn& seen : returns) starts.emplace(seen.scan, seen.scan_t_ns);
  std::vector<double> paces_s;
  const auto pace_s = [](const auto& before, const auto& after) {
    return kicking::seconds(after.second - before.second) / static_cast<double>(after.first - before.first);
  };
  for (auto before = starts.begin(), after = before; after != starts.end() && ++after != starts.end(); before = after)
    paces_s.push_back(pace_s(*before, *after));
  if (paces_s.size() < 3) return std::nullopt;
  std::ranges::nth_element(paces_s, paces_s.begin() + std::ssize(paces_s) / 2);
  const double usual_s = paces_s[paces_s.size() / 2];
  for (auto before = starts.begin(), after = std::next(before); after != starts.end(); before = after++) {
    const double passed_s = kicking::seconds(after->second - before->second);
    if (passed_s <= 0.0)
      return fmt::format(
          "time goes back by {:.6g} s from scan {} to {}: did the scanner's clock start over? Add to t_scan_start_s "
          "and t_beam_s from there on what it lost",
          -passed_s, before->first, after->first);
    if (std::abs(pace_s(*before, *after) - usual_s) > 0.5 * usual_s)
      return fmt::format(
          "{:.4g} s pass from scan {} to {}, where {:.3g} s pass from scan to scan: t_scan_start_s jumps, or scan does "
          "not count all scans",
          passed_s, before->first, after->first, usual_s);
  }
  for (const ForegroundReturn& seen : returns)
    if (kicking::seconds(seen.beam_t_ns - seen.scan_t_ns) > 1.5 * usual_s)
      return fmt::format("t_beam_s {:.6f} is {:.4g} s after the start of scan {}, and a scan takes {:.3g} s",
                         kicking::seconds(seen.beam_t_ns), kicking::seconds(seen.beam_t_ns - seen.scan_t_ns), seen.scan,
                         usual_s);
  return std::nullopt;
}

Json lob_json(const LobRecord& lob) {
  Json effective = evaluator::effective_json(lob, evaluator::EstimateForm::kBeside);
  Json true_values = evaluator::true_json(lob, evaluator::EstimateForm::kBeside);
  if (lob.effective) effective["residual_rms_m"] = lob.effective->residual_rms_m;
  if (const auto& fit = lob.true_values) {
    true_values["residual_rms_m"] = fit->residual_rms_m;
    true_values["misfit_chi_square"] = fit->misfit_chi_square;
    true_values["misfits"] = fit->misfits();
    true_values["lift_coefficient"] = fit->lift_coefficient;
  }
  Json json{{"effective", effective},
            {"true", true_values},
            {"residual_rms_m", lob.true_values ? Json(lob.true_values->residual_rms_m) : Json()},
            {"points", lob.centres.size()}};
  json.update(evaluator::verdict_json(lob));
  return json;
}

std::string line(const char* what, const Estimate& estimate, const char* unit, double scale = 1.0) {
  return fmt::format("  {:<12}{:8.3f} +- {:.3f} {}\n", what, estimate.value * scale, estimate.se * scale, unit);
}

std::string lob_text(const LobRecord& lob) {
  std::string text = fmt::format("{} centres of the ball: {}\n", lob.centres.size(),
                                 lob.refusal == kicking::lob::Refusal::kNone
                                     ? "a lob"
                                     : fmt::format("refused ({}): {}", kicking::lob::name(lob.refusal), lob.why));
  if (const auto& fit = lob.effective) {
    text += "effective, from height and distance, drag absorbed:\n";
    text += line("exit angle", fit->exit_angle_rad, "deg", kDegrees) + line("exit speed", fit->exit_speed_mps, "m/s") +
            line("height", fit->height_m, "m over the launch") + line("distance", fit->distance_m, "m");
  }
  if (const auto& fit = lob.true_values) {
    text += "true, from the times, with drag:\n";
    text += line("exit angle", fit->exit_angle_rad, "deg", kDegrees) + line("exit speed", fit->exit_speed_mps, "m/s") +
            line("Cd", fit->drag_coefficient, fit->drag_coefficient.se > 0.0 ? "" : "(given, not fitted)") +
            fmt::format("  residual    {:8.4f} m rms\n", fit->residual_rms_m) +
            fmt::format("  lack of fit {:8.1f} chi-square against a lift, at most {:.1f} by chance\n",
                        fit->misfit_chi_square, kicking::lob::kMisfit);
    if (fit->misfits()) {
      text += fmt::format(
          "  The flight has a lift that the fit lacks (about {:+.2f}, Cd's scale) and takes for angle: its standard\n"
          "  errors are widened by that. The effective values, which the policies use, hold lift as they hold drag.\n",
          fit->lift_coefficient);
    }
  }
  return text;
}

}  // namespace

void add_points_flags(CLI::App& verb, PointsFlags& flags) {
  verb.add_option("--points", flags.points,
                  "CSV of foreground returns: scan, t_scan_start_s, t_beam_s, angle_deg, range_m; angle 0 along the "
                  "kick, 90 upwards. Needs --laser-x-m and --laser-z-m")
      ->type_name("FILE");
  verb.add_flag("--json", flags.json, "with --points: JSON instead of text");
  add_default(verb, "--centre", flags.centre,
              "ball centre by a circle of known radius, or the paper's middle of the limits",
              CLI::IsMember({"circle", "middle"}));
  verb.add_option("--cd", flags.cd, "drag coefficient, instead of fitting it")->check(CLI::Range(0.0, 10.0));
}

std::optional<std::vector<ForegroundReturn>> read_returns(std::istream& in, const std::string& file,
                                                          std::ostream& err) {
  std::vector<ForegroundReturn> returns;
  ReturnRows rows;
  RowVerb verb;
  verb.inputs = {{"scan", ""}, {"t_scan_start_s", ""}, {"t_beam_s", ""}, {"angle_deg", ""}, {"range_m", ""}};
  verb.results = [](const auto&) { return std::vector<std::string>{}; };
  verb.compute = [&](const Row& row) {
    returns.push_back(rows.read(row));
    return std::vector<Value>{};
  };
  std::ostringstream copy;
  if (run_rows(verb, in, file, RowFormat::kCsv, copy, err) != kDone) return std::nullopt;
  if (const auto wrong = wrong_stamps(returns)) {
    err << fmt::format("{}: {}\n", file, *wrong);
    return std::nullopt;
  }
  return returns;
}

int run_lob_points(const PointsFlags& flags, const kicking::lob::ScannerPlace& place) {
  std::ifstream file = open_file(flags.points);
  const auto returns = read_returns(file, flags.points, std::cerr);
  if (!returns) return kFailed;
  kicking::lob::AnalyzerConfig config;
  if (flags.centre == "middle") config.centre = kicking::lob::CentreMethod::kMiddleOfLimits;
  config.drag_coefficient = flags.cd;
  const LobRecord lob = kicking::lob::analyse_returns(*returns, place, config);
  std::cout << (flags.json ? evaluator::json_text(lob_json(lob)) : lob_text(lob)) << std::flush;
  return lob.refusal == kicking::lob::Refusal::kNone ? kDone : kFailed;
}

}  // namespace trivela::cli
