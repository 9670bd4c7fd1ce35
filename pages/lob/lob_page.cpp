#include "pages/lob/lob_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "config/text/parse_number.hpp"
#include "evaluator/render/lob_json.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/time.hpp"
#include "log/schema/digest.hpp"
#include "pages/lob/page.css.hpp"
#include "pages/lob/page.html.hpp"
#include "pages/lob/page.js.hpp"

namespace trivela::pages {
namespace {

std::array<float, 2> place_of(const kicking::lob::BallCentre& centre) {
  return {static_cast<float>(centre.x_m), static_cast<float>(centre.z_m)};
}

}  // namespace

SceneView scene_of(const kicking::lob::ScanView& view) {
  SceneView scene;
  scene.t_ns = view.t_ns;
  scene.background_known = view.background_known;
  for (std::size_t i = 0; i < view.foreground.size(); ++i) {
    const bool ball = i < view.ball.size() && view.ball[i] != 0;
    if (view.foreground[i] == 0 && !ball) continue;
    const int kind = ball ? BeamRun::kBall : BeamRun::kObject;
    if (!scene.runs.empty() && scene.runs.back().last + 1 == i && scene.runs.back().kind == kind) {
      scene.runs.back().last = i;
    } else {
      scene.runs.push_back({i, i, kind});
    }
  }
  if (view.centre) scene.centre_m = place_of(*view.centre);
  if (view.track != nullptr) std::ranges::transform(*view.track, std::back_inserter(scene.track_m), place_of);
  return scene;
}

std::string frame_json(std::size_t index, double t_s, std::span<const std::uint32_t> range_mm, double max_range_m,
                       const SceneView& view) {
  const auto farthest_mm = static_cast<std::uint32_t>(max_range_m * 1000.0);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * range_mm.size());
  for (const std::uint32_t range : range_mm) {
    const bool none = range < kicking::lob::kFirstRange_mm || range > farthest_mm;
    const std::uint32_t drawn = none ? 0 : std::min<std::uint32_t>(range, 65535);
    bytes.push_back(static_cast<std::uint8_t>(drawn & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(drawn >> 8));
  }
  std::string text = fmt::format(R"({{"i":{},"t_s":{:.4f},"ready":{},"ranges":")", index, t_s, view.background_known);
  text += log::base64(bytes);
  const auto out = std::back_inserter(text);
  const char* comma = "";
  text += R"(","runs":[)";
  for (const BeamRun& run : view.runs) {
    fmt::format_to(out, "{}[{},{},{}]", comma, run.first, run.last, run.kind);
    comma = ",";
  }
  text += R"(],"centre":)";
  if (view.centre_m) {
    fmt::format_to(out, "[{:.4f},{:.4f}]", (*view.centre_m)[0], (*view.centre_m)[1]);
  } else {
    text += "null";
  }
  text += R"(,"track":[)";
  comma = "";
  for (const auto& place : view.track_m) {
    fmt::format_to(out, "{}[{:.4f},{:.4f}]", comma, place[0], place[1]);
    comma = ",";
  }
  return text + "]}";
}

namespace {

using evaluator::EstimateForm;
using kicking::lob::LobRecord;
using nlohmann::json;

// With k known, z + k x^2 = (2 k x_a) x + (z_a - k x_a^2) is a line in x.
json curve_json(const LobRecord& lob) {
  if (!lob.effective || lob.centres.empty() || lob.effective->distance_m.value <= 0.0) return nullptr;
  const double k = 4.0 * lob.effective->height_m.value / std::pow(lob.effective->distance_m.value, 2);
  const auto n = static_cast<double>(lob.centres.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const auto& centre : lob.centres) {
    mean_x += centre.x_m / n;
    mean_y += (centre.z_m + k * centre.x_m * centre.x_m) / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const auto& centre : lob.centres) {
    const double dx = centre.x_m - mean_x;
    xx += dx * dx;
    xy += dx * (centre.z_m + k * centre.x_m * centre.x_m - mean_y);
  }
  if (!(xx > 0.0) || !(k > 0.0)) return nullptr;
  const double slope = xy / xx;
  const double x = slope / (2.0 * k);
  return {{"x_m", x}, {"z_m", mean_y - slope * mean_x + k * x * x}, {"k_per_m", k}};
}

struct Spread {
  int n = 0;
  double mean = 0.0;
  double squares = 0.0;  // sum over (value - mean)^2

