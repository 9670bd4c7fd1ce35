#include "hal/scip/messages.hpp"

#include <charconv>
#include <cstdio>
#include <numbers>

namespace trivela::hal::scip {
namespace {

constexpr int kLongestRange_mm = (1 << 18) - 1;
constexpr std::size_t kRangeCharacters = 3;

// The value of "KEY:value", without the blanks before it.
std::optional<std::string> value_of(const Reply& reply, std::string_view key) {
  for (const std::string& line : reply.lines) {
    if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ':') continue;
    const std::size_t start = line.find_first_not_of(' ', key.size() + 1);
    return start == std::string::npos ? std::string{} : line.substr(start);
  }
  return std::nullopt;
}

bool read_number(const Reply& reply, std::string_view key, int least, int most, int& number) {
  const auto text = value_of(reply, key);
  if (!text) return false;
  const char* end = text->data() + text->size();
  const auto [stop, error] = std::from_chars(text->data(), end, number);
  return error == std::errc{} && stop == end && number >= least && number <= most;
}

bool answers(const Reply& reply, std::string_view request) { return reply.echo == request && reply.status == "00"; }

std::string numbered(const char* format, std::string_view command, int a, int b, int c) {
  char text[32];
  std::snprintf(text, sizeof text, format, a, b, c);
  return std::string{command} + text;
}

}  // namespace

std::size_t beams(const Section& section) {
  const int cluster = section.cluster > 1 ? section.cluster : 1;
  return static_cast<std::size_t>((section.last_step - section.first_step) / cluster) + 1;
}

std::string get_request(const Section& section) {
  return numbered("%04d%04d%02d", "GD", section.first_step, section.last_step, section.cluster);
}

std::string measure_request(const Section& section, int skipped, int scans) {
  const std::string start = numbered("%04d%04d%02d", "MD", section.first_step, section.last_step, section.cluster);
  return start + std::to_string(skipped) + (scans < 10 ? "0" : "") + std::to_string(scans);
}

std::optional<kicking::lob::ScannerIdentity> identity_of(const Reply& reply) {
  if (!answers(reply, kVV)) return std::nullopt;
  const auto product = value_of(reply, "PROD");
  const auto serial = value_of(reply, "SERI");
  if (!product || !serial) return std::nullopt;
  return kicking::lob::ScannerIdentity{value_of(reply, "VEND").value_or(""), *product, *serial,
                                       value_of(reply, "FIRM").value_or(""), value_of(reply, "PROT").value_or("")};
}

std::optional<Parameters> parameters_of(const Reply& reply) {
  Parameters p;
  if (!answers(reply, kPP)) return std::nullopt;
  p.model = value_of(reply, "MODL").value_or("");
  if (!read_number(reply, "DMAX", 1, kLongestRange_mm, p.max_range_mm) ||
      !read_number(reply, "DMIN", 0, p.max_range_mm - 1, p.min_range_mm) ||
      !read_number(reply, "AMAX", 0, kLastStep, p.last_step) ||
      !read_number(reply, "AMIN", 0, p.last_step, p.first_step) ||
      !read_number(reply, "ARES", p.last_step - p.first_step + 1, 100 * kLastStep, p.steps_per_turn) ||
      !read_number(reply, "AFRT", 0, kLastStep, p.front_step) || !read_number(reply, "SCAN", 300, 60000, p.speed_rpm)) {
    return std::nullopt;
  }
  return p;
}

std::optional<State> state_of(const Reply& reply) {
  if (!answers(reply, kII)) return std::nullopt;
  return State{value_of(reply, "LASR").value_or("") == "ON", value_of(reply, "MESM").value_or(""),
               value_of(reply, "STAT").value_or("")};
}

std::optional<std::vector<std::uint32_t>> ranges_of(const Reply& reply, std::size_t beams) {
  if (reply.data.size() != kRangeCharacters * beams) return std::nullopt;
  return decode_all(reply.data, kRangeCharacters);
}

Section whole_section(const Parameters& parameters) { return {parameters.first_step, parameters.last_step, 1}; }

kicking::lob::ScanGeometry geometry_of(const Parameters& p) {
  kicking::lob::ScanGeometry geometry;
  geometry.beams = beams(whole_section(p));
  geometry.step_rad = 2.0 * std::numbers::pi / p.steps_per_turn;
  geometry.first_angle_rad = (p.first_step - p.front_step) * geometry.step_rad;
  geometry.scan_period_s = 60.0 / p.speed_rpm;
  geometry.beam_period_s = geometry.scan_period_s / p.steps_per_turn;
  geometry.min_range_m = p.min_range_mm * 1e-3;
  geometry.max_range_m = p.max_range_mm * 1e-3;
  return geometry;
}

}  // namespace trivela::hal::scip
