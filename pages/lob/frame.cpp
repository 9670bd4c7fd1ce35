#include "pages/lob/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace trivela::pages {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// RFC 4648.
void append_base64(std::string& text, const std::vector<std::uint8_t>& bytes) {
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < left ? bytes[i + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += j <= left ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
}

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
  append_base64(text, bytes);
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

}  // namespace trivela::pages
