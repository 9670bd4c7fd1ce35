#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "evaluator/imports/team_log.hpp"

#include <fmt/format.h>

namespace trivela::evaluator::imports {

/// A value of a worldstate that is neither object nor array.
struct Scalar {
  enum class Kind { kNull, kTruth, kWhole, kReal, kText };
  Kind kind = Kind::kNull;
  double number = 0.0;      ///< of a truth 0 or 1
  std::string_view text{};  ///< valid while it is handled

  bool is_number() const { return kind == Kind::kWhole || kind == Kind::kReal; }
  std::string shown() const {
    return kind == Kind::kNull    ? "null"
           : kind == Kind::kText  ? std::string(text)
           : kind == Kind::kTruth ? (number != 0.0 ? "true" : "false")
           : kind == Kind::kReal  ? fmt::format("{:#}", number)
                                  : fmt::format("{:.0f}", number);
  }
};

/// An array of numbers such as a pose: the first three, an empty one where there was none.
struct Numbers {
  std::array<std::optional<double>, 3> at{};
  std::size_t size = 0;  ///< as it was sent

  void add(std::optional<double> number) {
    if (size < at.size()) at[size] = number;
    ++size;
  }
  bool has(std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i)
      if (!at[i]) return false;
    return true;
  }
};

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
