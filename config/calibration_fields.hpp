#pragma once

#include "config/calibration.hpp"
#include "config/text/field_types.hpp"

/// The keys of a robot's [calibration], each named once.
namespace trivela::config {

inline constexpr Range kKickCounts{0.0, 1e6};
inline constexpr Range kErrors{0.0, 1e3};

template <class V>
void fields_of_origin(V& v, FigureOrigin& o) {
  v("date", o.date);
  v("kicks", o.kicks, kKickCounts);
  v("files", o.files);
}

template <class V>
void fields(V& v, TableOrigin& o) {
  fields_of_origin(v, o);
  v("trials", o.trials, kKickCounts);
  v("exit_speed_sds_mps", o.exit_speed_sds_mps, kErrors);
  v("exit_speed_sd_mps", o.exit_speed_sd_mps, kErrors);
  v("isotonic", o.isotonic);
}

template <class V>
void fields(V& v, ExitAngleOrigin& o) {
  fields_of_origin(v, o);
  v("exit_angle_se_deg", Degrees{o.exit_angle_se_rad}, kErrors);
  v("spread_deg", Degrees{o.spread_rad}, kErrors);
}

template <class V>
void fields(V& v, DeflectionOrigin& o) {
  fields_of_origin(v, o);
  v("alpha_slope_se_deg_per_mps", Degrees{o.alpha_slope_se_rad_per_mps}, kErrors);
  v("rms_deg", Degrees{o.rms_rad}, kErrors);
  v("lateral_ratio_se", o.lateral_ratio_se, kErrors);
}

template <class V>
void fields(V& v, RotationOrigin& o) {
  fields_of_origin(v, o);
  v("beta_slope_se_s", o.beta_slope_se_s, kErrors);
  v("rms_deg", Degrees{o.rms_rad}, kErrors);
}

template <class V>
void fields(V& v, TransferOrigin& o) {
  fields_of_origin(v, o);
  v("exact_forward_se_ratio", o.exact_forward_se_ratio, kErrors);
  v("exact_backward_se_ratio", o.exact_backward_se_ratio, kErrors);
  v("paper_forward_se_ratio", o.paper_forward_se_ratio, kErrors);
  v("paper_backward_se_ratio", o.paper_backward_se_ratio, kErrors);
}

template <class V>
void fields(V& v, DelayOrigin& o) {
  fields_of_origin(v, o);
  v("delay_se_s", o.delay_se_s, kErrors);
  v("delay_sd_s", o.delay_sd_s, kErrors);
}

template <class V>
void fields(V& v, DirectionOrigin& o) {
  fields_of_origin(v, o);
  v("direction_sd_se_deg", Degrees{o.direction_sd_se_rad}, kErrors);
  v("observer_sd_deg", Degrees{o.observer_sd_rad}, kErrors);
}

template <class V>
void fields(V& v, PlayOrigin& o) {
  fields_of_origin(v, o);
  v("speed_se_ratio", o.speed_se_ratio, kErrors);
  v("exit_angle_se_deg", Degrees{o.exit_angle_se_rad}, kErrors);
  v("direction_se_deg", Degrees{o.direction_se_rad}, kErrors);
  v("delay_se_s", o.delay_se_s, kErrors);
  v("along_se_ratio", o.along_se_ratio, kErrors);
  v("sideways_se_ratio", o.sideways_se_ratio, kErrors);
}

template <class V>
void fields(V& v, Calibration& c) {
  v("source", c.source);
  v("date", c.date);
  v("kicks", c.kicks, kKickCounts);
  v("table", c.table);
  v("exit_angle", c.exit_angle);
  v("deflection", c.deflection);
  v("rotation", c.rotation);
  v("transfer", c.transfer);
  v("delay", c.delay);
  v("direction", c.direction);
  v("play", c.play);
}

}  // namespace trivela::config
