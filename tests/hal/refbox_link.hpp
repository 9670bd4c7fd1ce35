#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "emulators/refbox/emulated_box.hpp"
#include "hal/line/descriptor.hpp"
#include "hal/refbox/refbox_client.hpp"

namespace trivela::tests {

/// For anything to happen at all.
inline constexpr std::chrono::seconds kBoxTimeout{20};
inline constexpr std::chrono::milliseconds kAckTimeout{400};
inline constexpr const char* kWorldstate =
    R"({"type":"worldstate","teamName":"t","intention":"i","ageMs":0,"robots":[],"balls":[],"obstacles":[]})";

/// An emulated box and the real client on it.
class BoxLink {
 public:
  using Clock = std::chrono::steady_clock;

  explicit BoxLink(const hal::refbox::BoxConfig& config = {})
      : box(config),
        client(hal::refbox::refbox_client("127.0.0.1", box.port(), {config.protocol, config.groups[0], {}},
                                          kAckTimeout)) {}

  /// The next event of this kind; words of the log in between are left out, anything else is a failure.
  template <class T>
  std::optional<T> next() {
    const auto end = Clock::now() + kBoxTimeout;
    while (Clock::now() < end) {
      const auto event = client->next(std::chrono::milliseconds{50});
      if (!event) continue;
      if (const auto* const wanted = std::get_if<T>(&*event)) return *wanted;
      if (std::holds_alternative<hal::refbox::NoCommand>(*event)) continue;
      ADD_FAILURE() << "an event of kind " << event->index() << " came first";
      return std::nullopt;
    }
    ADD_FAILURE() << "nothing came";
    return std::nullopt;
  }

  /// The next command's kind.
  hal::refbox::CommandKind command() {
    const auto next_command = next<hal::refbox::Command>();
    return next_command ? next_command->kind : hal::refbox::CommandKind::kIsAlive;
  }

  void meet() {
    next<hal::refbox::Connected>();
    EXPECT_EQ(command(), hal::refbox::CommandKind::kWelcome);
  }

  void say(hal::refbox::CommandKind kind, std::optional<std::size_t> team = {}) {
    box.act(hal::refbox::BoxCommand{.kind = kind, .team = team});
  }

  hal::refbox::EmulatedBox box;
  std::unique_ptr<hal::refbox::RefboxClient> client;
};

/// A connection to the box from an address of the loopback network.
inline hal::Descriptor connect_from(const char* address, std::uint16_t port) {
  hal::Descriptor socket{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  sockaddr_in own{};
  own.sin_family = AF_INET;
  ::inet_pton(AF_INET, address, &own.sin_addr);
  EXPECT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own), 0) << address;
  sockaddr_in box{};
  box.sin_family = AF_INET;
  box.sin_port = htons(port);
  box.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(socket.get(), reinterpret_cast<const sockaddr*>(&box), sizeof box), 0) << address;
  return socket;
}

/// What comes until the other side closes, or until so many bytes are there.
inline std::string read_all(const hal::Descriptor& socket, std::size_t most_bytes = 1U << 20) {
  std::string all, why;
  std::array<char, 4096> bytes;
  while (all.size() < most_bytes) {
    const auto count = socket.read(bytes, BoxLink::Clock::now() + kBoxTimeout, why);
    if (!count || *count == 0) return all;
    all.append(bytes.data(), *count);
  }
  return all;
}

}  // namespace trivela::tests
