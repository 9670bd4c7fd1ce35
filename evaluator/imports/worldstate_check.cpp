#include "evaluator/imports/worldstate_check.hpp"

#include <cmath>
#include <utility>

namespace trivela::evaluator::imports {
namespace {

constexpr double kFarthest_m = 50.0, kFastest_mps = 50.0;   // beyond: other units, or no measurement
constexpr double kLatestReported_ms = 4'102'444'800'000.0;  // 2100, UTC
constexpr double kOldest_ms = 10'000.0;                     // an age beyond it is time since something else
constexpr std::int64_t kManyBatteries = 100;                // a voltage that is measured moves within so many

bool within(const Numbers& numbers, std::size_t n, double most) {
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(*numbers.at[i]) > most) return false;
  return true;
}

std::string shown(const Numbers& numbers) {
  std::string text;
  for (const auto& number : numbers.at) text += number ? fmt::format("{}, ", *number) : "null, ";
  return fmt::format("{}... ({} numbers)", text, numbers.size);
}

}  // namespace

void WorldstateCheck::begin_record() {
  ++log_.records;
  record_ = {.number = log_.records};
  has_state_ = false;
  state_keys_.clear();
  balls_ = 0;
  best_confidence_ = 0.0;
}

void WorldstateCheck::record_value(const std::string& key, const Scalar& value) {
  if (key == "teamName") {
    if (log_.team.empty()) log_.team = value.text;
  } else if (key == "timestamp" || key == "gametimeMs") {
    if (!value.is_number()) return wrong_type(key, value.shown());
    if (value.number < 0.0 || value.number > kLatestReported_ms)
      return fault("time beyond all matches", key, value.shown());
    (key == "gametimeMs" ? record_.game_ms : record_.timestamp_ms) = value.number;
  } else if (key == "worldstate") {
    wrong_type(key, value.shown());
  } else {
    unknown_key(key);
  }
}

void WorldstateCheck::check_stamp(double timestamp_ms) {
  if (last_timestamp_ms_ && timestamp_ms == *last_timestamp_ms_) fault("repeated stamp", "timestamp", timestamp_ms);
  if (last_timestamp_ms_ && timestamp_ms < *last_timestamp_ms_) fault("record out of order", "timestamp", timestamp_ms);
  last_timestamp_ms_ = timestamp_ms;
}

void WorldstateCheck::state_key(const std::string& key) { state_keys_.insert(key); }

void WorldstateCheck::state_value(const std::string& key, const Scalar& value) {
  if (key == "ageMs") return check_age(value);
  if (key == "type") {
    if (value.text != "worldstate") fault("type is not worldstate", key, value.shown());
  } else if (key == "robots" || key == "balls" || key == "obstacles") {
    wrong_type(key, value.shown());
  } else if (key != "teamName" && key != "intention") {
    unknown_key(key);
  }
}

void WorldstateCheck::check_age(const Scalar& value) {
  if (!value.is_number()) return wrong_type("ageMs", value.shown());
  if (value.kind == Scalar::Kind::kReal) fault("ageMs not whole", "ageMs", value.shown());
  if (value.number < 0.0) fault("ageMs negative", "ageMs", value.shown());
  if (value.number > kOldest_ms) fault("ageMs above 10 s", "ageMs", value.shown());
}

void WorldstateCheck::part_value(const std::string& key, const Scalar& value) {
  const std::optional<double> number = value.is_number() ? std::optional(value.number) : std::nullopt;
  if (key == "ballEngaged") return engaged_value(key, value);
  if (key == "pose" || key == "position") {
    part_.position_null = true;
    fault("null position", key, value.shown());
  } else if (key == "intention") {
    part_.intention = true;
  } else if (key == "targetPose" || key == "target pose") {
    part_.target = true;
    if (key == "target pose") fault("key \"target pose\"", key, value.shown());
  } else if (key == "velocity") {
    fault("velocity null", key, value.shown());
    part_.velocity = Numbers{};
  } else if (key == "id" || key == "batteryLevel" || key == "confidence" || key == "radius") {
    if (!number) return wrong_type(key, value.shown());
    if (key == "id") part_.id = number;
    if (key == "batteryLevel") part_.battery = number;
    if (key == "confidence") part_.confidence = number;
    part_.radius = part_.radius || key == "radius";
  } else {
    unknown_key(key);
  }
}

void WorldstateCheck::engaged_value(const std::string& key, const Scalar& value) {
  if (value.kind == Scalar::Kind::kNull || value.kind == Scalar::Kind::kText) return wrong_type(key, value.shown());
  part_.engaged = value.number;
  if (value.kind != Scalar::Kind::kWhole || (value.number != 0.0 && value.number != 1.0))
    fault("ballEngaged neither 0 nor 1", key, value.shown());
}

void WorldstateCheck::part_numbers(const std::string& key, const Numbers& numbers) {
  if (key == "velocity") {
    part_.velocity = numbers;
  } else if (key == "pose" || key == "position") {
    part_.position = numbers;
  } else {
    part_.target = true;
    if (key == "target pose") fault("key \"target pose\"", "", "");
  }
}

