#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pages/serve/page.hpp"

namespace trivela::pages {

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
