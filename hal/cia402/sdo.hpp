#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/cia402/canopen.hpp"

namespace trivela::hal::cia402 {

/// An entry of a drive's object dictionary.
struct Object {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  bool operator==(const Object&) const = default;
};

/// Expedited transfers, up to four bytes. `size` is 1, 2 or 4.
can::Frame sdo_write(std::uint8_t node, Object object, std::uint32_t value, std::size_t size);
can::Frame sdo_read(std::uint8_t node, Object object);

/// What a drive answers.
struct SdoReply {
  enum class Kind { kWritten, kRead, kAborted };
  Kind kind = Kind::kWritten;
  Object object;
  std::uint32_t value = 0;  ///< read: the value, aborted: why
};
/// None: it is no answer of the node, or one of more than four bytes.
std::optional<SdoReply> sdo_reply_of(const can::Frame& frame, std::uint8_t node);

/// What a drive is asked.
struct SdoRequest {
  Object object;
  std::optional<std::uint32_t> write;  ///< none: it is to be read
  std::size_t size = 0;                ///< of what is written
};
std::optional<SdoRequest> sdo_request_of(const can::Frame& frame, std::uint8_t node);

can::Frame sdo_written(std::uint8_t node, Object object);
can::Frame sdo_value(std::uint8_t node, Object object, std::uint32_t value, std::size_t size);
can::Frame sdo_abort(std::uint8_t node, Object object, std::uint32_t code);

inline constexpr std::uint32_t kNoSuchObject = 0x06020000, kNoSuchSub = 0x06090011, kWrongSize = 0x06070010,
                               kNotInThisState = 0x08000022, kOutOfRange = 0x06090030;

/// "no such object (06020000)".
std::string abort_words(std::uint32_t code);

}  // namespace trivela::hal::cia402