bool WorldstateCheck::position_usable(std::string_view whose, std::size_t n) {
  const auto not_usable = [&](const std::string& name, std::string_view key, const std::string& value) {
    fault(name, key, value);
    return false;
  };
  if (part_.position_null) return false;  // counted when it was read
  if (!part_.position) return not_usable(fmt::format("{} without position", whose), "", "");
  const Numbers& position = *part_.position;
  if (position.size > position.at.size())
    return not_usable(fmt::format("{} with too long a position", whose), whose, shown(position));
  if (position.size < n) return not_usable(fmt::format("{} with too short a position", whose), whose, "");
  if (!position.has(n)) return not_usable("null position", whose, "");
  return within(position, 2, kFarthest_m) ||
         not_usable("position beyond 50 m", whose, fmt::format("{}, {}", *position.at[0], *position.at[1]));
}

std::optional<Numbers> WorldstateCheck::usable_velocity(std::string_view whose, std::size_t n) {
  const auto& velocity = part_.velocity;
  if (!velocity) {
    fault(fmt::format("{} without velocity", whose), "", "");
  } else if (velocity->size > velocity->at.size()) {
    fault(fmt::format("{} with too long a velocity", whose), whose, shown(*velocity));
  } else if (!velocity->has(n)) {
    if (velocity->size > 0) fault("velocity null", whose, "");
  } else if (!within(*velocity, n, kFastest_mps)) {
    fault("velocity beyond 50 m/s", whose, *velocity->at[0]);
  } else {
    return velocity;
  }
  return std::nullopt;
}

void WorldstateCheck::check_battery(int id) {
  if (!part_.battery) return missing("batteryLevel");
  const double level = *part_.battery;
  if (level < 0.0 || level > 100.0) fault("batteryLevel outside 0..100", "batteryLevel", level);
  const auto [battery, first] = batteries_.try_emplace(id, Batteries{.first = level});
  ++battery->second.samples;
  battery->second.constant = battery->second.constant && battery->second.first == level;
}

void WorldstateCheck::end_robot() {
  if (!part_.target) missing("targetPose");
  if (!part_.intention) missing("intention of a robot");
  const bool placed = position_usable("robot", 3);
  const auto velocity = usable_velocity("robot", 3);
  if (!part_.id || *part_.id != std::floor(*part_.id) || *part_.id < 0.0 || *part_.id > 255.0)
    return fault("robot without an id from 0 to 255", "id", part_.id.value_or(-1.0));
  const int id = static_cast<int>(*part_.id);
  check_battery(id);
  if (!part_.engaged) missing("ballEngaged");
  if (!placed) return;
  ReportedRobot robot{.id = id, .ball_engaged = part_.engaged.value_or(0.0) >= 0.5};
  robot.x_m = *part_.position->at[0];
  robot.y_m = *part_.position->at[1];
  robot.heading_rad = std::remainder(*part_.position->at[2], 2.0 * M_PI);
  if (velocity) robot.velocity = {*velocity->at[0], *velocity->at[1], *velocity->at[2]};
  for (const ReportedRobot& other : record_.robots) {
    if (other.id == id) return fault("robot twice in a record", "id", id);
  }
  record_.robots.push_back(robot);
}

void WorldstateCheck::check_confidence() {
  if (!part_.confidence) return missing("confidence");
  if (*part_.confidence < 0.0 || *part_.confidence > 1.0)
    fault("confidence outside 0..1", "confidence", *part_.confidence);
}

void WorldstateCheck::end_ball() {
  ++balls_;
  check_confidence();
  const bool placed = position_usable("ball", 2);
  const auto velocity = usable_velocity("ball", 2);
  if (!placed) return;
  if (part_.position->size < 3 || !part_.position->at[2]) {
    fault("ball without height", "position", "");
  } else if (*part_.position->at[2] == 0.0) {
    fault("ball at height 0", "position", *part_.position->at[2]);
  }
  const double confidence = part_.confidence.value_or(0.0);
  if (record_.ball && confidence <= best_confidence_) return;
  best_confidence_ = confidence;
  record_.ball = {.x_m = *part_.position->at[0], .y_m = *part_.position->at[1]};
  if (velocity) record_.ball->velocity = {*velocity->at[0], *velocity->at[1]};
}

void WorldstateCheck::end_obstacle() {
  check_confidence();
  if (!part_.radius) missing("radius");
  position_usable("obstacle", 2);
  usable_velocity("obstacle", 2);
}

void WorldstateCheck::end_record() {
  if (!record_.game_ms) missing("gametimeMs");
  if (record_.timestamp_ms) {
    check_stamp(*record_.timestamp_ms);
  } else {
    missing("timestamp");
  }
  if (!has_state_) return missing("worldstate");
  for (const char* const key : {"type", "ageMs", "teamName", "intention", "robots", "balls", "obstacles"}) {
    if (!state_keys_.contains(key)) missing(key);
  }
  if (balls_ > 1) fault("more than one ball", "balls", balls_);
  log_.usable.push_back(std::move(record_));
}

void WorldstateCheck::wrong_type(const std::string& key, std::string_view value) {
  fault("value of another type", key, value);
}

void WorldstateCheck::unknown_key(const std::string& key) { fault("unknown key", key, ""); }

void WorldstateCheck::finish() {
  for (const auto& [id, battery] : batteries_) {
    if (battery.constant && battery.samples >= kManyBatteries)
      log_.faults.note("battery constant", 0, fmt::format("batteryLevel of robot {}", id), battery.first);
  }
  const auto rate_hz = record_rate_hz(log_);
  if (rate_hz && *rate_hz < kSlowRate_hz)
    log_.faults.note("rate below 10 Hz", 0, "records a second", fmt::format("{:.1f}", *rate_hz));
}

}  // namespace trivela::evaluator::imports
