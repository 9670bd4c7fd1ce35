#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/census.hpp"
#include "monitor/stream_statistics.hpp"

namespace trivela::monitor {

/// What the kernel says of a process at one moment.
struct ProcessReading {
  std::int64_t memory_bytes = 0;  ///< resident
  double cpu_s = 0.0;             ///< used since it began, user and system
};

/// Of the texts of /proc/PID/stat and /proc/PID/statm; none: they are something else, or of a process that has ended.
std::optional<ProcessReading> parse_process(std::string_view stat, std::string_view statm, double ticks_per_s,
                                            std::int64_t page_bytes);

/// Of a process on this machine; none: there is none of that id.
std::optional<ProcessReading> read_process(std::int64_t pid);

/// What a process takes.
struct ProcessLoad {
  std::int64_t memory_bytes = 0;
  std::optional<double> cpu_percent;  ///< of one core since the look before; none at the first
};

/// Memory and processor time of processes, look by look.
class ProcessLoads {
 public:
  using Clock = std::chrono::steady_clock;

  /// None: there is no such process, or no longer.
  std::optional<ProcessLoad> look(std::int64_t pid, const std::optional<ProcessReading>& reading,
                                  Clock::time_point now);

 private:
  struct Before {
    double cpu_s;
    Clock::time_point at;
  };
  std::map<std::int64_t, Before> before_;
};

/// What has become of a writer.
enum class WriterState {
  kThere,
  kStopped,  ///< its process ended in order or was killed: it is not in the domain or not on this machine any more
};

/// A writer of a topic.
struct WriterPicture {
  std::string owner;  ///< "kick_decision/1"; its program where it does not say
  std::string host;
  std::int64_t pid = 0;
  std::int32_t strength = 0;
  WriterState state = WriterState::kThere;

  bool operator==(const WriterPicture&) const = default;
};

/// A topic with everybody on it.
struct TopicPicture {
  std::string topic;
  std::string profile;
  double period_s = 0.0;
  std::vector<WriterPicture> writers;
  std::vector<std::string> readers;  ///< programs, without those that look on
  std::map<std::uint8_t, StreamFigures> robots;
};

/// A node's process.
struct ProcessPicture {
  std::string name;
  std::string host;
  std::int64_t pid = 0;
  std::optional<ProcessLoad> load;  ///< none: of another machine, or it has ended
};

/// The bus at one moment.
struct BusPicture {
  std::vector<TopicPicture> topics;  ///< in the order of the IDL
  std::vector<ProcessPicture> processes;
};

/// Puts together what was heard and who is there. It remembers writers that have gone, so that they can be named.
class BusSnapshot {
 public:
  /// `host`: the name of this machine, whose processes can be looked up; `only`: the robot that is looked at, if not
  /// all.
  BusSnapshot(std::string host, std::optional<std::uint8_t> only) : host_(std::move(host)), only_(only) {}

  /// A topic of the list, in its order.
  void add(const std::string& topic, const std::string& profile, double period_s);

  void receive(const std::string& topic, std::uint8_t robot_id, const ReceivedSample& received_sample);

  /// `reading_of`: what the kernel says of a process of this machine now.
  BusPicture look(const bus::Census& census, std::int64_t now_ns,
                  const std::function<std::optional<ProcessReading>(std::int64_t pid)>& reading_of);

 private:
  struct Topic {
    TopicPicture about;
    std::map<std::uint8_t, StreamStatistics> robots;
    std::vector<WriterPicture> known;
  };
  using Loads = std::map<std::int64_t, std::optional<ProcessLoad>>;

  bool is_looked_at(const std::string& owner) const;
  void look_at_writers(Topic& topic, const bus::Census& census, const Loads& loads) const;

  std::string host_;
  std::optional<std::uint8_t> only_;
  std::vector<Topic> topics_;
  ProcessLoads loads_;
};

/// A node's name out of its program's: "trivela-recorder" is "recorder".
std::string node_of(const std::string& process);

}  // namespace trivela::monitor
