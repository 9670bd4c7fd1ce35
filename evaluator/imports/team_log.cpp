#include "evaluator/imports/team_log.hpp"

#include <cctype>
#include <nlohmann/json.hpp>

#include "evaluator/imports/worldstate_check.hpp"

namespace trivela::evaluator::imports {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kMostRecords = 1'000'000;  // an hour and more at 200 Hz
constexpr double kPause_ms = 2000.0;              // longer steps of the game time are pauses of the team, no rate

/// Follows one record through its objects and arrays.
class RecordEvents final : public nlohmann::json_sax<Json> {
 public:
  explicit RecordEvents(WorldstateCheck& check) : check_(check) {}

  void begin() { levels_.clear(); }

  bool null() override { return scalar({.kind = Scalar::Kind::kNull}); }
  bool boolean(bool value) override { return scalar({.kind = Scalar::Kind::kTruth, .number = value ? 1.0 : 0.0}); }
  bool number_integer(number_integer_t value) override { return whole(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return whole(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override {
    return scalar({.kind = Scalar::Kind::kReal, .number = value});
  }
  bool string(string_t& value) override { return scalar({.kind = Scalar::Kind::kText, .text = value}); }
  bool binary(binary_t&) override { return true; }

  bool key(string_t& name) override {
    key_.swap(name);
    if (levels_.back() == Level::kState) check_.state_key(key_);
    return true;
  }

  bool start_object(std::size_t) override {
    if (levels_.size() == kDeepest) return false;
    levels_.push_back(object_level());
    if (levels_.back() == Level::kRecord) check_.begin_record();
    if (levels_.back() == Level::kState) check_.begin_state();
    if (is_part(levels_.back())) check_.begin_part();
    return true;
  }

  bool end_object() override {
    const Level level = levels_.back();
    levels_.pop_back();
    if (level == Level::kRobot) check_.end_robot();
    if (level == Level::kBall) check_.end_ball();
    if (level == Level::kObstacle) check_.end_obstacle();
    if (level == Level::kRecord) check_.end_record();
    return true;
  }

  bool start_array(std::size_t) override {
    if (levels_.size() == kDeepest) return false;
    levels_.push_back(array_level());
    if (levels_.back() == Level::kNumbers) numbers_ = {};
    return true;
  }

  bool end_array() override {
    if (levels_.back() == Level::kNumbers) check_.part_numbers(key_, numbers_);
    levels_.pop_back();
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  static constexpr std::size_t kDeepest = 64;

  enum class Level { kRecord, kState, kRobots, kRobot, kBalls, kBall, kObstacles, kObstacle, kNumbers, kPassedOver };

  static bool is_part(Level level) {
    return level == Level::kRobot || level == Level::kBall || level == Level::kObstacle;
  }

  Level object_level() {
    if (levels_.empty()) return Level::kRecord;
    const Level parent = levels_.back();
    if (parent == Level::kRecord && key_ == "worldstate") return Level::kState;
    if (parent == Level::kRobots) return Level::kRobot;
    if (parent == Level::kBalls) return Level::kBall;
    if (parent == Level::kObstacles) return Level::kObstacle;
    return passed_over("{...}");
  }

  Level array_level() {
    const Level parent = levels_.empty() ? Level::kPassedOver : levels_.back();
    if (parent == Level::kState && key_ == "robots") return Level::kRobots;
    if (parent == Level::kState && key_ == "balls") return Level::kBalls;
    if (parent == Level::kState && key_ == "obstacles") return Level::kObstacles;
    const bool position = key_ == "velocity" || key_ == (parent == Level::kRobot ? "pose" : "position");
    const bool target = parent == Level::kRobot && (key_ == "targetPose" || key_ == "target pose");
    return is_part(parent) && (position || target) ? Level::kNumbers : passed_over("[...]");
  }

  /// An object or array where none is known.
  Level passed_over(const char* what) {
    if (!levels_.empty() && levels_.back() != Level::kPassedOver) check_.wrong_type(key_, what);
    return Level::kPassedOver;
  }

  bool whole(double value) { return scalar({.kind = Scalar::Kind::kWhole, .number = value}); }

  bool scalar(const Scalar& value) {
    const Level level = levels_.back();
    if (level == Level::kRecord) check_.record_value(key_, value);
    if (level == Level::kState) check_.state_value(key_, value);
    if (is_part(level)) check_.part_value(key_, value);
    if (level == Level::kNumbers) {
      numbers_.add(value.is_number() ? std::optional(value.number) : std::nullopt);
      if (!value.is_number() && value.kind != Scalar::Kind::kNull) check_.wrong_type(key_, value.shown());
    }
    if (level == Level::kRobots || level == Level::kBalls || level == Level::kObstacles)
      check_.wrong_type(key_, value.shown());
    return true;
  }

  WorldstateCheck& check_;
  std::vector<Level> levels_;
  std::string key_;
  Numbers numbers_;
};

/// Passes over what stands between records: blanks, commas and brackets. False: nothing follows.
bool to_next_record(std::istream& in, bool& open, TeamLog& log) {
  for (int c = in.peek(); c != EOF; c = in.peek()) {
    if (c == '{') return true;
    if (c == '[' || c == ']') open = c == '[';
    if (c != '[' && c != ']' && c != ',' && !std::isspace(c)) {
      std::string line;
      std::getline(in, line);
      log.faults.note("not JSON", log.records + 1, "line", line);
      continue;
    }
    in.get();
  }
  return false;
}

/// After a broken record: to the next line that begins an object.
void to_next_line(std::istream& in) {
  for (std::string line; in.peek() != '{' && std::getline(in, line);) continue;
}

}  // namespace

std::optional<double> record_rate_hz(const TeamLog& log) {
  double sum_ms = 0.0;
  std::int64_t steps = 0;
  std::optional<double> last_ms;
  for (const TeamRecord& record : log.usable) {
    if (!record.game_ms) continue;
    const double step_ms = *record.game_ms - last_ms.value_or(*record.game_ms);
    const bool counts = last_ms && step_ms >= 0.0 && step_ms <= kPause_ms;
    sum_ms += counts ? step_ms : 0.0;
    steps += counts ? 1 : 0;
    last_ms = record.game_ms;
  }
  return sum_ms > 0.0 ? std::optional(1000.0 * static_cast<double>(steps) / sum_ms) : std::nullopt;
}

TeamLog read_team_log(std::istream& in, const std::string& file) {
  TeamLog log{.file = file, .team = {}, .usable = {}, .faults = {file, "record"}};
  WorldstateCheck check(log);
  RecordEvents events(check);
  bool open = false;
  while (to_next_record(in, open, log)) {
    if (log.records == kMostRecords) {
      log.faults.note("more records than a match has", log.records + 1, "records", kMostRecords);
      break;
    }
    events.begin();
    const std::int64_t before = log.records;
    if (Json::sax_parse(in, &events, Json::input_format_t::json, false)) continue;
    if (log.records == before) ++log.records;
    log.faults.note(in.peek() == EOF ? "breaks off within a record" : "record is not JSON", log.records);
    to_next_line(in);
  }
  if (log.records == 0 && log.faults.all().empty()) log.faults.note("no record in it", 0);
  if (open) log.faults.note("array not closed", 0);
  check.finish();
  return log;
}

}  // namespace trivela::evaluator::imports
