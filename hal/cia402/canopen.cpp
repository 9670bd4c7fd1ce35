#include "hal/cia402/canopen.hpp"

#include <fmt/core.h>

#include <utility>

namespace trivela::hal::cia402 {
namespace {

constexpr std::uint8_t kEmergencySize = 8, kTxPdoSize = 8, kRxPdoSize = 6;

bool is_of(const can::Frame& frame, std::uint32_t function, std::uint8_t node) {
  return !frame.extended && !frame.error && frame.id == function + node;
}

}  // namespace

void put(can::Frame& frame, std::size_t begin, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) frame.data.at(begin + i) = static_cast<std::uint8_t>(value >> (8 * i) & 0xFFU);
}

std::uint32_t number_at(const can::Frame& frame, std::size_t begin, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= std::uint32_t{frame.data.at(begin + i)} << (8 * i);
  return value;
}

can::Frame nmt(Nmt command, std::uint8_t node) {
  return can::standard_frame(kNmt, {static_cast<std::uint8_t>(command), node});
}

can::Frame sync() { return can::standard_frame(kSync, {}); }

can::Frame heartbeat(std::uint8_t node, NodeState state) {
  return can::standard_frame(kHeartbeat + node, {static_cast<std::uint8_t>(state)});
}

std::optional<NodeState> heartbeat_of(const can::Frame& frame, std::uint8_t node) {
  if (!is_of(frame, kHeartbeat, node) || frame.size != 1) return std::nullopt;
  return static_cast<NodeState>(frame.data[0] & 0x7FU);  // the upper bit toggles where a node is guarded
}

can::Frame rx_pdo(std::uint8_t node, std::int32_t velocity, std::uint16_t controlword) {
  can::Frame frame{.id = kRxPdo1 + node, .extended = false, .error = false, .size = kRxPdoSize, .data = {}};
  put(frame, 0, static_cast<std::uint32_t>(velocity), 4);
  put(frame, 4, controlword, 2);
  return frame;
}

std::optional<TxPdo> tx_pdo_of(const can::Frame& frame, std::uint8_t node) {
  if (!is_of(frame, kTxPdo1, node) || frame.size != kTxPdoSize) return std::nullopt;
  return TxPdo{.velocity = static_cast<std::int32_t>(number_at(frame, 0, 4)),
               .current_ma = static_cast<std::int16_t>(number_at(frame, 4, 2)),
               .statusword = static_cast<std::uint16_t>(number_at(frame, 6, 2))};
}

can::Frame frame_of(const TxPdo& pdo, std::uint8_t node) {
  can::Frame frame{.id = kTxPdo1 + node, .extended = false, .error = false, .size = kTxPdoSize, .data = {}};
  put(frame, 0, static_cast<std::uint32_t>(pdo.velocity), 4);
  put(frame, 4, static_cast<std::uint16_t>(pdo.current_ma), 2);
  put(frame, 6, pdo.statusword, 2);
  return frame;
}

std::optional<std::uint16_t> emergency_of(const can::Frame& frame, std::uint8_t node) {
  if (node == 0 || !is_of(frame, kEmergency, node) || frame.size != kEmergencySize) return std::nullopt;
  return static_cast<std::uint16_t>(number_at(frame, 0, 2));
}

can::Frame emergency(std::uint8_t node, std::uint16_t code, std::uint8_t error_register) {
  can::Frame frame{.id = kEmergency + node, .extended = false, .error = false, .size = kEmergencySize, .data = {}};
  put(frame, 0, code, 2);
  frame.data[2] = error_register;
  return frame;
}

bool is_of_the_link(std::uint16_t code) { return code == kHeartbeatLost || code == 0x8120 || code == 0x81FD; }

std::string emergency_words(std::uint16_t code) {
  constexpr std::pair<std::uint16_t, const char*> kWords[] = {
      {0x1000, "generic error"},
      {0x2310, "overcurrent"},
      {0x3210, "overvoltage"},
      {0x3220, "undervoltage"},
      {0x4210, "too hot"},
      {0x7320, "position sensor"},
      {0x8120, "CAN controller is error passive"},
      {kHeartbeatLost, "heartbeat lost"},
      {0x8220, "length of a PDO"},
      {0x81FD, "it was bus off"},
  };
  for (const auto& [known, words] : kWords) {
    if (known == code) return fmt::format("{} ({:04X})", words, code);
  }
  return fmt::format("{} ({:04X})", (code & 0xFFF0U) == 0xFF00U ? "Hall sensor or encoder" : "emergency", code);
}

}  // namespace trivela::hal::cia402
