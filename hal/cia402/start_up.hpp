#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/devices.hpp"
#include "hal/cia402/canopen.hpp"
#include "hal/wheels.hpp"

namespace trivela::hal::cia402 {

/// How a drive counts.
struct Scale {
  double rpm_per_unit = 1.0;  ///< of its velocity, at the motor's shaft
  double gear = 1.0;          ///< turns of the motor for one of the wheel
};

/// Revolutions a minute for a unit of velocity by object 60A9: its upper byte is a power of ten, the rest the unit
/// (0xB44700: rpm). None: another unit.
std::optional<double> rpm_per_unit_of(std::uint32_t object_60a9);

/// The conversation with one drive from an open bus until it can be started (NMT): a reset, where somebody started this
/// program on purpose, then its settings object by object. A drive that refuses to watch our heartbeat (1016) or to
/// stop without it (6007) is refused, since its wheel would turn on when this program dies. One request is open at a
/// time. No clock, no bus: the caller sends request() and says what came.
///
/// A drive that is listened to is not reset and not made ready to turn: it is asked for its counts and its error, and
/// told its heartbeat and TxPDO 1.
class StartUp {
 public:
  enum class Reset {
    kYes,
    kNo  ///< a drive that was lost may have a fault, which a reset would hide: its error code (603F) is asked for
  };
  StartUp(std::uint8_t node, const config::Cia402Device& settings, Reset reset, WheelsUse use = WheelsUse::kDrive);

  enum class Progress {
    kWaiting,  ///< for the answer to request()
    kNext,     ///< request() is another one, or has to be sent again
    kDone,     ///< it waits for NMT start
    kFailed,   ///< why() says it
  };

  can::Frame request() const;
  /// How long its answer may take.
  std::int64_t timeout_ns() const;

  Progress take(const can::Frame& frame);
  /// The answer did not come: the request is repeated once, passed over where the rest works without, or given up.
  Progress timed_out();

  /// Known once done.
  const Scale& scale() const { return scale_; }
  /// Object 603F, its last error; 0: there was none, it does not say it, or a reset made an end of it.
  std::uint16_t error_code() const { return error_code_; }
  const std::string& why() const { return why_; }

 private:
  /// An object to write, or to read where it has no value.
  struct Task {
    Object object;
    std::size_t size = 4;
    std::optional<std::uint32_t> value{};
    bool may_be_missing = false;
    const char* because = "";  ///< what a refusal means
  };

  void add_settings(const config::Cia402Device& settings);
  void add_reads(const config::Cia402Device& settings);
  void add_mapping(std::uint16_t communication, std::uint16_t mapping, std::uint32_t id, std::uint8_t transmission,
                   const std::vector<std::uint32_t>& objects);
  const Task* task() const;
  Progress take_reply(const SdoReply& reply);
  std::string take_value(const Object& object, std::optional<std::uint32_t> value);
  std::string take_unit(std::optional<std::uint32_t> unit);
  std::string check_heartbeat(std::uint32_t value) const;
  Progress go_on();
  Progress fail(const std::string& why);

  std::uint8_t node_;
  Reset reset_;
  std::uint32_t consumer_heartbeat_;
  std::vector<Task> tasks_;
  bool up_ = false;  // it has come up, or is quiet
  std::size_t next_ = 0;
  bool repeated_ = false;
  Scale scale_;
  std::optional<std::uint32_t> vendor_;
  std::uint32_t gear_numerator_ = 0;
  std::uint16_t error_code_ = 0;
  std::string why_;
};

}  // namespace trivela::hal::cia402
