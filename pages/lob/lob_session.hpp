#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/rows/lobs_of_scans.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::pages {

/// The powers to calibrate and the kicks of each; two in the paper (section 2.2). No powers: no plan.
struct CalibrationPlan {
  std::vector<double> powers;
  int trials = 2;
};

/// Powers from a list such as "15,20,...,50", where "..." goes on in the step of the two numbers before it. Throws
/// config::BadArgument naming what is wrong with it, and the list as `called`.
std::vector<double> parse_powers(const std::string& text, const std::string& called = "plan");

/// Accepted lobs of each power of the plan.
std::vector<int> kicks_done(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs);

/// The power to kick with next after an accepted kick with `power`: the same while it lacks kicks, else the next of the
/// plan that does, the first ones last. None: that kick was the plan's last, and what is kicked after it is no trial of
/// any power until somebody names one. A power that was named by hand when the plan was done, or in none, stays.
std::optional<double> next_power(const CalibrationPlan& plan, const std::vector<int>& done, double power);

/// The lobs of a session with their set-points and what humans said of them; everything shown is worked out again from
/// the three. One thread at a time.
class LobSession {
 public:
  explicit LobSession(CalibrationPlan plan, std::vector<log::TestedSetPoint> set_points = {},
                      std::vector<log::Verdict> verdicts = {});

  /// A flight that ended with the scan of this index.
  void add(kicking::lob::LobRecord lob, std::size_t end);
  void set_point(const log::TestedSetPoint& tested) { set_points_.push_back(tested); }

  /// A human's word on lob `number`, counted from 0; why may be empty. Throws std::out_of_range for one that is not
  /// there.
  log::Verdict judge(std::size_t number, bool accepted, const std::string& why);

  /// Lobs that had ended by the scan of index `position`.
  std::size_t count(std::size_t position) const;

  /// The first `count` lobs, with powers and verdicts.
  std::vector<kicking::lob::LobRecord> lobs(std::size_t count) const;

  /// {"lobs", "table", "plan"} of the first `count` lobs; times from `start_t_ns`.
  nlohmann::json to_json(std::size_t count, std::int64_t start_t_ns) const;

  /// power,height_m,distance_m of the accepted ones among the first `count` whose power is known.
  std::string table_csv(std::size_t count) const;

  /// The power that was tested at that instant; none: no set-point yet.
  std::optional<double> power_at(std::int64_t t_ns) const;

 private:
  struct Entry {
    kicking::lob::LobRecord lob;
    std::size_t end;
  };
  CalibrationPlan plan_;
  std::vector<log::TestedSetPoint> set_points_;
  std::vector<log::Verdict> verdicts_;
  std::vector<Entry> entries_;
};

}  // namespace trivela::pages
