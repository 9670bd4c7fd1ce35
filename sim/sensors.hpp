#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/geometry/frames.hpp"
#include "kicking/lob/scan.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::sim {

/// Wheels and gyro. Wheel i turns at (-sin(angle_i) vx + cos(angle_i) vy + distance omega) / radius, plus noise.
struct WheelSample {
  int wheel_count = 0;
  std::array<double, 4> wheel_radps{};
  double gyro_radps = 0.0;
};

/// The kicker's own state.
struct KickerSample {
  double charge = 1.0;          ///< capacitor energy, 0..1
  bool armed = true;            ///< the arm switch
  bool lever = false;           ///< it has a lever
  std::uint8_t lever_kind = 0;  ///< kind of kick that it stands for; kicking::kLeverMoves: it moves
};

/// A point of the floor plan.
struct PlanPoint {
  double x_m = 0.0;
  double y_m = 0.0;
};

inline constexpr std::size_t kMostFurther = 4;

/// One frame of the robot's camera.
struct VisionFrame {
  std::int64_t t_exposure_ns = 0;
  std::optional<kicking::Pose> pose;              ///< self-localisation in F
  std::optional<PlanPoint> ball;                  ///< in R
  std::optional<PlanPoint> opponent;              ///< the nearest to the ball, in R
  std::array<PlanPoint, kMostFurther> further{};  ///< other opponents that are seen, in R
  std::size_t further_count = 0;
  std::optional<PlanPoint> keeper;  ///< the opponents', in R
};

/// One observation of the ball by the flight camera, in F, z above the floor.
struct FlightFrame {
  struct Point {
    double x_m = 0.0;
    double y_m = 0.0;
    double z_m = 0.0;
  };
  std::int64_t t_exposure_ns = 0;
  std::optional<Point> ball;
};

/// What the referee has said.
struct RefereeState {
  int half = 1;
  bool playing = false;
  std::uint32_t possession_id = 0;  ///< counts from 1 in each half; the next one begins with its stop
  std::uint32_t goals = 0;          ///< ours; the opponents only defend
  std::uint32_t commands = 0;       ///< how often play was stopped or started
  kicking::OptionalDouble half_s;   ///< since the first start of play in the half
  bool set_piece = false;           ///< the next start of play is a set piece of ours
};

/// Which samples a caller wants. Those it leaves out cost nothing; the others are the same bits with or without them.
struct SensorChoice {
  bool wheels = true;
  bool vision = true;
  bool flight = true;
};

/// Everything that the robot in possession is told at t_ns.
struct Sensors {
  std::int64_t t_ns = 0;
  std::uint8_t carrier = 1;  ///< which of our robots has this possession; the samples are its own
  WheelSample wheels;
  KickerSample kicker;
  VisionFrame vision;
  FlightFrame flight;
  RefereeState referee;
  std::vector<kicking::lob::Scan> scans;  ///< of the laser, finished in the cycle before t_ns
};

}  // namespace trivela::sim
