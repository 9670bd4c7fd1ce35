#include "evaluator/sessions/kicker_learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/metrics/kicker_updates.sql.hpp"
#include "kicking/constants.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::int64_t kFewestFlights = 5;  // kicks by which one can say how good an estimate is
constexpr std::int64_t kLastFlights = 30;   // the first ones were held against spreads that it had yet to learn
constexpr double kResiduals = 4.0;          // of a flight
constexpr double kFarthestSquares = 2.0;    // times as far as it says, in squares
constexpr double kWrongSpeed = 0.05;        // by which a file is wrong enough to say so
constexpr double kSaysNothing = 0.5;

/// dz of a ball at the line that is faster by d ln V and steeper by d theta, both drag-free and of a robot at rest:
/// g T^2 d ln V + (D (1 + tan^2) - g T^2 tan) d theta.
double higher_m(const LearnedPart& speed_ln, const LearnedPart& elevation_rad, double distance_m, double t_flight_s,
                double flight_elevation_rad) {
  const double tangent = std::tan(flight_elevation_rad), fall_m = kicking::kGravity_mps2 * t_flight_s * t_flight_s;
  return fall_m * speed_ln.value + (distance_m * (1.0 + tangent * tangent) - fall_m * tangent) * elevation_rad.value;
}

KickerStep step_of(const log::NamedCells& row) {
  const auto part = [&](const char* value, const char* se) {
    return LearnedPart{row.get<double>(value), row.get<double>(se)};
  };
  KickerStep step{.kick_id = row.get<std::int64_t>("kick_id"),
                  .kicks = row.get<std::int64_t>("kicks"),
                  .speed_ln = part("speed_ln", "speed_ln_se"),
                  .elevation_rad = part("elevation_rad", "elevation_se_rad"),
                  .direction_rad = part("direction_rad", "direction_se_rad"),
                  .delay_s = part("delay_s", "delay_se_s"),
                  .along = part("along_ratio", "along_se_ratio"),
                  .sideways = part("sideways_ratio", "sideways_se_ratio"),
                  .p_mistaken = row.get<double>("p_mistaken"),
                  .chi_square = row.get<double>("chi_square"),
                  .higher_m = std::nullopt};
  const auto speed_before = row.find<double>("speed_ln_before"),
             angle_before = row.find<double>("elevation_rad_before"), distance_m = row.find<double>("distance_m"),
             t_flight_s = row.find<double>("t_flight_s"), flight_rad = row.find<double>("flight_elevation_rad");
  if (speed_before && angle_before && distance_m && t_flight_s && flight_rad)
    step.higher_m = higher_m({*speed_before, 0.0}, {*angle_before, 0.0}, *distance_m, *t_flight_s, *flight_rad);
  return step;
}

}  // namespace

std::string LearnedKicker::who() const {
  return log.empty() ? fmt::format("robot {}", robot_id) : fmt::format("robot {} ({})", robot_id, log);
}

std::int64_t LearnedKicker::mistaken() const {
  return std::ranges::count_if(steps, [](const KickerStep& step) { return step.p_mistaken > kSaysNothing; });
}

double LearnedKicker::mean_chi_square() const {
  double sum = 0.0;
  std::int64_t n = 0;
  for (auto step = steps.rbegin(); step != steps.rend() && n < kLastFlights; ++step) {
    if (step->kick_id == 0 || step->p_mistaken > kSaysNothing) continue;
    sum += step->chi_square;
    ++n;
  }
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

bool LearnedKicker::valid() const {
  return kicks() - mistaken() >= kFewestFlights && mean_chi_square() < kFarthestSquares * kResiduals &&
         2 * mistaken() < kicks();
}

std::optional<double> LearnedKicker::higher_m() const {
  double sum = 0.0;
  std::int64_t n = 0;
  for (const KickerStep& step : steps) {
    if (!step.higher_m) continue;
    sum += *step.higher_m;
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / static_cast<double>(n);
}

std::vector<std::string> LearnedKicker::sentences() const {
  std::vector<std::string> lines;
  const auto say = [&](const std::string& text) { lines.push_back(fmt::format("{}: {}", who(), text)); };
  if (const auto higher = higher_m()) {
    const std::string by = fmt::format("the aim by {:+.2f} m in height, on average", -*higher);
    say(used ? "decisions went by what its kicks show, which moved " + by
             : "decisions did not go by what its kicks show; self_calibration.mode = \"on\" would have moved " + by);
  }
  const LearnedPart& speed = steps.back().speed_ln;
  if (!used && valid() && std::abs(speed.value) > std::max(kWrongSpeed, 3.0 * speed.se))
    say(
        fmt::format("warning: the ball is {:.0f} % {} than its file says: trivela calibrate from-log, or "
                    "self_calibration.mode = \"on\"",
                    100.0 * std::abs(std::expm1(speed.value)), speed.value > 0.0 ? "faster" : "slower"));
  if (mistaken() > 0) say(fmt::format("{} of {} flights said nothing of the kicker", mistaken(), kicks()));
  if (kicks() - mistaken() < kFewestFlights) {
    const std::int64_t flights = kicks() - mistaken();
    say(fmt::format("{} to say whether this may be believed", flights == 1
                                                                  ? std::string{"1 flight is too few"}
                                                                  : fmt::format("{} flights are too few", flights)));
  } else if (valid()) {
    say(fmt::format(
        "its last flights lie as far from it as it says (mean chi-square {:.1f}, expected {:.0f}): it may be believed",
        mean_chi_square(), kResiduals));
  } else {
    say(
        fmt::format("its last flights lie farther from it than it says (mean chi-square {:.1f}, expected {:.0f}): do "
                    "not believe it; look at the goal camera and the labels",
                    mean_chi_square(), kResiduals));
  }
  return lines;
}

std::vector<LearnedKicker> learned_kickers_of(const log::Reader& reader) {
  std::vector<LearnedKicker> kickers;
  reader.query(kKickerUpdatesSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto robot_id = row.get<int>("robot_id");
    if (kickers.empty() || kickers.back().session_id != session_id || kickers.back().robot_id != robot_id)
      kickers.push_back(
          {.session_id = session_id, .robot_id = robot_id, .used = row.get<bool>("used"), .steps = {}, .log = {}});
    kickers.back().steps.push_back(step_of(row));
  });
  std::erase_if(kickers, [](const LearnedKicker& kicker) { return kicker.kicks() == 0; });
  return kickers;
}

}  // namespace trivela::evaluator