  void add(double value) {
    const double before = value - mean;
    mean += before / ++n;
    squares += before * (value - mean);
  }
  json sd() const { return n < 2 ? json(nullptr) : json(std::sqrt(squares / (n - 1))); }
};

}  // namespace

nlohmann::json setup_json(const std::string& mode, const std::string& file, const log::ScanSession& session,
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

json lob_json(const LobRecord& lob, std::int64_t start_t_ns) {
  json out{{"t_s", kicking::seconds(lob.launch_t_ns - start_t_ns)},
           {"launch_t_ns", std::to_string(lob.launch_t_ns)},
           {"power", evaluator::json_of(lob.power)},
           {"effective", evaluator::effective_json(lob, EstimateForm::kObject)},
           {"true", evaluator::true_json(lob, EstimateForm::kObject)},
           {"curve", curve_json(lob)},
           {"centres", json::array()}};
  out.update(json(evaluator::verdict_json(lob)));
  for (const auto& centre : lob.centres) {
    out["centres"].push_back({std::round(centre.x_m * 1e4) * 1e-4, std::round(centre.z_m * 1e4) * 1e-4});
  }
  return out;
}

json table_json(std::span<const LobRecord> lobs) {
  struct Row {
    Spread speed;
    Spread angle;
  };
  std::map<double, Row> rows;
  for (const LobRecord& lob : lobs) {
    if (lob.refusal != kicking::lob::Refusal::kNone || !lob.power || !lob.effective) continue;
    Row& row = rows[*lob.power];
    row.speed.add(lob.effective->exit_speed_mps.value);
    row.angle.add(kicking::degrees(lob.effective->exit_angle_rad.value));
  }
  json table = json::array();
  for (const auto& [power, row] : rows) {
    table.push_back({{"power", power},
                     {"trials", row.speed.n},
                     {"exit_speed_mps", row.speed.mean},
                     {"exit_speed_sd_mps", row.speed.sd()},
                     {"exit_angle_deg", row.angle.mean},
                     {"exit_angle_sd_deg", row.angle.sd()}});
  }
  return table;
}

json plan_json(const CalibrationPlan& plan, std::span<const LobRecord> lobs) {
  if (plan.powers.empty()) return nullptr;
  const std::vector<int> done = kicks_done(plan, lobs);
  json powers = json::array();
  for (std::size_t i = 0; i < plan.powers.size(); ++i) {
    powers.push_back({{"power", plan.powers[i]}, {"done", done[i]}});
  }
  return {{"trials", plan.trials}, {"powers", powers}};
}

Page lob_page(Scene& scene) {
  Page page;
  page.assets = {{"/", kPageHtml, "text/html; charset=utf-8"},
                 {"/page.js", kPageJs, "text/javascript; charset=utf-8"},
                 {"/page.css", kPageCss, "text/css; charset=utf-8"}};
  page.resources = {
      {"/api/state", "application/json", [&scene](const auto&) { return scene.state().dump(); }},
      {"/api/frame", "application/json",
       [&scene](const auto& parameter) {
         const auto i = config::parse_integer(parameter("i"));
         if (!i) throw CommandError{400, "i must be a number"};
         return scene.frame(static_cast<std::size_t>(*i));
       }},
      {"/api/table.csv", "text/csv; charset=utf-8", [&scene](const auto&) { return scene.table_csv(); }, "lobs.csv"}};
  page.command = [&scene](const std::string& name, const nlohmann::json& arguments) { scene.command(name, arguments); };
  return page;
}

}  // namespace trivela::pages
