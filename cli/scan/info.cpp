#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include "calibration/rows/lobs_of_scans.hpp"
#include "cli/options/output.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/lob_json.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::cli {
namespace {

using evaluator::Json;
using kicking::degrees;
using kicking::lob::LobRecord;

/// What a scan record holds.
struct ScanInfo {
  std::string file;
  log::ScanSession session;
  std::size_t scans = 0;
  double duration_s = 0.0;
  std::uintmax_t bytes = 0;
  std::size_t set_points = 0;
  std::vector<LobRecord> lobs;
  std::vector<std::string> warnings;
};

ScanInfo info_of(const log::ScanReader& record, const std::filesystem::path& path) {
  ScanInfo info{.file = path.string(),
                .session = record.session(),
                .scans = record.size(),
                .bytes = std::filesystem::file_size(path),
                .set_points = record.set_points().size(),
                .lobs = calibration::lobs_of_scans(record, {}, calibration::verdicts_beside(path)),
                .warnings = record.warnings()};
  if (info.scans > 0) {
    info.duration_s =
        kicking::seconds(record.t_ns(info.scans - 1) - record.t_ns(0)) + info.session.geometry.scan_period_s;
  }
  return info;
}

Json to_json(const LobRecord& lob) {
  Json json{
      {"launch_t_ns", lob.launch_t_ns}, {"power", evaluator::json_of(lob.power)}, {"centres", lob.centres.size()}};
  json.update(evaluator::verdict_json(lob));
  json["effective"] = evaluator::effective_json(lob, evaluator::EstimateForm::kValue);
  return json;
}

Json to_json(const ScanInfo& info) {
  const log::ScanSession& session = info.session;
  const kicking::lob::ScanGeometry& geometry = session.geometry;
  return {{"file", info.file},
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
            {"first_angle_deg", degrees(geometry.first_angle_rad)},
            {"step_deg", degrees(geometry.step_rad)},
            {"scan_period_s", geometry.scan_period_s},
            {"min_range_m", geometry.min_range_m},
            {"max_range_m", geometry.max_range_m}}},
          {"mount",
           {{"laser_x_m", session.mount.x_m},
            {"laser_z_m", session.mount.z_m},
            {"front_elevation_deg", degrees(session.mount.front_elevation_rad)},
            {"mirrored", session.mount.mirrored}}},
          {"software_version", session.software_version},
          {"scans", info.scans},
          {"duration_s", info.duration_s},
          {"bytes", info.bytes},
          {"set_points", info.set_points},
          {"lobs", evaluator::json_list(info.lobs, [](const LobRecord& lob) { return to_json(lob); })},
          {"warnings", info.warnings}};
}

std::string to_text(const LobRecord& lob) {
  const std::string values =
      lob.effective ? fmt::format("{:.2f} m/s at {:.2f} degrees (effective)", lob.effective->exit_speed_mps.value,
                                  degrees(lob.effective->exit_angle_rad.value))
                    : "no fit";
  return fmt::format(
      "    power {:>4}  {}  {}\n", lob.power ? fmt::format("{:g}", *lob.power) : "?", values,
      lob.refusal == kicking::lob::Refusal::kNone ? "accepted" : "refused: " + kicking::printable(lob.why));
}

std::string to_text(const ScanInfo& info) {
  using kicking::printable;
  const kicking::lob::ScannerIdentity& scanner = info.session.identity;
  const kicking::lob::ScanGeometry& geometry = info.session.geometry;
  const kicking::lob::LaserMount& mount = info.session.mount;
  std::string text = printable(info.file) + '\n';
  if (info.session.simulated) text += fmt::format("  {}\n", kSyntheticNotice);
  text += fmt::format("  scanner    {} {}, serial {}, firmware {}, {}\n", printable(scanner.vendor),
                      printable(scanner.product), printable(scanner.serial), printable(scanner.firmware),
                      printable(scanner.protocol));
  text += fmt::format("  source     {}\n", printable(info.session.source));
  text +=
      fmt::format("  geometry   {} beams of {:.4f} degrees from {:.2f} degrees, {:.1f} scans/s, {:.2f} to {:.1f} m\n",
                  geometry.beams, degrees(geometry.step_rad), degrees(geometry.first_angle_rad),
                  1.0 / geometry.scan_period_s, geometry.min_range_m, geometry.max_range_m);
  text += fmt::format("  mount      {:.3f} m along the kick, {:.3f} m over the floor, front at {:.2f} degrees{}\n",
                      mount.x_m, mount.z_m, degrees(mount.front_elevation_rad), mount.mirrored ? ", mirrored" : "");
  text += fmt::format("  scans      {} in {:.1f} s, {} bytes, {} set-points entered\n", info.scans, info.duration_s,
                      info.bytes, info.set_points);
  text += fmt::format("  lobs       {}\n", info.lobs.size());
  for (const LobRecord& lob : info.lobs) text += to_text(lob);
  for (const std::string& warning : info.warnings) text += fmt::format("  warning    {}\n", printable(warning));
  return text;
}

}  // namespace

int show_scan_info(const std::filesystem::path& record, bool json) {
  const ScanInfo info = info_of(log::ScanReader(record), record);
  fmt::print("{}", json ? evaluator::json_text(to_json(info)) : to_text(info));
  return info.warnings.empty() ? kDone : kDoneWithLoss;
}

}  // namespace trivela::cli
