#include "pages/monitor/stream_status.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::pages {
namespace {

constexpr std::size_t kMostNews = 10'000;

}  // namespace

std::size_t StreamStatus::add(const std::string& topic, double period_s) {
  Stream stream{.topic = topic, .watched = std::nullopt};
  if (period_s > 0.0) {
    const double watched_s = std::max(period_s, kShortestSilence_s / static_cast<double>(robot::kSilentPeriods));
    stream.watched = watch_.add(kicking::nanoseconds(watched_s));
    stream_of_edge_.push_back(streams_.size());
  }
  streams_.push_back(std::move(stream));
  return streams_.size() - 1;
}

void StreamStatus::received(std::size_t stream, std::uint8_t robot_id, std::optional<std::uint64_t> seq,
                            std::uint64_t writer, std::int64_t now_ns) {
  Stream& received = streams_[stream];
  received.robots.insert(robot_id);
  if (received.watched) watch_.received(*received.watched, robot_id, now_ns);
  if (!seq) return;
  const auto finding = received.numbers.see(robot_id, *seq, writer, kicking::seconds(now_ns));
  const std::int64_t missed = finding.believed ? finding.gap - (finding.filled ? 1 : 0) : 0;
  if (missed == 0) return;
  missed_ += missed;
  lately_.push_back({now_ns, robot_id, stream, missed});
  while (lately_.size() > kMostNews || now_ns - lately_.front().now_ns > kNews_ns) lately_.pop_front();
}

void StreamStatus::look(std::int64_t now_ns) {
  for (const robot::SilenceEdge& edge : watch_.look(now_ns)) {
    const std::pair key{edge.robot_id, stream_of_edge_[edge.stream]};
    if (edge.to_ns) {
      silent_.erase(key);
    } else {
      silent_.insert(key);
    }
  }
}

std::set<std::uint8_t> StreamStatus::robots() const {
  std::set<std::uint8_t> robots;
  for (const Stream& stream : streams_) robots.insert(stream.robots.begin(), stream.robots.end());
  return robots;
}

std::vector<std::string> StreamStatus::silent(std::uint8_t robot_id) const {
  std::vector<std::string> topics;
  for (const auto& [robot, stream] : silent_) {
    if (robot == robot_id) topics.push_back(streams_[stream].topic);
  }
  return topics;
}

bool StreamStatus::all_silent(std::uint8_t robot_id) const {
  const auto periodic = std::ranges::count_if(
      streams_, [&](const Stream& stream) { return stream.watched && stream.robots.contains(robot_id); });
  return periodic > 0 && std::ssize(silent(robot_id)) == periodic;
}

bool StreamStatus::was_received(const std::string& topic) const {
  return std::ranges::any_of(streams_,
                             [&](const Stream& stream) { return stream.topic == topic && !stream.robots.empty(); });
}

std::map<std::pair<std::uint8_t, std::string>, std::int64_t> StreamStatus::missed_lately(std::int64_t now_ns) const {
  std::map<std::pair<std::uint8_t, std::string>, std::int64_t> missed;
  for (const Missed& one : lately_) {
    if (now_ns - one.now_ns <= kNews_ns) missed[{one.robot_id, streams_[one.stream].topic}] += one.messages;
  }
  std::erase_if(missed, [](const auto& entry) { return entry.second <= 0; });
  return missed;
}

}  // namespace trivela::pages
