#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trivela::config {

/// What a figure of a robot's file was measured from.
struct FigureOrigin {
  std::string date;                ///< ISO 8601, YYYY-MM-DD
  std::uint32_t kicks = 0;         ///< that the figure rests on
  std::vector<std::string> files;  ///< names of the records and tables
};

/// Of [table]. The lists run with its powers.
struct TableOrigin : FigureOrigin {
  std::vector<std::uint32_t> trials;
  std::vector<double> exit_speed_sds_mps;   ///< from kick to kick; empty where a set-point has a single trial
  std::optional<double> exit_speed_sd_mps;  ///< the same, pooled; none: no set-point has two trials
  bool isotonic = false;                    ///< speeds that did not rise were pooled
};

/// Of kicker.exit_angle_deg.
struct ExitAngleOrigin : FigureOrigin {
  double exit_angle_se_rad = 0.0;
  double spread_rad = 0.0;  ///< greatest less least mean angle of a set-point
};

/// Of kicker.alpha_slope_deg_per_mps and, where it was fitted, kicker.transfer_exact.lateral_ratio.
struct DeflectionOrigin : FigureOrigin {
  double alpha_slope_se_rad_per_mps = 0.0;
  double rms_rad = 0.0;
  std::optional<double> lateral_ratio_se;
};

/// Of kicker.beta_slope_s.
struct RotationOrigin : FigureOrigin {
  double beta_slope_se_s = 0.0;
  double rms_rad = 0.0;
};

/// Of kicker.transfer_exact and kicker.transfer_paper, forward and backward where they were fitted.
struct TransferOrigin : FigureOrigin {
  std::optional<double> exact_forward_se_ratio;
  std::optional<double> exact_backward_se_ratio;
  std::optional<double> paper_forward_se_ratio;
  std::optional<double> paper_backward_se_ratio;
};

/// Of kicker.delay_s.
struct DelayOrigin : FigureOrigin {
  double delay_se_s = 0.0;
  double delay_sd_s = 0.0;  ///< from kick to kick
};

/// Of kicker.spreads.direction_sd_deg. The other spreads come from [calibration.table] (exit speed, exit angle and the
/// table's own error), [calibration.delay] and [calibration.transfer], [calibration.deflection].
struct DirectionOrigin : FigureOrigin {
  double direction_sd_se_rad = 0.0;
  double observer_sd_rad = 0.0;  ///< of the camera's tracks, taken out
};

/// Of all that kicks in play show (trivela calibrate from-log): standard errors. Sections beside it are of before.
struct PlayOrigin : FigureOrigin {
  double speed_se_ratio = 0.0;
  double exit_angle_se_rad = 0.0;
  double direction_se_rad = 0.0;
  double delay_se_s = 0.0;
  double along_se_ratio = 0.0;
  double sideways_se_ratio = 0.0;
};

/// Where a calibrated robot's figures come from; a figure without a section here was not measured.
struct Calibration {
  std::string source;       ///< the tool that wrote the file last
  std::string date;         ///< of that, ISO 8601
  std::uint32_t kicks = 0;  ///< over all figures
  std::optional<TableOrigin> table;
  std::optional<ExitAngleOrigin> exit_angle;
  std::optional<DeflectionOrigin> deflection;
  std::optional<RotationOrigin> rotation;
  std::optional<TransferOrigin> transfer;
  std::optional<DelayOrigin> delay;
  std::optional<DirectionOrigin> direction;
  std::optional<PlayOrigin> play;
};

}  // namespace trivela::config
