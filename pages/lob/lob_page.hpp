#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/lob/analyzer.hpp"
#include "log/write/scan_log.hpp"
#include "pages/lob/lob_session.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::pages {

/// Neighbouring beams of one kind.
struct BeamRun {
  enum Kind { kObject = 1, kBall = 2 };
  std::size_t first = 0;
  std::size_t last = 0;
  int kind = kObject;
};

/// What the analysis said of one scan, small enough to be kept for every scan of a record.
struct SceneView {
  std::int64_t t_ns = 0;
  bool background_known = false;
  std::vector<BeamRun> runs;  ///< the other beams are background
  std::optional<std::array<float, 2>> centre_m;
  std::vector<std::array<float, 2>> track_m;  ///< x, z of the flight under way
};

SceneView scene_of(const kicking::lob::ScanView& view);

/// A frame for the page: {"i", "t_s", "ready", "ranges", "runs": [[first, last, kind], ...], "centre", "track"}.
/// `ranges` is base64 of a 16-bit number a beam, low byte first: mm, 0 where nothing came back, 65535 for all that is
/// farther.
std::string frame_json(std::size_t index, double t_s, std::span<const std::uint32_t> range_mm, double max_range_m,
                       const SceneView& view);

/// What the page must know before it draws a scan. `mode`: "live" or "replay"; `file`: of the record.
nlohmann::json setup_json(const std::string& mode, const std::string& file, const log::ScanSession& session,
                          const kicking::lob::AnalyzerConfig& config);

/// One lob as the page shows it. "curve": {"x_m", "z_m", "k_per_m"} of z = z_m - k_per_m (x - x_m)^2 through its
/// centres, with the curvature k = 4 H / D^2 of the effective fit; null where there is none.
nlohmann::json lob_json(const kicking::lob::LobRecord& lob, std::int64_t start_t_ns);

/// A row for each power of accepted lobs, rising: {"power", "trials", "exit_speed_mps", "exit_speed_sd_mps",
/// "exit_angle_deg", "exit_angle_sd_deg"}, effective values; sd null for one trial.
nlohmann::json table_json(std::span<const kicking::lob::LobRecord> lobs);

/// {"trials", "powers": [{"power", "done"}, ...]}; null: no plan.
nlohmann::json plan_json(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs);

/// What the page shows and does: a live scanner or a replayed record. Publishes by itself. Any thread.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Everything but the scans: {"setup", "lobs", "table", "plan", "status"}.
  virtual nlohmann::json state() const = 0;

  /// Frame of scan i, see frame_json(). Throws CommandError where there is no such scan.
  virtual std::string frame(std::size_t i) = 0;

  /// Rows power,height_m,distance_m of the lobs shown as accepted.
  virtual std::string table_csv() const = 0;

  /// Does `name` with its arguments. Throws CommandError; nlohmann::json::exception for arguments of a wrong type.
  virtual void command(const std::string& name, const nlohmann::json& arguments) = 0;

  /// Throws what ended the scene's own thread, if anything did.
  virtual void check() const = 0;

  /// Ends the scene's own thread, and a live record. Throws what check() does.
  virtual void finish() = 0;
};

/// What the page of lobs follows. A frame may be skipped; the others are snapshots of a whole, so that the newest says
/// all.
enum Channel : std::size_t { kSetup, kLobs, kStatus, kFrame };

/// Their names as events.
inline std::vector<std::string> lob_channels() { return {"setup", "lobs", "status", "frame"}; }

/// The page of lobs: /, /api/state, /api/frame?i=N, /api/table.csv and the scene's commands. The scene must outlive it.
Page lob_page(Scene& scene);

}  // namespace trivela::pages
