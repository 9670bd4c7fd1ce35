#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "pages/lob/lob_page.hpp"
#include "pages/lob/lob_session.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::pages {

/// Where a replay stands, by its own clock: speed 1 is real time, a negative speed plays backwards.
class Player {
 public:
  /// Start of each scan, rising; one at least.
  explicit Player(std::vector<std::int64_t> t_ns);

  std::size_t position() const { return position_; }
  bool playing() const { return playing_; }
  double speed() const { return speed_; }

  /// Begins again where it has come to its end.
  void play();
  void pause() { playing_ = false; }
  void set_speed(double speed) { speed_ = speed; }

  /// Goes to a scan; past the ends, to them.
  void seek(std::int64_t position);

  /// `passed_s` of the wall clock have passed; stops at the ends.
  void advance(double passed_s);

 private:
  std::vector<std::int64_t> t_ns_;
  std::size_t position_ = 0;
  double now_s_ = 0.0;  // since the first scan
  double speed_ = 1.0;
  bool playing_ = false;
};

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
