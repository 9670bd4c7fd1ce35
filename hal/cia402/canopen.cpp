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

namespace {

constexpr std::uint8_t kSdoSize = 8;
// The command: what it does in bits 5 to 7, bytes that do not count in 2 and 3, expedited, their number is said.
constexpr std::uint8_t kWrite = 0x20, kWritten = 0x60, kRead = 0x40, kAbort = 0x80, kWhat = 0xE0;
constexpr std::uint8_t kExpedited = 0x02, kSized = 0x01;

std::uint8_t sized(std::uint8_t command, std::size_t size) {
  return static_cast<std::uint8_t>(command | (4U - size) << 2U | kExpedited | kSized);
}

std::size_t size_of(std::uint8_t command) { return (command & kSized) != 0 ? 4U - (command >> 2U & 3U) : 4U; }

can::Frame sdo(std::uint32_t id, std::uint8_t command, Object object, std::uint32_t value) {
  can::Frame frame{.id = id, .extended = false, .error = false, .size = kSdoSize, .data = {command}};
  put(frame, 1, object.index, 2);
  frame.data[3] = object.sub;
  put(frame, 4, value, 4);
  return frame;
}

bool is_sdo(const can::Frame& frame, std::uint32_t id) {
  return !frame.extended && !frame.error && frame.id == id && frame.size == kSdoSize;
}

Object object_of(const can::Frame& frame) {
  return {static_cast<std::uint16_t>(number_at(frame, 1, 2)), frame.data[3]};
}

}  // namespace

can::Frame sdo_write(std::uint8_t node, Object object, std::uint32_t value, std::size_t size) {
  return sdo(kSdoRequest + node, sized(kWrite, size), object, value);
}

can::Frame sdo_read(std::uint8_t node, Object object) { return sdo(kSdoRequest + node, kRead, object, 0); }

std::optional<SdoReply> sdo_reply_of(const can::Frame& frame, std::uint8_t node) {
  if (!is_sdo(frame, kSdoReply + node)) return std::nullopt;
  const std::uint8_t command = frame.data[0];
  const Object object = object_of(frame);
  switch (command & kWhat) {
    case kWritten:
      return SdoReply{SdoReply::Kind::kWritten, object, 0};
    case kRead:
      if ((command & kExpedited) == 0) return std::nullopt;
      return SdoReply{SdoReply::Kind::kRead, object, number_at(frame, 4, size_of(command))};
    case kAbort:
      return SdoReply{SdoReply::Kind::kAborted, object, number_at(frame, 4, 4)};
    default:
      return std::nullopt;
  }
}

std::optional<SdoRequest> sdo_request_of(const can::Frame& frame, std::uint8_t node) {
  if (!is_sdo(frame, kSdoRequest + node)) return std::nullopt;
  const std::uint8_t command = frame.data[0];
  if ((command & kWhat) == kRead) return SdoRequest{object_of(frame), std::nullopt, 0};
  if ((command & kWhat) != kWrite || (command & kExpedited) == 0) return std::nullopt;
  const std::size_t size = size_of(command);
  return SdoRequest{object_of(frame), number_at(frame, 4, size), size};
}

can::Frame sdo_written(std::uint8_t node, Object object) { return sdo(kSdoReply + node, kWritten, object, 0); }

can::Frame sdo_value(std::uint8_t node, Object object, std::uint32_t value, std::size_t size) {
  return sdo(kSdoReply + node, sized(kRead, size), object, value);
}

can::Frame sdo_abort(std::uint8_t node, Object object, std::uint32_t code) {
  return sdo(kSdoReply + node, kAbort, object, code);
}

std::string abort_words(std::uint32_t code) {
  constexpr std::pair<std::uint32_t, const char*> kWords[] = {
      {0x05040000, "it waited too long"},
      {0x05040001, "it does not know the command"},
      {0x06010000, "no access"},
      {0x06010001, "it can be written alone"},
      {0x06010002, "it can be read alone"},
      {kNoSuchObject, "no such object"},
      {0x06040041, "it cannot be mapped"},
      {0x06040042, "too much for a PDO"},
      {kWrongSize, "it has another size"},
      {kNoSuchSub, "no such sub-index"},
      {kOutOfRange, "out of range"},
      {0x08000000, "general error"},
      {0x08000020, "it cannot be stored"},
      {kNotInThisState, "not in this state"},
  };
  for (const auto& [known, words] : kWords) {
    if (known == code) return fmt::format("{} ({:08X})", words, code);
  }
  return fmt::format("it was aborted ({:08X})", code);
}

}  // namespace trivela::hal::cia402
