#include "hal/cia402/sdo.hpp"

#include <fmt/core.h>

#include <utility>

namespace trivela::hal::cia402 {
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
