#include "pages/lob/setup_json.hpp"

namespace trivela::pages {

nlohmann::json setup_json(const std::string& mode, const std::string& file, const evaluator::log::ScanSession& session,
                          const kicking::lob::AnalyzerConfig& config) {
  const kicking::lob::ScanGeometry& geometry = session.geometry;
  const kicking::lob::LaserMount& mount = session.mount;
  return {{"mode", mode},
          {"file", file},
          {"scanner", session.identity.vendor + " " + session.identity.product},
          {"source", session.source},
          {"synthetic", session.simulated},
          {"beams", geometry.beams},
          {"first_angle_rad", geometry.first_angle_rad},
          {"step_rad", geometry.step_rad},
          {"scan_period_s", geometry.scan_period_s},
          {"max_range_m", geometry.max_range_m},
          {"laser", {mount.x_m, mount.z_m}},
          {"front_elevation_rad", mount.front_elevation_rad},
          {"mirrored", mount.mirrored},
          {"ball_radius_m", config.ball.radius_m},
          {"method", config.centre == kicking::lob::CentreMethod::kCircle ? "circle" : "middle of limits"}};
}

}  // namespace trivela::pages
