#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulators/scip/emulator.hpp"

namespace trivela::tests {

/// An emulated scanner that does wrong what it is told to. A number counts down as it is done.
class FaultyScanner : public hal::scip::EmulatedRangeFinder {
 public:
  using EmulatedRangeFinder::EmulatedRangeFinder;

  bool silent = false;
  int sums_to_corrupt = 0;  ///< of a scan each
  int lines_to_tear = 0;    ///< a scan each loses some bytes of its middle, a line's end among them
  int scans_to_skip = 0;    ///< measured and not sent
  int statuses = 0;         ///< replies, scans among them, that are `status` alone
  std::string status;
  std::uint64_t scans_sent = 0;  ///< damaged ones among them

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override {
    if (silent) return {};
    auto said = EmulatedRangeFinder::take(bytes, now_ns);
    for (std::string& reply : said) refuse(reply);
    return said;
  }

  std::vector<std::string> tick(std::int64_t now_ns) override {
    auto said = EmulatedRangeFinder::tick(now_ns);
    if (silent || said.empty() || count_down(scans_to_skip)) return {};
    ++scans_sent;
    if (!refuse(said.front())) damage(said.front());
    return said;
  }

 private:
  static bool count_down(int& left) { return left > 0 && left-- > 0; }

  bool refuse(std::string& reply) {
    if (!count_down(statuses)) return false;
    reply = hal::scip::plain_reply(reply.substr(0, reply.find('\n')), status);
    return true;
  }

  void damage(std::string& reply) {
    constexpr std::size_t kTorn = 20;  // bytes before a line's end, and as many after
    const std::size_t end = reply.find('\n', reply.size() / 2);
    if (count_down(sums_to_corrupt)) reply[end - 1] = reply[end - 1] == '0' ? '1' : '0';
    if (count_down(lines_to_tear)) reply.erase(end > kTorn ? end - kTorn : 0, 2 * kTorn);
  }
};

/// Such a scanner with its line.
class FaultyEmulator : public hal::Emulator<FaultyScanner> {
 public:
  using hal::Emulator<FaultyScanner>::Emulator;

  template <class Fault>
  void set(Fault FaultyScanner::*fault, const Fault& value) {
    with_board([&](FaultyScanner& scanner) { scanner.*fault = value; });
  }
  bool laser_on() {
    bool on = false;
    with_board([&](FaultyScanner& scanner) { on = scanner.laser_on(); });
    return on;
  }
  std::uint64_t scans_sent() {
    std::uint64_t sent = 0;
    with_board([&](FaultyScanner& scanner) { sent = scanner.scans_sent; });
    return sent;
  }
};

}  // namespace trivela::tests
