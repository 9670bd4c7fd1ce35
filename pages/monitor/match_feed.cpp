#include "pages/monitor/match_feed.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <type_traits>
#include <utility>

#include "monitor/bus_picture.hpp"

namespace trivela::pages {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kFrameTime{40};
constexpr int kFramesALook = 3;     // MatchScene::kStep_ns
constexpr int kFramesAMatch = 5;    // a person reads no faster
constexpr int kFramesACensus = 25;  // discovery is as slow

std::int64_t clock_ns() { return std::chrono::nanoseconds{Clock::now().time_since_epoch()}.count(); }

// What holds until it is said otherwise, and is not repeated for who opens the page later.
template <bus::Message T>
constexpr bool is_said_once() {
  return std::is_same_v<T, msg::DeviceEmulated> || std::is_same_v<T, msg::KickerDrift> ||
         std::is_same_v<T, msg::KickerEstimate>;
}

bus::Participant join(const bus::DomainConfig& domain, bool lockstep) {
  return lockstep ? bus::Participant{domain} : bus::Participant{domain, bus::RealTime{}};
}

// What a census says of where this is played. A participant that writes the truth is a simulator.
std::set<std::string> simulated_by(const bus::Census& census) {
  std::set<std::string> said;
  for (const bus::End& writer : census.writers) {
    if (writer.topic == bus::meta<msg::KickTruth>::topic || writer.topic == bus::meta<msg::PossessionTruth>::topic)
      said.insert("a simulator");
  }
  return said;
}

}  // namespace

MatchFeed::MatchFeed(const bus::DomainConfig& domain, bool lockstep, SceneSettings settings, Broadcast& broadcast)
    : scene_(std::move(settings)), broadcast_(broadcast), participant_(join(domain, lockstep)), census_(participant_) {
  bus::for_each_message([this]<class T>() {
    if constexpr (MatchScene::listens_to<T>()) {
      const auto receive = [this](const T& sample, const bus::SampleInfo& info) {
        const std::lock_guard lock{mutex_};
        scene_.receive(sample, info.writer, clock_ns());
      };
      subscribers_.push_back(std::make_unique<monitor::StreamSubscriber<T>>(participant_, receive, is_said_once<T>()));
    }
  });
  thread_ = std::thread([this] { publish(); });
}

MatchFeed::~MatchFeed() {
  {
    const std::lock_guard lock{leaving_mutex_};
    leaving_ = true;
  }
  left_.notify_all();
  thread_.join();
}

void MatchFeed::note_over() {
  const std::lock_guard lock{mutex_};
  scene_.note_over();
}

void MatchFeed::take_census() {
  const bus::Census census = census_.take();
  std::vector<std::string> nodes;
  for (const bus::Member& member : census.members) nodes.push_back(monitor::node_of(member.process));
  std::ranges::sort(nodes);
  {
    const std::lock_guard lock{mutex_};
    scene_.note_members(std::move(nodes), simulated_by(census));
  }
  for (const auto& subscriber : subscribers_) subscriber->keep_hearing();
}

void MatchFeed::publish() {
  std::string shown;
  auto next = Clock::now();
  for (int frame = 0;; ++frame) {
    if (frame % kFramesACensus == 0) take_census();
    std::string match;
    {
      const std::lock_guard lock{mutex_};
      const std::int64_t now_ns = clock_ns();
      if (frame % kFramesALook == 0) scene_.look(now_ns);
      if (frame % kFramesAMatch == 0) match = match_json(scene_.state(), now_ns);
      broadcast_.publish(kPitch, pitch_json(scene_.state(), now_ns));
    }
    if (!match.empty() && match != shown) broadcast_.publish(kMatch, shown = std::move(match));
    next = std::max(next + kFrameTime, Clock::now());
    std::unique_lock lock{leaving_mutex_};
    if (left_.wait_until(lock, next, [this] { return leaving_; })) return;
  }
}

}  // namespace trivela::pages
