#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <ostream>
#include <string>

namespace trivela::evaluator::imports {

/// A team's log as the box writes it, record by record.
class TeamLogWriting {
 public:
  explicit TeamLogWriting(std::ostream& out) : out_(out) {}

  void record(std::int64_t timestamp_ms, std::int64_t game_ms, const std::string& worldstate) {
    out_ << (records_++ == 0 ? "[\n" : ",\n");
    const std::string text = fmt::format(R"({{"teamName": "Water","timestamp": {},"gametimeMs": {},"worldstate": {}}})",
                                         timestamp_ms, game_ms, worldstate);
    out_ << text;
    bytes_ += static_cast<std::int64_t>(text.size()) + 2;
  }
  void close() { out_ << "]\n"; }

  std::int64_t records() const { return records_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  std::ostream& out_;
  std::int64_t records_ = 0, bytes_ = 0;
};

/// A robot by the league's schema at (x, y), 0.5 m/s forward.
inline std::string told_robot(int id, double x_m, double y_m, const std::string& engaged = "0",
                              const std::string& target = "targetPose", double battery = 80.0) {
  return fmt::format(
      R"({{"id":{},"pose":[{},{},0.25],"{}":[1.0,2.0,0.0],"velocity":[0.0,0.5,0.1],"intention":"attack","batteryLevel":{},"ballEngaged":{}}})",
      id, x_m, y_m, target, battery, engaged);
}

inline std::string told_ball(double x_m, double z_m = 0.11, double confidence = 0.9) {
  return fmt::format(R"({{"position":[{},1.5,{}],"velocity":[0.1,0.2,0.0],"confidence":{}}})", x_m, z_m, confidence);
}

inline std::string worldstate(const std::string& robots, const std::string& balls, const std::string& age = "40",
                              const std::string& obstacles = "") {
  return fmt::format(
      R"({{"type":"worldstate","ageMs":{},"teamName":"Water","intention":"win","robots":[{}],"balls":[{}],"obstacles":[{}]}})",
      age, robots, balls, obstacles);
}

/// How many records of a generated log have each of the faults that real clients made.
struct GeneratedFaults {
  std::int64_t records = 0, no_age = 0, five_balls = 0, null_positions = 0;
};

/// A log of at least `bytes` with the faults of Water and Tech United 2016, at 10 Hz with robot 2 having the ball for
/// 1 s of every 10; by the record's number alone.
inline GeneratedFaults write_faulty_log(std::ostream& out, std::int64_t bytes) {
  TeamLogWriting log(out);
  GeneratedFaults faults;
  for (std::int64_t n = 0; log.bytes() < bytes; ++n) {
    const std::int64_t moved = n % 5 < 2 ? 1 : 0, late = n % 9 == 8 ? 3 : 0;
    std::string robots, balls, obstacles;
    for (int id = 1; id <= 5; ++id) {
      const bool engaged = id == 2 && n % 100 < 11;
      if (id > 1) robots += ',';
      robots += told_robot(id, 0.001 * static_cast<double>((n * 37 + id * 911) % 6000), 0.25 * id,
                           n % 2 == 0 ? (engaged ? "1.0" : "0.0") : (engaged ? "1" : "0"),
                           n % 3 == 0 ? "target pose" : "targetPose", id == 4 ? 98.0 : 50.0 + 0.1 * (n % 100));
    }
    for (int i = 0; i < (n % 7 == 0 ? 5 : 1); ++i) {
      if (i > 0) balls += ',';
      balls += i == 4 ? R"({"position":null,"confidence":-100})" : told_ball(0.01 * static_cast<double>(n % 300), 0.0);
    }
    for (int i = 0; i < 6; ++i) {
      obstacles += fmt::format(R"({}{{"position":[{},2.5],"velocity":[0.0,0.0],"radius":0.25,"confidence":0.5}})",
                               i > 0 ? "," : "", 0.5 * i);
    }
    std::string state = worldstate(robots, balls, "40", obstacles);
    if (n % 11 == 0) state.replace(state.find("\"ageMs\":40,"), 11, "");
    log.record(1467554104000 + (n / 5 * 5 + (moved == 1 ? n % 5 : 1) - late) * 100, n * 100, state);
    faults.no_age += n % 11 == 0 ? 1 : 0;
    faults.five_balls += n % 7 == 0 ? 1 : 0;
    faults.null_positions += n % 7 == 0 ? 1 : 0;
  }
  log.close();
  faults.records = log.records();
  return faults;
}

}  // namespace trivela::evaluator::imports
