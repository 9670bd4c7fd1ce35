#include "emulators/scip/emulated_scanner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hal/scip/reply.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::uint32_t kLargest = (1U << 18U) - 1;
constexpr std::uint32_t kNoReturn = 1;  // an error code

std::optional<int> number_of(std::string_view digits) {
  int number = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return std::nullopt;
    number = 10 * number + (digit - '0');
  }
  return number;
}

// The nearest of the returns; an error code where there is none.
std::uint32_t nearest(std::span<const std::uint32_t> values) {
  std::uint32_t result = values.front();
  for (const std::uint32_t value : values) {
    const bool returned = value >= kicking::lob::kFirstRange_mm;
    if (returned && (result < kicking::lob::kFirstRange_mm || value < result)) result = value;
  }
  return std::min(result, kLargest);
}

}  // namespace

Parameters parameters_for(const kicking::lob::ScanGeometry& geometry, int first_step, const std::string& model) {
  Parameters p;
  p.model = model;
  p.min_range_mm = static_cast<int>(std::lround(geometry.min_range_m * 1e3));
  p.max_range_mm = static_cast<int>(std::lround(geometry.max_range_m * 1e3));
  p.steps_per_turn = static_cast<int>(std::lround(2.0 * std::numbers::pi / geometry.step_rad));
  p.first_step = first_step;
  p.last_step = first_step + static_cast<int>(geometry.beams) - 1;
  p.front_step = first_step + static_cast<int>(std::lround(-geometry.first_angle_rad / geometry.step_rad));
  p.speed_rpm = static_cast<int>(std::lround(60.0 / geometry.scan_period_s));
  if (first_step < 0 || p.last_step > kLastStep || geometry.beams == 0 || p.front_step < 0 || p.speed_rpm < 1) {
    throw std::runtime_error{fmt::format(
        "SCIP emulator: {} beams from {} rad in steps of {} rad every {} s: no SCIP scanner has such a geometry",
        geometry.beams, geometry.first_angle_rad, geometry.step_rad, geometry.scan_period_s)};
  }
  return p;
}

std::string text_line(std::string_view key, std::string_view value) {
  const std::string content = fmt::format("{}:{}", key, value);
  return content + ';' + checksum(content) + '\n';
}

std::string status_line(std::string_view status) { return std::string{status} + checksum(status) + '\n'; }

std::string plain_reply(std::string_view echo, std::string_view status, std::string_view lines) {
  return fmt::format("{}\n{}{}\n", echo, status_line(status), lines);
}

std::string scan_reply(std::string_view echo, std::string_view status, std::uint32_t stamp_ms, std::string_view data) {
  std::string text = fmt::format("{}\n{}{}", echo, status_line(status), status_line(encode(stamp_ms, 4)));
  for (std::size_t at = 0; at < data.size(); at += kBlock) text += status_line(data.substr(at, kBlock));
  return text + '\n';
}

std::string EmulatedScanner::answer(std::string_view request) {
  const std::string_view command = request.substr(0, request.find(';'));
  if (command == kVV) return plain_reply(request, "00", identity());
  if (command == kPP) return plain_reply(request, "00", parameters());
  if (command == kII) return plain_reply(request, "00", state());
  if (command == kScip20) return plain_reply(request, "0E");  // as one that speaks nothing else
  if (command == kBM) return plain_reply(request, std::exchange(laser_on_, true) ? "02" : "00");
  if (command == kQT || command == kRS) {
    stop();
    reset_ = reset_ || command == kRS;
    return plain_reply(request, "00");
  }
  if (command.starts_with("MD") || command.starts_with("GD")) {
    return order(request, command.substr(2), request.substr(command.size()));
  }
  return plain_reply(request, "0E");
}

