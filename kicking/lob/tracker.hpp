#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// A ball followed through the air.
struct Flight {
  std::vector<BallCentre> centres;
  double launch_z_m = 0.0;  ///< of the ball that lay at the start, where it was seen; else its radius over the floor
};

/// Finds the flights among the things in each scan that look like a ball. Three centres that agree with free fall start
/// a track; it takes the nearest centre within 10 cm of where the fall leads (a bit more after a gap), and ends when
/// the fall leads into the floor or nothing came for lost_s. A track is a flight when it has six centres that
/// accelerate like a ball in the air, and does not begin where another flight has just ended: that is a bounce. Several
/// tracks are kept, so that a person who walks through costs nothing. A ball that lies, rolls or is carried agrees with
/// no fall.
class Tracker {
 public:
  Tracker(const AnalyzerConfig& config, double scan_period_s);

  /// What looks like a ball in the scan that began at t_ns. A flight that ended comes back.
  std::optional<Flight> add(std::int64_t t_ns, std::span<const BallCentre> candidates);

  /// Ends the flight under way.
  std::optional<Flight> finish();

  /// Centres of the flight under way; null: none.
  const std::vector<BallCentre>* under_way() const;

  /// Which of the last candidates was taken for the ball of the flight under way.
  std::optional<std::size_t> ball() const;

 private:
  struct Track {
    std::vector<BallCentre> centres;   ///< empty: free
    std::optional<std::size_t> taken;  ///< of the last candidates
    bool bounced = false;
    double launch_z_m = 0.0;
  };
  /// A ball that lies near the floor.
  struct Rest {
    double x_m = 0.0;
    double z_m = 0.0;
    int seen = 0;
    std::int64_t t_ns = 0;
  };

  void extend(Track& track, std::span<const BallCentre> candidates);
  void start(const BallCentre& first, const BallCentre& second, std::size_t third,
             std::span<const BallCentre> candidates);
  void remember_unused(std::span<const BallCentre> candidates);
  bool is_over(const Track& track, std::int64_t t_ns) const;
  std::optional<Flight> end(Track& track);
  void look_for_rest(const BallCentre& candidate);
  bool is_flight(const Track& track) const;

  AnalyzerConfig config_;
  double lost_s_;
  std::array<Track, 8> tracks_;
  std::vector<std::uint8_t> used_;                 ///< a candidate each
  std::array<std::vector<BallCentre>, 2> unused_;  ///< of the two scans before, the older first
  std::optional<BallCentre> landed_;               ///< last centre of the last flight or bounce
  Rest rest_;
};

}  // namespace trivela::kicking::lob
