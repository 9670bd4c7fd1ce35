#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bus/census.hpp"
#include "bus/domain/participant.hpp"
#include "monitor/subscriber.hpp"
#include "pages/monitor/match_scene.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::pages {

/// What the page follows: the pitch some 25 times a second, all else where it changed.
enum MatchChannel : std::size_t { kPitch, kMatch };
inline std::vector<std::string> match_channels() { return {"pitch", "match"}; }

/// Listens to a domain and shows it. It has readers that nobody waits for and no writer: nothing of it can order
/// anything.
class MatchFeed {
 public:
  /// Joins. `lockstep`: t_ns are no clock's, and silence of the bus is no fault. The broadcast must outlive it. Throws
  /// bus::Error.
  MatchFeed(const bus::DomainConfig& domain, bool lockstep, SceneSettings settings, Broadcast& broadcast);
  ~MatchFeed();

  /// The match has ended as planned.
  void note_over();

 private:
  void publish();
  void take_census();

  std::mutex mutex_;  // of the scene: samples come on the bus's threads
  MatchScene scene_;
  Broadcast& broadcast_;
  bus::Participant participant_;
  bus::CensusTaker census_;
  std::vector<std::unique_ptr<monitor::PassiveSubscriber>> subscribers_;
  std::mutex leaving_mutex_;
  std::condition_variable left_;
  bool leaving_ = false;
  std::thread thread_;  // last: everything that it uses exists
};

/// The page of `trivela monitor` and `trivela match --watch`: files and events, no command. `token`: needed for
/// everything; empty: for nothing.
Page monitor_page(std::string token = "");

}  // namespace trivela::pages
