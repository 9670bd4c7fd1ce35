#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/can/can_line.hpp"

/// CANopen as far as a drive needs it: frames with 11-bit identifiers, numbers little endian. Source:
/// dasys-lab/cnc-msldriver, msl_motion/include/driver/eposprotocol.h and configurations/Node_1.dcf; golden bytes by
/// ros-industrial/ros_canopen #259.
namespace trivela::hal::cia402 {

inline constexpr std::uint32_t kNmt = 0x000, kSync = 0x080, kEmergency = 0x080, kTxPdo1 = 0x180, kRxPdo1 = 0x200,
                               kSdoReply = 0x580, kSdoRequest = 0x600, kHeartbeat = 0x700;

/// What the network's master tells a node.
enum class Nmt : std::uint8_t { kStart = 0x01, kStop = 0x02, kPreOperational = 0x80, kReset = 0x81 };

/// What a node's heartbeat says of it; kBootUp once, when it has come up.
enum class NodeState : std::uint8_t { kBootUp = 0x00, kStopped = 0x04, kOperational = 0x05, kPreOperational = 0x7F };

can::Frame nmt(Nmt command, std::uint8_t node);
can::Frame sync();
can::Frame heartbeat(std::uint8_t node, NodeState state);

/// What the frame says of `node`; none: it is no heartbeat of it.
std::optional<NodeState> heartbeat_of(const can::Frame& frame, std::uint8_t node);

/// RxPDO 1 as it is mapped: target velocity (60FF) in the drive's unit, controlword (6040).
can::Frame rx_pdo(std::uint8_t node, std::int32_t velocity, std::uint16_t controlword);

/// TxPDO 1 as it is mapped: actual velocity (606C), current in mA (6078), statusword (6041).
struct TxPdo {
  std::int32_t velocity = 0;  ///< in the drive's unit
  std::int16_t current_ma = 0;
  std::uint16_t statusword = 0;
};
/// None: it is none of the node's, or not eight bytes.
std::optional<TxPdo> tx_pdo_of(const can::Frame& frame, std::uint8_t node);
can::Frame frame_of(const TxPdo& pdo, std::uint8_t node);

/// The code of the node's emergency, 0: it is over; none: the frame is none.
std::optional<std::uint16_t> emergency_of(const can::Frame& frame, std::uint8_t node);
can::Frame emergency(std::uint8_t node, std::uint16_t code, std::uint8_t error_register);

/// Our heartbeat was missing for longer than the node waits for it.
inline constexpr std::uint16_t kHeartbeatLost = 0x8130;
/// Whether the code says that the bus was cut, and nothing of the motor: heartbeat lost, error passive, bus off.
bool is_of_the_link(std::uint16_t code);

/// "overcurrent (2310)".
std::string emergency_words(std::uint16_t code);

/// `size` bytes of `value`, little endian, from `begin` on.
void put(can::Frame& frame, std::size_t begin, std::uint32_t value, std::size_t size);
std::uint32_t number_at(const can::Frame& frame, std::size_t begin, std::size_t size);

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
