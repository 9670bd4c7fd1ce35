#include "emulators/scip/emulated_faults.hpp"

#include "emulators/scip/emulated_scanner.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::size_t kTorn = 20;  // bytes before a line's end, and as many after

bool count_down(int& left) { return left > 0 && left-- > 0; }

std::size_t line_end_in_the_middle(const std::string& reply) { return reply.find('\n', reply.size() / 2); }

}  // namespace

std::string EmulatedFaults::refusal(std::string_view echo) {
  return count_down(statuses) ? plain_reply(echo, status) : std::string{};
}

std::string EmulatedFaults::spoil(std::string reply) {
  if (count_down(scans_to_skip)) return {};
  if (std::string instead = refusal(reply.substr(0, reply.find('\n'))); !instead.empty()) return instead;
  if (count_down(sums_to_corrupt)) {
    char& sum = reply[line_end_in_the_middle(reply) - 1];
    sum = sum == '0' ? '1' : '0';
  }
  if (count_down(lines_to_tear)) {
    const std::size_t end = line_end_in_the_middle(reply);
    reply.erase(end > kTorn ? end - kTorn : 0, 2 * kTorn);
  }
  return reply;
}

}  // namespace trivela::hal::scip
