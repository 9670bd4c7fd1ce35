#include "sim/random.hpp"

#include <cmath>
#include <numbers>

namespace trivela::sim {
namespace {

double unit_interval(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

std::array<std::uint32_t, 4> Draws::block(Role role, std::uint32_t counter, std::uint32_t index) const {
  return philox4x32({counter, index, static_cast<std::uint32_t>(role), opportunity_},
                    {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
}

double Draws::uniform(Role role, std::uint32_t counter, std::uint32_t index) const {
  const auto words = block(role, counter, index);
  return unit_interval(words[0], words[1]);
}

double Draws::uniform_in(double low, double high, Role role, std::uint32_t counter, std::uint32_t index) const {
  return low + (high - low) * uniform(role, counter, index);
}

std::array<double, 2> Draws::normals(Role role, std::uint32_t counter, std::uint32_t index) const {
  const auto words = block(role, counter, index);
  const double radius = std::sqrt(-2.0 * std::log(1.0 - unit_interval(words[0], words[1])));
  const double angle = 2.0 * std::numbers::pi * unit_interval(words[2], words[3]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double Draws::normal(Role role, std::uint32_t counter, std::uint32_t index) const {
  return normals(role, counter, index)[0];
}

}  // namespace trivela::sim
