#include "cli/top/live_bus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <string_view>

#include "idl/messages.hpp"

namespace trivela::cli {
namespace {

using monitor::BusPicture;
using monitor::StreamFigures;
using monitor::TopicPicture;
using monitor::WriterPicture;
using Json = nlohmann::ordered_json;

constexpr double kBytesPerMegabyte = 1024.0 * 1024.0;

bool is_gone(const WriterPicture& writer) { return writer.state == monitor::WriterState::kStopped; }

std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "nobody" : fmt::format("{}", fmt::join(names, ", "));
}

std::string writers_text(const TopicPicture& topic) {
  std::vector<std::string> writers;
  for (const WriterPicture& writer : topic.writers)
    writers.push_back(writer.owner + (topic.profile == "order" ? fmt::format(" strength {}", writer.strength) : "") +
                      (is_gone(writer) ? " GONE" : ""));
  return joined(writers);
}

std::string stream_line(const TopicPicture& topic, const std::string& robot, const StreamFigures& figures) {
  return fmt::format("{:<16}{:>5} {:>8.1f} {:>8.1f} {:>9} {:>9} {:>8} {:>7} {:>6}  {} -> {}\n", topic.topic, robot,
                     figures.rate_now_hz, figures.rate_hz, number(figures.latency_p50_us, 0),
                     number(figures.latency_p99_us, 0), number(figures.age_p50_ms, 2), figures.lost,
                     figures.missed_deadlines, writers_text(topic), joined(topic.readers));
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const StreamFigures& figures, int robot_id) {
  return {{"robot", robot_id},
          {"rate_hz", figures.rate_hz},
          {"rate_now_hz", figures.rate_now_hz},
          {"latency_p50_us", json_of(figures.latency_p50_us)},
          {"latency_p99_us", json_of(figures.latency_p99_us)},
          {"age_p50_ms", json_of(figures.age_p50_ms)},
          {"received", figures.received},
          {"lost", figures.lost},
          {"out_of_order", figures.out_of_order},
          {"missed_deadlines", figures.missed_deadlines},
          {"silent_for_s", json_of(figures.silent_for_s)}};
}

Json json_of(const TopicPicture& topic) {
  Json writers = Json::array(), streams = Json::array();
  for (const WriterPicture& writer : topic.writers)
    writers.push_back({{"node", writer.owner},
                       {"host", writer.host},
                       {"pid", writer.pid},
                       {"strength", writer.strength},
                       {"gone", is_gone(writer)}});
  for (const auto& [robot_id, figures] : topic.robots) streams.push_back(json_of(figures, robot_id));
  return {{"topic", topic.topic}, {"profile", topic.profile}, {"period_s", topic.period_s},
          {"writers", writers},   {"readers", topic.readers}, {"robots", streams}};
}

std::string process_line(const monitor::ProcessPicture& process) {
  const bool known = process.load.has_value();
  return fmt::format(
      "{:<16}{:>8} {:>9} {:>7}  {}\n", process.name, process.pid,
      known ? fmt::format("{:.1f}", static_cast<double>(process.load->memory_bytes) / kBytesPerMegabyte) : "-",
      known ? number(process.load->cpu_percent, 1) : "-", process.host);
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

const char* profile_text(bus::Profile profile) {
  constexpr std::array kNames{"state", "order", "event"};
  return kNames.at(static_cast<std::size_t>(profile));
}

std::int64_t steady_ns() {
  return std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

std::int64_t real_ns() { return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count(); }

}  // namespace

std::string top_table(const BusPicture& picture) {
  std::string text =
      fmt::format("{:<16}{:>5} {:>8} {:>8} {:>9} {:>9} {:>8} {:>7} {:>6}  {}\n", "topic", "robot", "Hz now", "Hz 5 s",
                  "p50 us", "p99 us", "age ms", "lost", "late", "writers -> readers");
  std::vector<std::string> quiet;
  for (const TopicPicture& topic : picture.topics) {
    for (const auto& [robot_id, figures] : topic.robots) text += stream_line(topic, std::to_string(robot_id), figures);
    if (!topic.robots.empty()) continue;
    if (topic.writers.empty()) {
      quiet.push_back(topic.topic);
    } else {
      text += stream_line(topic, "-", {});
    }
  }
  if (!quiet.empty()) text += fmt::format("nobody writes: {}\n", joined(quiet));
  text += fmt::format("\n{:<16}{:>8} {:>9} {:>7}  {}\n", "process", "pid", "memory MB", "CPU %", "host");
  for (const monitor::ProcessPicture& process : picture.processes) text += process_line(process);
  if (picture.processes.empty()) text += "nobody is in the domain\n";
  return text;
}

std::string top_json(const BusPicture& picture, unsigned domain_id) {
  Json topics = Json::array(), processes = Json::array();
  for (const TopicPicture& topic : picture.topics) topics.push_back(json_of(topic));
  for (const monitor::ProcessPicture& process : picture.processes) {
    const auto& load = process.load;
    processes.push_back({{"name", process.name},
                         {"host", process.host},
                         {"pid", process.pid},
                         {"memory_bytes", load ? Json(load->memory_bytes) : Json(nullptr)},
                         {"cpu_percent", load ? json_of(load->cpu_percent) : Json(nullptr)}});
  }
  const Json all{{"domain", domain_id}, {"topics", topics}, {"processes", processes}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Listening::Listening(const bus::DomainConfig& domain, std::optional<std::uint8_t> only)
    : participant_(domain), census_(participant_), board_(host_name(), only) {
  bus::for_each_message([this]<class T>() {
    board_.add(std::string{bus::meta<T>::topic}, profile_text(bus::meta<T>::profile), bus::meta<T>::period_s);
  });
  // On a secured bus what the simulator says of itself is nobody's to see (security/rights.hpp).
  const bool secured = domain.xml.find("<Security>") != std::string::npos;
  bus::for_each_message([this, secured]<class T>() {
    if (secured && std::string_view{bus::meta<T>::topic}.starts_with("sim/")) return;
    subscribers_.push_back(
        std::make_unique<monitor::StreamSubscriber<T>>(participant_, [this](const T& sample, const auto& info) {
          monitor::ReceivedSample received_sample{.writer = info.writer,
                                                  .seq = {},
                                                  .t_ns = sample.t_ns,
                                                  .source_ns = info.source_t_ns,
                                                  .received_ns = steady_ns(),
                                                  .received_real_ns = real_ns()};
          if constexpr (requires { sample.seq; }) received_sample.seq = sample.seq;
          receive(std::string{bus::meta<T>::topic}, sample.robot_id, received_sample);
        }));
  });
}

Listening::~Listening() = default;

void Listening::receive(const std::string& topic, std::uint8_t robot_id,
                        const monitor::ReceivedSample& received_sample) {
  const std::lock_guard lock{mutex_};
  board_.receive(topic, robot_id, received_sample);
}

monitor::BusPicture Listening::look() {
  const bus::Census census = census_.take();
  const std::lock_guard lock{mutex_};
  return board_.look(census, steady_ns(), monitor::read_process);
}

}  // namespace trivela::cli
