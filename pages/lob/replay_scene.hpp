#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "pages/lob/frame.hpp"
#include "pages/lob/lob_session.hpp"
#include "pages/lob/player.hpp"
#include "pages/lob/scene.hpp"
#include "pages/serve/broadcast.hpp"

namespace trivela::pages {

/// A finished record, analysed as a whole before it plays, so that a scan looks the same however it is come to.
/// Verdicts go to the file beside the record. Commands: `player` {"playing", "speed", "position", "step"}, `verdict`
/// {"lob", "accepted", "why"}. All viewers see the same place.
class ReplayScene : public Scene {
 public:
  /// Throws std::runtime_error where the record cannot be read or holds no scans.
  ReplayScene(const std::filesystem::path& record, const kicking::lob::AnalyzerConfig& config,
              const CalibrationPlan& plan, Broadcast& broadcast);
  ~ReplayScene() override;

  nlohmann::json state() const override;
  std::string frame(std::size_t i) override;
  std::string table_csv() const override;
  void command(const std::string& name, const nlohmann::json& arguments) override;
  void finish() override;
  void check() const override;

 private:
  void run();
  void play_on(std::unique_lock<std::mutex>& lock);
  void play(const nlohmann::json& arguments);
  void judge(const nlohmann::json& arguments);
  std::string frame_now(std::size_t i) const;
  nlohmann::json status() const;
  void publish_lobs();
  void publish_place();

  const std::filesystem::path path_;
  Broadcast& broadcast_;
  mutable std::mutex mutex_;  // of all below
  log::ScanReader record_;
  std::vector<SceneView> views_;
  LobSession lob_session_;
  Player player_;
  nlohmann::json setup_;
  std::size_t shown_lobs_ = 0;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::condition_variable changed_;
  std::thread thread_;  // last: everything that it uses exists
};

}  // namespace trivela::pages
