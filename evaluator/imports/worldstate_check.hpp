#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "evaluator/imports/team_log.hpp"
#include "evaluator/imports/told_values.hpp"

namespace trivela::evaluator::imports {

/// Takes a worldstate apart key by key: what the league's schema asks for is checked and counted, what can be used
/// becomes a TeamRecord.
class WorldstateCheck {
 public:
  explicit WorldstateCheck(TeamLog& log) : log_(log) {}

  void begin_record();
  void record_value(const std::string& key, const Scalar& value);
  void begin_state() { has_state_ = true; }
  void state_key(const std::string& key);  ///< of whatever value
  void state_value(const std::string& key, const Scalar& value);
  void begin_part() { part_ = {}; }  ///< a robot, ball or obstacle
  void part_value(const std::string& key, const Scalar& value);
  void part_numbers(const std::string& key, const Numbers& numbers);
  void end_robot();
  void end_ball();
  void end_obstacle();
  void end_record();
  void wrong_type(const std::string& key, std::string_view value);
  void unknown_key(const std::string& key);

  /// Afterwards: what only the whole file shows.
  void finish();

 private:
  /// What was said of the robot, ball or obstacle at hand.
  struct Part {
    std::optional<double> id, engaged, battery, confidence;
    std::optional<Numbers> position, velocity;
    bool position_null = false, target = false, intention = false, radius = false;
  };
  struct Batteries {
    double first = 0.0;
    std::int64_t samples = 0;
    bool constant = true;
  };

  template <class T>
  void fault(std::string_view name, std::string_view key, const T& value) {
    log_.faults.note(name, log_.records, key, value);
  }
  void missing(std::string_view key) { fault(std::string(key) + " missing", "", ""); }
  void check_stamp(double timestamp_ms);
  void check_age(const Scalar& value);
  void engaged_value(const std::string& key, const Scalar& value);
  void check_confidence();
  bool position_usable(std::string_view whose, std::size_t n);
  std::optional<Numbers> usable_velocity(std::string_view whose, std::size_t n);
  void check_battery(int id);

  TeamLog& log_;
  TeamRecord record_{};
  Part part_{};
  bool has_state_ = false;
  std::set<std::string, std::less<>> state_keys_;
  std::int64_t balls_ = 0;
  double best_confidence_ = 0.0;
  std::optional<double> last_timestamp_ms_;
  std::map<int, Batteries> batteries_;
};

}  // namespace trivela::evaluator::imports