std::string EmulatedScanner::order(std::string_view request, std::string_view numbers, std::string_view tail) {
  const bool single = request.starts_with("GD");
  if (numbers.size() != (single ? 10 : 13)) return plain_reply(request, "0C");
  constexpr std::array<std::pair<std::size_t, std::size_t>, 5> kFields{{{0, 4}, {4, 4}, {8, 2}, {10, 1}, {11, 2}}};
  constexpr std::array kRefusals{"01", "02", "03", "06", "07"};
  std::array<int, kFields.size()> values{};
  for (std::size_t i = 0; i < (single ? 3 : kFields.size()); ++i) {
    const auto value = number_of(numbers.substr(kFields[i].first, kFields[i].second));
    if (!value) return plain_reply(request, kRefusals[i]);
    values[i] = *value;
  }
  const auto [first, last, cluster, skipped, scans] = values;
  if (first < parameters_.first_step || last > parameters_.last_step) return plain_reply(request, "04");
  if (last < first) return plain_reply(request, "05");
  if (single && !laser_on_) return plain_reply(request, "10");
  const std::string_view echo = single ? request : request.substr(0, kMeasureEchoStays);
  order_ = Order{std::string{echo}, std::string{single ? "" : tail}, {first, last, cluster}, single, skipped, 0, scans};
  laser_on_ = true;
  return single ? "" : plain_reply(request, "00");
}

std::string EmulatedScanner::next_scan(std::span<const std::uint32_t> range_mm, std::uint32_t stamp_ms) {
  if (!order_) return {};
  Order& order = *order_;
  if (order.to_skip > 0) {
    --order.to_skip;
    return {};
  }
  std::vector<std::uint32_t> section(static_cast<std::size_t>(order.section.last_step - order.section.first_step) + 1);
  const auto start = static_cast<std::size_t>(order.section.first_step - parameters_.first_step);
  for (std::size_t i = 0; i < section.size(); ++i) {
    section[i] = start + i < range_mm.size() ? range_mm[start + i] : kNoReturn;
  }
  const auto cluster = static_cast<std::size_t>(std::max(order.section.cluster, 1));
  std::string data;
  for (std::size_t i = 0; i / cluster < beams(order.section); i += cluster) {
    const std::size_t width = std::min(cluster, section.size() - i);
    data += encode(nearest(std::span{section}.subspan(i, width)), 3);
  }
  const bool last = order.single || order.remaining == 1;
  const int left = order.remaining > 0 ? --order.remaining : 0;
  order.to_skip = order.skipped;
  const std::string echo = order.single ? order.echo : fmt::format("{}{:02}{}", order.echo, left, order.tail);
  std::string text = scan_reply(echo, order.single ? "00" : "99", stamp_ms, data);
  if (last) {
    laser_on_ = order.single;  // an MD that is through switches it off
    order_.reset();
  }
  return text;
}

void EmulatedScanner::stop() {
  order_.reset();
  laser_on_ = false;
}

std::string EmulatedScanner::identity() const {
  return text_line("VEND", identity_.vendor) + text_line("PROD", identity_.product) +
         text_line("FIRM", identity_.firmware) + text_line("PROT", identity_.protocol) +
         text_line("SERI", identity_.serial);
}

std::string EmulatedScanner::parameters() const {
  const auto number = [](std::string_view key, int value) { return text_line(key, std::to_string(value)); };
  return text_line("MODL", parameters_.model) + number("DMIN", parameters_.min_range_mm) +
         number("DMAX", parameters_.max_range_mm) + number("ARES", parameters_.steps_per_turn) +
         number("AMIN", parameters_.first_step) + number("AMAX", parameters_.last_step) +
         number("AFRT", parameters_.front_step) + number("SCAN", parameters_.speed_rpm);
}

std::string EmulatedScanner::state() const {
  return text_line("MODL", parameters_.model) + text_line("LASR", laser_on_ ? "ON" : "OFF") +
         text_line("SCSP", std::to_string(parameters_.speed_rpm)) + text_line("MESM", order_ ? "Measuring" : "Idle") +
         text_line("STAT", "sensor is working normally");
}

}  // namespace trivela::hal::scip
