#pragma once

#include <array>
#include <cstdint>

namespace trivela::kicking {

/// Philox 4x32 with 10 rounds: 128 random bits as a pure function of a counter and a key. Source: Salmon et al.,
/// "Parallel random numbers: as easy as 1, 2, 3" (SC 2011); the tests hold it against Random123's known answers.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// What a random number is for. Each role has numbers of its own, so that drawing more of one never shifts another.
enum class Role : std::uint32_t {
  kStart,
  kOpponent,
  kKicker,
  kWheelSlip,
  kOdometryNoise,  // gyro, then the wheels
  kGyroBias,
  kPoseSlow,
  kPoseNoise,
  kSightNoise,  // ball and opponent
  kVisionDropout,
  kFlightNoise,
  kFlightDropout,
  kLaserNoise,
  kLaserDropout,
  kLaserMixed,
  kHandTable,
  kReferee,
  kTeam,
  kKeeper,
  kDefender,
  kKeeperSight,
  kFurtherSight,  // opponents beside the nearest one
};

/// The random numbers of one opportunity: fixed by (seed, opportunity, role, counter, index), in whatever order and
/// however often they are asked for. `counter` is the cycle since the opportunity began, or the attempt; `index` is
/// below 65536.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t opportunity) : seed_(seed), opportunity_(opportunity) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform(Role role, std::uint32_t counter, std::uint32_t index = 0) const;

  /// Uniform in [low, high).
  double uniform_in(double low, double high, Role role, std::uint32_t counter, std::uint32_t index = 0) const;

  /// Four independent numbers, uniform in [0, 1), 32 bits.
  std::array<double, 4> uniforms(Role role, std::uint32_t counter, std::uint32_t index = 0) const;

  /// Four independent standard normal numbers (ziggurat, 24 bits of magnitude).
  std::array<double, 4> normals(Role role, std::uint32_t counter, std::uint32_t index = 0) const;

  /// The first of normals().
  double normal(Role role, std::uint32_t counter, std::uint32_t index = 0) const;

 private:
  std::array<std::uint32_t, 4> block(Role role, std::uint32_t counter, std::uint32_t index) const;
  double normal_of(std::uint32_t word, Role role, std::uint32_t counter, std::uint32_t index, std::uint32_t lane) const;
  double rare_normal(std::uint32_t word, Role role, std::uint32_t counter, std::uint32_t index,
                     std::uint32_t lane) const;

  std::uint64_t seed_;
  std::uint32_t opportunity_;
};

}  // namespace trivela::kicking
