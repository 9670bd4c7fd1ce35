#include "monitor/bus_picture.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tuple>
#include <utility>

namespace trivela::monitor {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream in{path};
  return {std::istreambuf_iterator<char>{in}, {}};
}

}  // namespace

std::optional<ProcessReading> parse_process(std::string_view stat, std::string_view statm, double ticks_per_s,
                                            std::int64_t page_bytes) {
  // The name stands in parentheses and may have any characters, parentheses too.
  const auto end_of_name = stat.rfind(')');
  if (end_of_name == std::string_view::npos) return std::nullopt;
  std::istringstream fields{std::string{stat.substr(end_of_name + 1)}};
  std::string state;
  fields >> state;
  if (state == "Z" || state == "X") return std::nullopt;
  constexpr int kBetweenStateAndTimes = 10;  // proc(5): state is field 3, utime 14, stime 15
  std::string passed_over;
  for (int i = 0; i < kBetweenStateAndTimes; ++i) fields >> passed_over;
  double user_ticks = 0.0, system_ticks = 0.0;
  fields >> user_ticks >> system_ticks;
  std::istringstream pages{std::string{statm}};
  std::int64_t size = 0, resident = 0;
  pages >> size >> resident;
  if (!fields || !pages) return std::nullopt;
  return ProcessReading{resident * page_bytes, (user_ticks + system_ticks) / ticks_per_s};
}

std::optional<ProcessReading> read_process(std::int64_t pid) {
  if (pid <= 0) return std::nullopt;
  return parse_process(text_of(fmt::format("/proc/{}/stat", pid)), text_of(fmt::format("/proc/{}/statm", pid)),
                       static_cast<double>(sysconf(_SC_CLK_TCK)), sysconf(_SC_PAGESIZE));
}

std::optional<ProcessLoad> ProcessLoads::look(std::int64_t pid, const std::optional<ProcessReading>& reading,
                                              Clock::time_point now) {
  if (!reading) {
    before_.erase(pid);
    return std::nullopt;
  }
  ProcessLoad load{reading->memory_bytes, std::nullopt};
  const auto before = before_.find(pid);
  if (before != before_.end() && now > before->second.at && reading->cpu_s >= before->second.cpu_s) {
    const double passed_s = std::chrono::duration<double>(now - before->second.at).count();
    load.cpu_percent = 100.0 * (reading->cpu_s - before->second.cpu_s) / passed_s;
  }
  before_[pid] = {reading->cpu_s, now};
  return load;
}

namespace {

constexpr std::size_t kMostGone = 8;  // of a topic, that are still named
constexpr std::size_t kMostRobots = 32;

WriterPicture picture_of(const bus::End& writer) {
  return {writer.owner.empty() ? node_of(writer.member.process) : writer.owner, writer.member.host, writer.member.pid,
          writer.strength, WriterState::kThere};
}

// Each process once: it may have several, such as the one before the last that was made again.
std::vector<std::string> readers_of(const std::string& topic, const bus::Census& census) {
  std::vector<std::string> names;
  std::vector<bus::Member> known;
  for (const bus::End& reader : census.readers) {
    if (reader.topic != topic || reader.observer || std::ranges::find(known, reader.member) != known.end()) continue;
    known.push_back(reader.member);
    names.push_back(node_of(reader.member.process));
  }
  return names;
}

bool is_same(const WriterPicture& a, const WriterPicture& b) {
  return std::tie(a.owner, a.host, a.pid) == std::tie(b.owner, b.host, b.pid);
}

}  // namespace

std::string node_of(const std::string& process) {
  constexpr std::string_view kPrefix = "trivela-";
  return process.starts_with(kPrefix) ? process.substr(kPrefix.size()) : process;
}

void BusSnapshot::add(const std::string& topic, const std::string& profile, double period_s) {
  Topic& added = topics_.emplace_back();
  added.about.topic = topic;
  added.about.profile = profile;
  added.about.period_s = period_s;
}

void BusSnapshot::receive(const std::string& topic, std::uint8_t robot_id, const ReceivedSample& received_sample) {
  if (only_ && robot_id != *only_) return;
  const auto found = std::ranges::find_if(topics_, [&](const Topic& known) { return known.about.topic == topic; });
  if (found == topics_.end()) return;
  auto stream = found->robots.find(robot_id);
  if (stream == found->robots.end()) {
    if (found->robots.size() >= kMostRobots) return;  // anybody may say any number
    stream = found->robots.emplace(robot_id, StreamStatistics{found->about.period_s}).first;
  }
  stream->second.see(robot_id, received_sample);
}

// A writer that names no robot may write for any.
bool BusSnapshot::is_looked_at(const std::string& owner) const {
  const auto slash = owner.rfind('/');
  return !only_ || slash == std::string::npos || owner.substr(slash + 1) == std::to_string(*only_);
}

void BusSnapshot::look_at_writers(Topic& topic, const bus::Census& census, const Loads& loads) const {
  std::vector<WriterPicture> now;
  for (const bus::End& end : census.writers) {
    if (end.topic != topic.about.topic || !is_looked_at(end.owner)) continue;
    WriterPicture writer = picture_of(end);
    // The domain forgets one that was killed as late as its lease ends; the kernel at once.
    const auto load = loads.find(writer.pid);
    if (writer.host == host_ && load != loads.end() && !load->second) writer.state = WriterState::kStopped;
    now.push_back(std::move(writer));
  }
  std::vector<WriterPicture> gone;
  for (WriterPicture& known : topic.known) {
    if (std::ranges::any_of(now, [&](const auto& writer) { return is_same(writer, known); })) continue;
    known.state = WriterState::kStopped;
    gone.push_back(std::move(known));
  }
  if (gone.size() > kMostGone) gone.erase(gone.begin(), gone.end() - kMostGone);
  now.insert(now.end(), gone.begin(), gone.end());
  topic.known = std::move(now);
}

BusPicture BusSnapshot::look(const bus::Census& census, std::int64_t now_ns,
                             const std::function<std::optional<ProcessReading>(std::int64_t pid)>& reading_of) {
  BusPicture picture;
  Loads loads;
  const auto now = std::chrono::steady_clock::time_point{std::chrono::nanoseconds{now_ns}};
  for (const bus::Member& member : census.members) {
    ProcessPicture process{node_of(member.process), member.host, member.pid, std::nullopt};
    if (member.host == host_ && member.pid > 0) {
      if (!loads.contains(member.pid)) loads[member.pid] = loads_.look(member.pid, reading_of(member.pid), now);
      process.load = loads[member.pid];
    }
    picture.processes.push_back(std::move(process));
  }
  for (Topic& topic : topics_) {
    look_at_writers(topic, census, loads);
    TopicPicture& about = picture.topics.emplace_back(topic.about);
    about.writers = topic.known;
    about.readers = readers_of(about.topic, census);
    for (const auto& [robot_id, stream] : topic.robots) about.robots.emplace(robot_id, stream.figures(now_ns));
  }
  return picture;
}

}  // namespace trivela::monitor
