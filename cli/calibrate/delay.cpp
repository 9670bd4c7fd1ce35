#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/calibrate/subcommands.hpp"
#include "evaluator/report/text_table.hpp"

namespace trivela::cli {
namespace {

using Delays = calibration::DriveKicks<double>;

Delays delays_of_numbers(const FitFlags& flags) {
  const calibration::NumberTable table = calibration::NumberTable::read(flags.input, flags.columns);
  const bool differences = !table.has("delay_s");
  if (differences) {
    for (const char* column : {"order_t_s", "release_t_s"}) table.require_one_of({"delay_s", column});
    if (table.has("order_t_s") != table.has("release_t_s")) table.require_one_of({"delay_s"});
  }
  Delays delays;
  table.for_each([&](const Row& row) {
    delays.rows.push_back(differences ? row.number("release_t_s") - row.number("order_t_s") : row.number("delay_s"));
  });
  return delays;
}

FitReport report_of(const Delays& delays, const kicking::DelayFit& fit) {
  FitReport report;
  report.json = {{"kicks", delays.rows.size() - fit.rejected.size()},
                 {"delay_s", fit.mean_s.value},
                 {"delay_se_s", fit.mean_s.se},
                 {"delay_sd_s", fit.sd_s},
                 {"median_s", fit.median_s},
                 {"mad_s", fit.mad_s},
                 {"rows", Json::array()}};
  std::vector<std::vector<std::string>> lines{{"delay [ms]", "- mean [ms]", ""}};
  for (std::size_t i = 0; i < delays.rows.size(); ++i) {
    const bool rejected = std::ranges::find(fit.rejected, i) != fit.rejected.end();
    report.json["rows"].push_back(
        {{"delay_s", delays.rows[i]}, {"residual_s", fit.residual_s[i]}, {"rejected", rejected}});
    lines.push_back({fmt::format("{:.1f}", 1e3 * delays.rows[i]), fmt::format("{:+.1f}", 1e3 * fit.residual_s[i]),
                     rejected ? "left out" : ""});
  }
  report.text = evaluator::text_table(lines) +
                fmt::format("\ndelay {} ms, from kick to kick {:.1f} ms; median {:.1f} ms, MAD {:.1f} ms\n",
                            text_of(fit.mean_s, 1e3), 1e3 * fit.sd_s, 1e3 * fit.median_s, 1e3 * fit.mad_s);
  report.warnings = delays.left_out;
  if (!fit.rejected.empty()) {
    report.warnings.push_back(
        fmt::format("{} of {} readings left out, farther from the median than 3.5 times 1.4826 MAD",
                    fit.rejected.size(), delays.rows.size()));
  }
  return report;
}

void calibrate_delay(const FitFlags& flags) {
  const auto robot = flags.robot.empty() && flags.out.empty() ? std::nullopt : robot_of(flags);
  const Delays delays =
      is_match_log(flags)
          ? calibration::release_delays(calibration::recorded_drives(evaluator::log::Reader(flags.input)))
          : delays_of_numbers(flags);
  const kicking::DelayFit fit = kicking::fit_delay(delays.rows);
  const std::string file = std::filesystem::path(flags.input).filename().string();
  finish_fit(flags, "trivela calibrate delay", robot, report_of(delays, fit),
             [&](calibration::RobotUpdate& update) { update.set_delay(fit, {file}); });
}

}  // namespace

void add_calibrate_delay(CLI::App& calibrate, int& exit_code) {
  auto* verb = calibrate.add_subcommand("delay", "from the order to the release of the ball");
  const auto flags = std::make_shared<FitFlags>();
  verb->footer(
      "INPUT: a table with the columns order_t_s and release_t_s, or delay_s; or a match log, of which every kick of "
      "a\n"
      "robot that does not turn counts: the release is where the flight camera's two tracks of the ball meet.");
  add_fit_flags(*verb, *flags);
  verb->callback([flags, &exit_code] {
    calibrate_delay(*flags);
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
