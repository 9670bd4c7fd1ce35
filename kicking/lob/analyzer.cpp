#include "kicking/lob/analyzer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

#include "kicking/geometry/time.hpp"
#include "kicking/lob/assessment.hpp"
#include "kicking/lob/background.hpp"
#include "kicking/lob/candidates.hpp"
#include "kicking/lob/tracker.hpp"

namespace trivela::kicking::lob {
namespace {

void check(const ScanGeometry& g) {
  if (g.beams > 0 && g.step_rad > 0.0 && g.beam_period_s > 0.0 && g.scan_period_s > 0.0) return;
  throw std::invalid_argument("lob analyzer: beams = " + std::to_string(g.beams) + ", step_rad = " +
                              std::to_string(g.step_rad) + ", beam_period_s = " + std::to_string(g.beam_period_s) +
                              " and scan_period_s = " + std::to_string(g.scan_period_s) + " must be positive");
}

/// A beam's direction, and when it is measured in a scan; range 0.
std::vector<BeamReturn> beams_of(const ScanGeometry& geometry, const LaserMount& mount) {
  std::vector<BeamReturn> beams;
  for (std::size_t i = 0; i < geometry.beams; ++i) {
    const auto beam = static_cast<double>(i);
    const double angle = geometry.first_angle_rad + beam * geometry.step_rad;
    const double elevation = mount.front_elevation_rad + (mount.mirrored ? -angle : angle);
    beams.push_back({static_cast<int>(i), nanoseconds(beam * geometry.beam_period_s), 0.0, std::cos(elevation),
                     std::sin(elevation)});
  }
  return beams;
}

}  // namespace

struct Analyzer::State {
  State(const ScanGeometry& geometry, const LaserMount& mount, const AnalyzerConfig& analyzer_config)
      : config(analyzer_config),
        beams(beams_of(geometry, mount)),
        background(geometry, config),
        candidates(mount, geometry.step_rad, config),
        tracker(config, geometry.scan_period_s) {
    returns.reserve(beams.size());
    view.foreground.resize(beams.size());
    view.ball.resize(beams.size());
  }

  void find_foreground(const Scan& scan) {
    returns.clear();
    for (std::size_t i = 0; i < beams.size(); ++i) {
      const bool foreground = background.is_foreground(i, scan.range_mm[i]);
      view.foreground[i] = foreground ? 1 : 0;
      if (!foreground) continue;
      BeamReturn& seen = returns.emplace_back(beams[i]);
      seen.t_ns += scan.t_ns;
      seen.range_m = scan.range_mm[i] / 1000.0;
    }
  }

  /// The ball of the flight under way, else what looks most like a ball.
  void show_ball() {
    const auto& centres = candidates.centres();
    const auto like_ball = [](const BallCentre& centre) { return std::abs(centre.chord_ratio - 1.0); };
    auto ball = tracker.ball();
    if (!ball && !tracker.under_way() && !centres.empty()) {
      ball = static_cast<std::size_t>(
          std::min_element(centres.begin(), centres.end(),
                           [&](const auto& a, const auto& b) { return like_ball(a) < like_ball(b); }) -
          centres.begin());
    }
    view.track = tracker.under_way();
    view.centre.reset();
    std::fill(view.ball.begin(), view.ball.end(), 0);
    if (!ball) return;
    view.centre = centres[*ball];
    const Cluster& cluster = candidates.cluster(*ball);
    for (std::size_t i = cluster.first; i <= cluster.last; ++i)
      view.ball[static_cast<std::size_t>(returns[i].beam)] = 1;
  }

