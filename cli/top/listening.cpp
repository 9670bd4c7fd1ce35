#include "cli/top/live_bus.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <string_view>

#include "idl/messages.hpp"

namespace trivela::cli {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

const char* profile_text(bus::Profile profile) {
  switch (profile) {
    case bus::Profile::kState:
      return "state";
    case bus::Profile::kOrder:
      return "order";
    case bus::Profile::kEvent:
      return "event";
  }
  return "";
}

std::int64_t steady_ns() {
  return std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

std::int64_t real_ns() { return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count(); }

}  // namespace

Listening::Listening(const bus::DomainConfig& domain, std::optional<std::uint8_t> only)
    : participant_(domain), census_(participant_), board_(host_name(), only) {
  bus::for_each_message([this]<class T>() {
    board_.add(std::string{bus::meta<T>::topic}, profile_text(bus::meta<T>::profile), bus::meta<T>::period_s);
  });
  // On a secured bus what the simulator says of itself is nobody's to see (security/rights.hpp).
  const bool secured = domain.xml.find("<Security>") != std::string::npos;
  bus::for_each_message([this, secured]<class T>() {
    if (secured && std::string_view{bus::meta<T>::topic}.starts_with("sim/")) return;
    ears_.push_back(
        std::make_unique<monitor::StreamSubscriber<T>>(participant_, [this](const T& sample, const auto& info) {
          monitor::Heard heard{.writer = info.writer,
                               .seq = {},
                               .t_ns = sample.t_ns,
                               .source_ns = info.source_t_ns,
                               .received_ns = steady_ns(),
                               .received_real_ns = real_ns()};
          if constexpr (requires { sample.seq; }) heard.seq = sample.seq;
          hear(std::string{bus::meta<T>::topic}, sample.robot_id, heard);
        }));
  });
}

Listening::~Listening() = default;

void Listening::hear(const std::string& topic, std::uint8_t robot_id, const monitor::Heard& heard) {
  const std::lock_guard lock{mutex_};
  board_.hear(topic, robot_id, heard);
}

monitor::BusPicture Listening::look() {
  const bus::Census census = census_.take();
  const std::lock_guard lock{mutex_};
  return board_.look(census, steady_ns(), monitor::read_process);
}

}  // namespace trivela::cli
