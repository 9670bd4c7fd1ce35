#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "calibration/rows/lobs_of_scans.hpp"
#include "calibration/rows/verdicts_file.hpp"
#include "cli/say.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "evaluator/report/json_values.hpp"

namespace trivela::cli {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const kicking::lob::LobRecord& lob) {
  ordered_json json{{"launch_t_ns", lob.launch_t_ns},
                    {"power", nullptr},
                    {"centres", lob.centres.size()},
                    {"accepted", lob.refusal == kicking::lob::Refusal::kNone},
                    {"refusal", kicking::lob::name(lob.refusal)},
                    {"why", lob.why},
                    {"effective", nullptr}};
  if (lob.power) json["power"] = *lob.power;
  if (lob.effective) {
    json["effective"] = {{"exit_angle_deg", kicking::degrees(lob.effective->exit_angle_rad.value)},
                         {"exit_speed_mps", lob.effective->exit_speed_mps.value},
                         {"height_m", lob.effective->height_m.value},
                         {"distance_m", lob.effective->distance_m.value}};
  }
  return json;
}

ordered_json info_of(const evaluator::log::ScanReader& record, const std::filesystem::path& path) {
  const evaluator::log::ScanSession& session = record.session();
  const kicking::lob::ScanGeometry& geometry = session.geometry;
  const double duration_s =
      record.size() == 0
          ? 0.0
          : static_cast<double>(record.t_ns(record.size() - 1) - record.t_ns(0)) * 1e-9 + geometry.scan_period_s;
  ordered_json info{{"file", path.string()},
                    {"synthetic", session.simulated},
                    {"source", session.source},
                    {"scanner",
                     {{"vendor", session.identity.vendor},
                      {"product", session.identity.product},
                      {"serial", session.identity.serial},
                      {"firmware", session.identity.firmware},
                      {"protocol", session.identity.protocol}}},
                    {"geometry",
                     {{"beams", geometry.beams},
                      {"first_angle_deg", kicking::degrees(geometry.first_angle_rad)},
                      {"step_deg", kicking::degrees(geometry.step_rad)},
                      {"scan_period_s", geometry.scan_period_s},
                      {"min_range_m", geometry.min_range_m},
                      {"max_range_m", geometry.max_range_m}}},
                    {"mount",
                     {{"laser_x_m", session.mount.x_m},
                      {"laser_z_m", session.mount.z_m},
                      {"front_elevation_deg", kicking::degrees(session.mount.front_elevation_rad)},
                      {"mirrored", session.mount.mirrored}}},
                    {"software_version", session.software_version},
                    {"scans", record.size()},
                    {"duration_s", duration_s},
                    {"bytes", std::filesystem::file_size(path)},
                    {"set_points", record.set_points().size()},
                    {"lobs", ordered_json::array()},
                    {"warnings", record.warnings()}};
  for (const kicking::lob::LobRecord& lob :
       calibration::lobs_of_scans(record, {}, calibration::verdicts_beside(path))) {
    info["lobs"].push_back(json_of(lob));
  }
  return info;
}

void print(const ordered_json& info) {
  const auto& scanner = info["scanner"];
  const auto& geometry = info["geometry"];
  const auto text = [](const ordered_json& value) { return kicking::printable(value.get<std::string>()); };
  fmt::print("{}\n", text(info["file"]));
  if (info["synthetic"].get<bool>()) fmt::print("  {}\n", kSyntheticNotice);
  fmt::print("  scanner    {} {}, serial {}, firmware {}, {}\n", text(scanner["vendor"]), text(scanner["product"]),
             text(scanner["serial"]), text(scanner["firmware"]), text(scanner["protocol"]));
  fmt::print("  source     {}\n", text(info["source"]));
  fmt::print("  geometry   {} beams of {:.4f} degrees from {:.2f} degrees, {:.1f} scans/s, {:.2f} to {:.1f} m\n",
             geometry["beams"].get<int>(), geometry["step_deg"].get<double>(),
             geometry["first_angle_deg"].get<double>(), 1.0 / geometry["scan_period_s"].get<double>(),
             geometry["min_range_m"].get<double>(), geometry["max_range_m"].get<double>());
  fmt::print("  mount      {:.3f} m along the kick, {:.3f} m over the floor, front at {:.2f} degrees{}\n",
             info["mount"]["laser_x_m"].get<double>(), info["mount"]["laser_z_m"].get<double>(),
             info["mount"]["front_elevation_deg"].get<double>(),
             info["mount"]["mirrored"].get<bool>() ? ", mirrored" : "");
  fmt::print("  scans      {} in {:.1f} s, {} bytes, {} set-points entered\n", info["scans"].get<std::size_t>(),
             info["duration_s"].get<double>(), info["bytes"].get<std::size_t>(), info["set_points"].get<std::size_t>());
  fmt::print("  lobs       {}\n", info["lobs"].size());
  for (const auto& lob : info["lobs"]) {
    const std::string power = lob["power"].is_null() ? "?" : fmt::format("{:g}", lob["power"].get<double>());
    const auto& fit = lob["effective"];
    const std::string values =
        fit.is_null() ? "no fit"
                      : fmt::format("{:.2f} m/s at {:.2f} degrees (effective)", fit["exit_speed_mps"].get<double>(),
                                    fit["exit_angle_deg"].get<double>());
    fmt::print("    power {:>4}  {}  {}\n", power, values,
               lob["accepted"].get<bool>() ? "accepted" : "refused: " + text(lob["why"]));
  }
  for (const auto& warning : info["warnings"]) fmt::print("  warning    {}\n", text(warning));
}

}  // namespace

int show_scan_info(const std::filesystem::path& record, bool json) {
  const evaluator::log::ScanReader reader(record);
  const ordered_json info = info_of(reader, record);
  if (json) {
    fmt::print("{}", evaluator::json_text(info));
  } else {
    print(info);
  }
  return reader.warnings().empty() ? kDone : kDoneWithLoss;
}

}  // namespace trivela::cli
