#include "kicking/random/draws.hpp"

#include <bit>
#include <cmath>

namespace trivela::kicking {
namespace {

double unit_interval(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

double unit_interval(std::uint32_t word) { return static_cast<double>(word) * 0x1p-32; }

/// The layers of equal area under exp(-x^2 / 2). Source: Marsaglia and Tsang, "The ziggurat method for generating
/// random variables" (2000), with the layer and the magnitude taken from different bits (Doornik 2005).
struct Ziggurat {
  static constexpr std::size_t kLayers = 128;
  static constexpr double kTail = 3.442619855899;
  static constexpr double kArea = 9.91256303526217e-3;

  std::array<double, kLayers + 1> x{};  // width of each layer; the first one stands for the base with its tail
  std::array<double, kLayers + 1> f{};  // exp(-x^2 / 2)

  Ziggurat() {
    x[1] = kTail;
    f[1] = std::exp(-0.5 * kTail * kTail);
    x[0] = kArea / f[1];
    for (std::size_t i = 2; i < kLayers; ++i) {
      f[i] = f[i - 1] + kArea / x[i - 1];
      x[i] = std::sqrt(-2.0 * std::log(f[i]));
    }
    f[kLayers] = 1.0;
  }
};

const Ziggurat kZiggurat;

/// A point under one layer: its number, its distance from the middle and its side from different bits of one word.
struct Candidate {
  explicit Candidate(std::uint32_t word)
      : layer(word % Ziggurat::kLayers),
        magnitude((static_cast<double>(word >> 8) + 0.5) * 0x1p-24 * kZiggurat.x[layer]),
        side(std::uint64_t{word & 0x80U} << 56) {}

  double value() const { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | side); }

  std::size_t layer;
  double magnitude;
  std::uint64_t side;  // the sign's bit of a double
};

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

std::array<double, 4> Draws::uniforms(Role role, std::uint32_t counter, std::uint32_t index) const {
  const auto words = block(role, counter, index);
  return {unit_interval(words[0]), unit_interval(words[1]), unit_interval(words[2]), unit_interval(words[3])};
}

inline double Draws::normal_of(std::uint32_t word, Role role, std::uint32_t counter, std::uint32_t index,
                               std::uint32_t lane) const {
  const Candidate candidate{word};
  if (candidate.magnitude < kZiggurat.x[candidate.layer + 1]) return candidate.value();  // 98.8 of 100
  return rare_normal(word, role, counter, index, lane);
}

std::array<double, 4> Draws::normals(Role role, std::uint32_t counter, std::uint32_t index) const {
  const auto words = block(role, counter, index);
  return {normal_of(words[0], role, counter, index, 0), normal_of(words[1], role, counter, index, 1),
          normal_of(words[2], role, counter, index, 2), normal_of(words[3], role, counter, index, 3)};
}

double Draws::rare_normal(std::uint32_t word, Role role, std::uint32_t counter, std::uint32_t index,
                          std::uint32_t lane) const {
  const auto& [x, f] = kZiggurat;
  Candidate candidate{word};
  for (std::uint32_t attempt = 0;; ++attempt) {
    // A block of its own for each further attempt of each lane.
    const auto more = block(role, counter, 0x80000000U | lane << 28 | attempt << 16 | index);
    if (candidate.layer == 0) {
      const double beyond = -std::log(1.0 - unit_interval(more[0])) / Ziggurat::kTail;
      if (-2.0 * std::log(1.0 - unit_interval(more[1])) <= beyond * beyond) continue;
      candidate.magnitude = Ziggurat::kTail + beyond;
      return candidate.value();
    }
    const double height = std::lerp(f[candidate.layer], f[candidate.layer + 1], unit_interval(more[0]));
    if (height < std::exp(-0.5 * candidate.magnitude * candidate.magnitude)) return candidate.value();
    candidate = Candidate{more[2]};
    if (candidate.magnitude < x[candidate.layer + 1]) return candidate.value();
  }
}

double Draws::normal(Role role, std::uint32_t counter, std::uint32_t index) const {
  return normal_of(block(role, counter, index)[0], role, counter, index, 0);
}

}  // namespace trivela::kicking
