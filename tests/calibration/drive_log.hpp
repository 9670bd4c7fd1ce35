#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "kicking/alignment/release_predictor.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/model/robot_model.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::calibration {

inline constexpr double kDelay_s = 0.06;
inline constexpr double kPower = 25.0;

/// Where the ball of a kick with this transfer crosses, by the forward predictor.
inline kicking::PredictedCrossing flown(const kicking::Pose& pose, const kicking::Twist& twist,
                                        const kicking::Transfer& transfer) {
  const kicking::RobotModel model;
  const kicking::KickAction kick{model.table.speed_for(kPower), model.exit_angle_rad, transfer, kDelay_s,
                                 model.ball_offset_m};
  return *kicking::predict_crossing(pose, twist, kick, 9.0);
}

/// A log of drive kicks as a recorder writes it, with a truth that contradicts everything.
class DriveLog : public evaluator::LogTest {
 protected:
  using Int = std::int64_t;

  DriveLog() : writer_(path(), session(), options()) {
    decisions_ =
        writer_.table("kick_decisions", {"robot_id",   "seq",           "t_ns",         "kick_id",
                                         "half",       "possession_id", "policy",       "fire",
                                         "reason",     "x_m",           "y_m",          "heading_rad",
                                         "vx_mps",     "vy_mps",        "omega_radps",  "target_x_m",
                                         "target_y_m", "target_z_m",    "distance_m",   "alpha_rad",
                                         "beta_rad",   "aligned",       "left_m",       "right_m",
                                         "charge",     "shadow_count",  "fire_after_s", "assignment_probability"});
    receipts_ = writer_.table("kick_receipts",
                              {"robot_id", "seq", "t_ns", "kick_id", "accepted", "refusal", "order_t_ns", "fired_t_ns",
                               "release_t_ns", "power", "received_steady_ns", "fired_steady_ns"});
    outcomes_ = writer_.table("kick_outcomes", {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target",
                                                "x_cross_m", "z_cross_m", "observations"});
    truths_ = writer_.table("kick_truths", {"robot_id", "seq", "t_ns", "kick_id", "half", "possession_id", "outcome",
                                            "x_cross_m", "z_cross_m", "release_t_ns", "release_x_m", "release_y_m",
                                            "release_vx_mps", "release_vy_mps", "release_vz_mps", "saved"});
    frames_ = writer_.table(
        "flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"});
  }

  void kick(const std::string& policy, const kicking::Pose& pose, const kicking::Twist& twist,
            const std::optional<double>& x_cross_m, const std::optional<double>& z_cross_m, bool accepted = true) {
    const Int id = ++kicks_;
    const Int t_ns = id * 1'000'000'000;
    writer_.push(decisions_, {Int{1},       ++seq_,       t_ns,
                              id,           Int{1},       id,
                              policy,       Int{1},       "fire",
                              pose.x_m,     pose.y_m,     pose.heading_rad,
                              twist.vx_mps, twist.vy_mps, twist.omega_radps,
                              0.0,          9.0,          0.7,
                              5.0,          0.0,          0.0,
                              Int{1},       0.3,          0.3,
                              1.0,          Int{0},       0.0,
                              1.0});
    writer_.push(receipts_, {Int{1}, ++seq_, t_ns, id, Int{accepted}, accepted ? "none" : "charging", t_ns, t_ns, t_ns,
                             kPower, Int{0}, Int{0}});
    const auto cell = [](const std::optional<double>& value) { return value ? log::Value(*value) : log::Value(); };
    writer_.push(outcomes_, {Int{1}, ++seq_, t_ns, id, "wide_left", Int{0}, cell(x_cross_m), cell(z_cross_m), Int{9}});
    writer_.push(truths_, {Int{1}, ++seq_, t_ns, id, Int{1}, id, "on_target", 77.0, 77.0, t_ns, 0.0, 0.0, 0.0, 0.0, 0.0,
                           Int{0}});
  }

  void kick(const std::string& policy, const kicking::Pose& pose, const kicking::Twist& twist,
            const kicking::Transfer& transfer) {
    const kicking::PredictedCrossing crossing = flown(pose, twist, transfer);
    kick(policy, pose, twist, crossing.x_m, crossing.z_m);
  }

  /// What a flight camera sees of the latest kick: a flight with drag that leaves (0.1, 3.27) of F straight ahead of a
  /// robot that points 0.02 rad to the left, with `along_mps` + `of_robot_mps`.
  void see_flight(double along_mps, double up_mps, double of_robot_mps) {
    constexpr double kStep_s = 1e-4;
    const kicking::Ball ball;
    const double k = kicking::drag_per_m(ball, {}), all_mps = along_mps + of_robot_mps;
    Eigen::Vector3d place(0.1, 3.27, ball.radius_m);
    Eigen::Vector3d velocity(-std::sin(0.02) * all_mps, std::cos(0.02) * all_mps, up_mps);
    for (int i = 0; i < 9000; ++i) {
      if (i % 200 == 0) {
        const Int t_ns = kicks_ * 1'000'000'000 + kicking::nanoseconds(kDelay_s + i * kStep_s);
        writer_.push(frames_, {Int{1}, ++seq_, t_ns, t_ns, Int{1}, place.x(), place.y(), place.z()});
      }
      velocity += kStep_s * (Eigen::Vector3d(0, 0, -kicking::kGravity_mps2) - k * velocity.norm() * velocity);
      place += kStep_s * velocity;
    }
  }

  log::Reader read() {
    writer_.finalise();
    return log::Reader(path());
  }

  log::Writer writer_;
  log::TableId decisions_{}, receipts_{}, outcomes_{}, truths_{}, frames_{};
  Int kicks_ = 0;
  Int seq_ = 0;
};

}  // namespace trivela::calibration