  AnalyzerConfig config;
  std::vector<BeamReturn> beams;
  Background background;
  std::vector<BeamReturn> returns;
  Candidates candidates;
  Tracker tracker;
  ScanView view;
};

Analyzer::Analyzer(const ScanGeometry& geometry, const LaserMount& mount, const AnalyzerConfig& config) {
  check(geometry);
  state_ = std::make_unique<State>(geometry, mount, config);
}

Analyzer::~Analyzer() = default;
Analyzer::Analyzer(Analyzer&&) noexcept = default;
Analyzer& Analyzer::operator=(Analyzer&&) noexcept = default;

std::optional<LobRecord> Analyzer::add(const Scan& scan) {
  State& s = *state_;
  if (scan.range_mm.size() != s.beams.size()) {
    throw std::invalid_argument("lob analyzer: a scan of " + std::to_string(scan.range_mm.size()) + " beams, not " +
                                std::to_string(s.beams.size()));
  }
  s.view.t_ns = scan.t_ns;
  if (!s.background.known()) {
    s.view.background_known = s.background.learn(scan);
    return std::nullopt;
  }
  s.find_foreground(scan);
  s.candidates.find(s.returns);
  auto flight = s.tracker.add(scan.t_ns, s.candidates.centres());
  s.show_ball();
  if (!flight) return std::nullopt;
  return assess(std::move(*flight), s.config);
}

std::optional<LobRecord> Analyzer::finish() {
  auto flight = state_->tracker.finish();
  state_->view.track = nullptr;
  if (!flight) return std::nullopt;
  return assess(std::move(*flight), state_->config);
}

const ScanView& Analyzer::view() const { return state_->view; }

const std::vector<double>& Analyzer::background_m() const { return state_->background.range_m(); }

void Analyzer::forget_background() {
  State& s = *state_;
  s.background.forget();
  s.tracker.finish();
  s.view = ScanView{};
  s.view.foreground.resize(s.beams.size());
  s.view.ball.resize(s.beams.size());
}

namespace {

using Scans = std::vector<std::span<const ForegroundReturn>>;

/// `returns` in the order of scans and beams, parted into scans.
Scans part(std::span<const ForegroundReturn> returns) {
  Scans scans;
  for (std::size_t first = 0, i = 1; i <= returns.size(); ++i) {
    if (i < returns.size() && returns[i].scan == returns[first].scan) {
      if (returns[i].scan_t_ns == returns[first].scan_t_ns) continue;
      throw std::invalid_argument("scan " + std::to_string(returns[i].scan) +
                                  " has two starts: " + std::to_string(returns[first].scan_t_ns) + " ns and " +
                                  std::to_string(returns[i].scan_t_ns) + " ns");
    }
    scans.push_back(returns.subspan(first, i - first));
    first = i;
  }
  std::sort(scans.begin(), scans.end(),
            [](const auto& a, const auto& b) { return a.front().scan_t_ns < b.front().scan_t_ns; });
  return scans;
}

/// Infinite if no two returns share a scan.
double step_rad(const Scans& scans) {
  double step = std::numeric_limits<double>::infinity();
  for (const auto& scan : scans) {
    for (std::size_t i = 1; i < scan.size(); ++i) {
      const double difference = scan[i].elevation_rad - scan[i - 1].elevation_rad;
      if (difference < 1e-6)
        throw std::invalid_argument("scan " + std::to_string(scan[i].scan) + " has two returns in one beam");
      step = std::min(step, difference);
    }
  }
  return step;
}

/// The shortest time between two scans in a row; a tenth of a second where there is one scan only.
double scan_period_s(const Scans& scans) {
  std::int64_t shortest_ns = 100'000'000;
  for (std::size_t i = 1; i < scans.size(); ++i)
    shortest_ns = std::min(shortest_ns, scans[i].front().scan_t_ns - scans[i - 1].front().scan_t_ns);
  return seconds(shortest_ns);
}

}  // namespace

LobRecord analyse_returns(std::span<const ForegroundReturn> returns, const ScannerPlace& place,
                          const AnalyzerConfig& config) {
  std::vector<ForegroundReturn> sorted(returns.begin(), returns.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::tie(a.scan, a.elevation_rad) < std::tie(b.scan, b.elevation_rad);
  });
  LobRecord best;
  best.refusal = Refusal::kTooFewPoints;
  best.why = "no flight of a ball among " + std::to_string(returns.size()) + " returns";
  if (sorted.empty()) return best;
  const Scans scans = part(sorted);
  const double step = step_rad(scans);
  if (std::isinf(step)) return best;
  Candidates candidates({.x_m = place.x_m, .z_m = place.z_m}, step, config);
  Tracker tracker(config, scan_period_s(scans));
  std::size_t most = 0;
  const auto keep = [&](std::optional<Flight> flight) {
    if (!flight || flight->centres.size() <= most) return;
    most = flight->centres.size();
    best = assess(std::move(*flight), config);
  };
  std::vector<BeamReturn> beams;
  for (const auto& scan : scans) {
    beams.clear();
    for (const ForegroundReturn& r : scan) {
      beams.push_back({static_cast<int>(std::lround(r.elevation_rad / step)), r.beam_t_ns, r.range_m,
                       std::cos(r.elevation_rad), std::sin(r.elevation_rad)});
    }
    candidates.find(beams);
    keep(tracker.add(scan.front().scan_t_ns, candidates.centres()));
  }
  keep(tracker.finish());
  return best;
}

}  // namespace trivela::kicking::lob
