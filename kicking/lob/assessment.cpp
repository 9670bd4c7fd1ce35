#include "kicking/lob/assessment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "kicking/lob/fit/effective_fit.hpp"
#include "kicking/lob/fit/true_fit.hpp"

namespace trivela::kicking::lob {
namespace {

using Reason = std::pair<Refusal, std::string>;

template <typename... Values>
std::string sentence(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// Leaves out what is off the flight at the two ends. True: something was.
bool trim(std::vector<BallCentre>& centres, std::vector<double> residuals_m) {
  constexpr double kLeast_m = 0.02, kRobustSds = 4.0, kRayleighMedian = 1.1774;
  std::vector<double> sorted = residuals_m;
  const double limit_m = std::max(kLeast_m, kRobustSds * upper_median(std::span(sorted)) / kRayleighMedian);
  const auto belongs = [&](double residual_m) { return residual_m <= limit_m; };
  const auto first = std::find_if(residuals_m.begin(), residuals_m.end(), belongs);
  const auto last = std::find_if(residuals_m.rbegin(), residuals_m.rend(), belongs);
  const auto at_end = last - residuals_m.rbegin(), at_start = first - residuals_m.begin();
  centres.erase(centres.end() - at_end, centres.end());
  centres.erase(centres.begin(), centres.begin() + at_start);
  return at_start + at_end > 0;
}

std::optional<Reason> one_side(const std::vector<BallCentre>& centres, const std::optional<Parabola>& parabola) {
  const auto [low, high] =
      std::minmax_element(centres.begin(), centres.end(), [](const auto& a, const auto& b) { return a.x_m < b.x_m; });
  const double low_m = low->x_m, high_m = high->x_m;
  if (!parabola) {
    return Reason{
        Refusal::kOneSideOfApex,
        sentence("the ball was seen from x = %.2f m to %.2f m only, where its path has no apex", low_m, high_m)};
  }
  const auto before =
      std::count_if(centres.begin(), centres.end(), [&](const BallCentre& c) { return c.x_m < parabola->apex_x_m; });
  if (before >= 2 && std::ssize(centres) - before >= 2) return std::nullopt;
  return Reason{Refusal::kOneSideOfApex,
                sentence("the ball was seen from x = %.2f m to %.2f m only, on one side of the apex at x = %.2f m",
                         low_m, high_m, parabola->apex_x_m)};
}

/// The least of the means over the first, second and last third of the flight.
double worst_chord_ratio(std::span<const BallCentre> centres) {
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t third = 0; third < 3; ++third) {
    const std::size_t first = third * centres.size() / 3, end = (third + 1) * centres.size() / 3;
    double sum = 0.0;
    for (const BallCentre& centre : centres.subspan(first, end - first)) sum += centre.chord_ratio;
    worst = std::min(worst, sum / static_cast<double>(end - first));
  }
  return worst;
}

std::optional<Reason> bad_fit(const Parabola& parabola, const std::optional<FittedFlight>& flight,
                              const AnalyzerConfig& config) {
  if (!flight) return Reason{Refusal::kBadFit, "no flight with drag fits the centres"};
  const bool paper = config.centre == CentreMethod::kMiddleOfLimits;
  const double rms_m = paper ? parabola.values.residual_rms_m : flight->residual_rms_m;
  if (rms_m > config.largest_residual_m) {
    return Reason{Refusal::kBadFit,
                  sentence("the centres are %.3f m (rms) off the flight of a ball, at most %.3f m are allowed", rms_m,
                           config.largest_residual_m)};
  }
  if (std::abs(flight->launch_x_m()) > config.launch_tolerance_m) {
    return Reason{
        Refusal::kBadFit,
        sentence("the flight starts at x = %.2f m, more than %.2f m from the launch: a bounce, or the scanner's "
                 "place is wrong",
                 flight->launch_x_m(), config.launch_tolerance_m)};
  }
  return std::nullopt;
}

std::optional<Reason> reason_against(const std::vector<BallCentre>& centres, const std::optional<Parabola>& parabola,
                                     const std::optional<FittedFlight>& flight, const AnalyzerConfig& config) {
  if (std::ssize(centres) < config.least_points) {
    return Reason{Refusal::kTooFewPoints, sentence("%d centres of the ball, at least %d are needed",
                                                   static_cast<int>(centres.size()), config.least_points)};
  }
  if (auto reason = one_side(centres, parabola)) return reason;
  if (const double ratio = worst_chord_ratio(centres); ratio < config.least_chord_ratio) {
    return Reason{
        Refusal::kPlaneMisaligned,
        sentence("the ball covers %.2f of the angle that it should, at least %.2f are needed: it does not fly in "
                 "the scan plane",
                 ratio, config.least_chord_ratio)};
  }
  return bad_fit(*parabola, flight, config);
}

}  // namespace

LobRecord assess(Flight flight, const AnalyzerConfig& config) {
  LobRecord record;
  auto& centres = record.centres = std::move(flight.centres);
  auto fitted = fit_flight(centres, flight.launch_z_m, config);
  if (fitted && trim(centres, fitted->residuals_m)) fitted = fit_flight(centres, flight.launch_z_m, config);
  const auto parabola = fit_parabola(centres, flight.launch_z_m);
  if (parabola) record.effective = parabola->values;
  if (fitted) record.true_values = fitted->values();
  if (!centres.empty()) record.launch_t_ns = fitted ? record.true_values->launch_t_ns : centres.front().t_ns;
  if (auto reason = reason_against(centres, parabola, fitted, config)) {
    record.refusal = reason->first;
    record.why = std::move(reason->second);
  }
  return record;
}

}  // namespace trivela::kicking::lob
