#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/calibrate/fit_flags.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::cli {
namespace {

double delay_s_of(const config::Row& row, bool differences) {
  if (!differences) return row.measured("delay_s", calibration::kLongestDelay_s, config::kSeconds);
  const double delay_s = row.number("release_t_s") - row.number("order_t_s");
  if (std::abs(delay_s) > calibration::kLongestDelay_s)
    throw config::CellError("release_t_s", *row.word("release_t_s"),
                            fmt::format("is {:g} s from order_t_s, more than {:g} s: times are in seconds", delay_s,
                                        calibration::kLongestDelay_s));
  return delay_s;
}

/// Order to release of the ball.
class Delay {
 public:
  using Flags = FitFlags;
  using Rows = calibration::DriveKicks<double>;
  using Robot = std::optional<config::Robot>;
  static constexpr const char* kName = "delay";
  static constexpr bool kNeedsRobot = false;

  static Rows rows(const calibration::RecordedDrives& drives, const Flags&, const Robot&) {
    return calibration::release_delays(drives);
  }

  static Rows rows(const calibration::NumberTable& table, const Flags&, const Robot&) {
    const bool differences = !table.has("delay_s");
    if (differences) {
      for (const char* column : {"order_t_s", "release_t_s"}) table.require_one_of({"delay_s", column});
      if (table.has("order_t_s") != table.has("release_t_s")) table.require_one_of({"delay_s"});
    }
    Rows delays;
    table.for_each([&](const config::Row& row) { delays.rows.push_back(delay_s_of(row, differences)); });
    return delays;
  }

  Delay(Rows delays, const Flags&, const Robot&) : delays_(std::move(delays)), fit_(kicking::fit_delay(delays_.rows)) {}

  Json to_json() const {
    return {{"kicks", delays_.rows.size() - fit_.rejected.size()},
            {"delay_s", fit_.mean_s.value},
            {"delay_se_s", fit_.mean_s.se},
            {"delay_sd_s", fit_.sd_s},
            {"median_s", fit_.median_s},
            {"mad_s", fit_.mad_s},
            {"rows", evaluator::rows_json(table())}};
  }

  std::string to_text() const {
    return evaluator::text_table(texts_of(table())) +
           fmt::format("\ndelay {} ms, from kick to kick {:.1f} ms; median {:.1f} ms, MAD {:.1f} ms\n",
                       text_of(fit_.mean_s, 1e3), 1e3 * fit_.sd_s, 1e3 * fit_.median_s, 1e3 * fit_.mad_s);
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> all = delays_.left_out;
    if (const auto early = std::ranges::count_if(delays_.rows, [](double delay_s) { return delay_s <= 0.0; });
        early > 0)
      all.push_back(fmt::format("the ball leaves before the order in {} of {} readings: do both times have one clock?",
                                early, delays_.rows.size()));
    if (!fit_.rejected.empty()) {
      all.push_back(fmt::format("{} of {} readings left out, farther from the median than 3.5 times 1.4826 MAD",
                                fit_.rejected.size(), delays_.rows.size()));
    }
    return all;
  }

  void set(calibration::RobotUpdate& update, const std::vector<std::string>& files) const {
    update.set_delay(fit_, files);
  }

 private:
  evaluator::Table table() const {
    evaluator::Table table{{{"delay_s", "delay [ms]", "{:.1f}", 1e3},
                            {"residual_s", "- mean [ms]", "{:+.1f}", 1e3},
                            {"rejected", "", ""},
                            {""}}};
    for (std::size_t i = 0; i < delays_.rows.size(); ++i) {
      const bool rejected = std::ranges::find(fit_.rejected, i) != fit_.rejected.end();
      table.rows.push_back({delays_.rows[i], fit_.residual_s[i], rejected, rejected ? "left out" : ""});
    }
    return table;
  }

  Rows delays_;
  kicking::DelayFit fit_;
};

}  // namespace

void add_calibrate_delay(CLI::App& calibrate, int& exit_code) {
  add_fit<Delay>(
      calibrate, exit_code, "from the order to the release of the ball", std::make_shared<FitFlags>(),
      "INPUT: a table with the columns order_t_s and release_t_s, or delay_s; or a match log, of which every kick of "
      "a\n"
      "robot that does not turn counts: the release is where the flight camera's two tracks of the ball meet.");
}

}  // namespace trivela::cli
