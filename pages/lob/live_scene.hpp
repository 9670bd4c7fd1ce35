#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hal/range_finder.hpp"
#include "log/write/scan_log.hpp"
#include "pages/lob/lob_page.hpp"
#include "pages/lob/lob_session.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::pages {

struct LiveOptions {
  std::string device;
  std::filesystem::path record;  ///< must not exist; made when the scanner is there
  kicking::lob::LaserMount mount;
  kicking::lob::AnalyzerConfig analyzer;
  CalibrationPlan plan;
};

/// A scanner, recorded while it is shown. Kicks are first of the plan's first power; after an accepted lob the power
/// goes on along the plan. Commands: `verdict` {"lob", "accepted", "why"}, `set-point` {"power"}, `background` {}:
/// learn it again.
class LiveScene : public Scene {
 public:
  LiveScene(std::unique_ptr<hal::RangeFinder> finder, LiveOptions options, Broadcast& broadcast);

  /// Ends the record.
  ~LiveScene() override;

  nlohmann::json state() const override;
  std::string frame(std::size_t i) override;
  std::string table_csv() const override;
  void command(const std::string& name, const nlohmann::json& arguments) override;
  void finish() override;
  void check() const override;

 private:
  void run();
  void begin();
  void take(const kicking::lob::Scan& scan);
  void set_power(std::optional<double> power);
  void judge(const nlohmann::json& arguments);
  void look_at_link();
  nlohmann::json status() const;
  nlohmann::json lobs() const;
  std::int64_t start_t_ns() const { return views_.empty() ? 0 : views_.front().t_ns; }

  const std::unique_ptr<hal::RangeFinder> finder_;  // of the thread alone
  const LiveOptions options_;
  Broadcast& broadcast_;
  std::atomic<bool> stopping_ = false;
  mutable std::mutex mutex_;  // of all below
  nlohmann::json setup_;
  nlohmann::json link_;
  std::unique_ptr<log::ScanWriter> writer_;
  std::optional<kicking::lob::Analyzer> analyzer_;
  std::vector<SceneView> views_;  // one for each scan in the record
  LobSession lob_session_;
  std::optional<double> power_;
  std::uint64_t refused_ = 0;  // scans that were not recorded
  double max_range_m_ = 0.0;
  std::exception_ptr failure_;
  std::mutex back_mutex_;                // of the next
  std::optional<log::ScanReader> back_;  // for looking back
  std::thread thread_;                   // last: everything that it uses exists
};

}  // namespace trivela::pages
