#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "kicking/optional_double.hpp"

namespace trivela::hal {

enum class KickerFault { kNone, kCharger, kCoil, kLink };
inline constexpr std::array kKickerFaultNames{"none", "charger", "coil", "link"};

/// One reading of the kicker.
struct KickerSample {
  std::int64_t t_ns = 0;  ///< of the clock in Kicker
  double charge = 0.0;    ///< capacitor energy, 0..1
  bool armed = false;     ///< the arm switch
  KickerFault fault = KickerFault::kNone;
  bool charge_modelled = false;  ///< the device measures no charge: it was computed from the time since the last shot
  kicking::OptionalDouble voltage_v{};  ///< of the capacitor; none, or not finite: not measured
  bool emulated = false;                ///< the board is a program
  std::uint8_t lever_kind = 0;          ///< kind of kick that the lever stands for; kicking::kLeverMoves: for none
};

/// What a device can do beyond firing and saying whether it may. Aligned so that an atomic one needs no lock.
struct alignas(8) KickerCapabilities {
  bool charge_control = false;  ///< charging is switched on and off by its host
  bool voltage = false;         ///< it measures its capacitor
  bool discharge = false;       ///< it empties its capacitor when told
  bool watchdog = false;        ///< it makes itself safe when its host falls silent
  bool lever = false;           ///< it has a lever for several kinds of kick, which moves when told
  bool operator==(const KickerCapabilities&) const = default;
};

/// What a capacitor shall do: stay as it is, be charged, be emptied.
enum class ChargeCommand { kHold, kCharge, kDischarge };

/// The deadline of a kick that has none, as in lockstep and replay.
constexpr std::int64_t kNoDeadline_ns = std::numeric_limits<std::int64_t>::max();

/// A kick for the device. The instants are of the clock in Kicker.
struct Shot {
  std::int64_t kick_id = 0;
  double power = 0.0;                       ///< set-point
  std::int64_t t_ns = 0;                    ///< when the coil is to be energised
  std::int64_t until_ns = kNoDeadline_ns;   ///< the coil is not energised after it
  std::int64_t judged_ns = kNoDeadline_ns;  ///< when the order was judged, see hold_when()
  std::uint8_t kick_kind = 0;               ///< for which the lever stood then
};

/// What became of a shot.
struct ShotResult {
  enum class What {
    kFired,      ///< the device was told
    kLate,       ///< not told: the deadline was over
    kCalledOff,  ///< not told: the game was stopped
    kDevice      ///< not told: the device does not answer, or has no such pulse
  };
  std::int64_t kick_id = 0;
  What what = What::kDevice;
  std::int64_t t_ns = 0;  ///< when that was known; kFired: after the write
};

/// The kicker: its state in, kicks out. read() is for one thread at a time, the commands for another.
///
/// Every t_ns is of one clock, the one that the orders' t_ns are of: in real time this machine's steady clock
/// (CLOCK_MONOTONIC), of the instant at which the device took the sample, never of that at which it was read; in
/// lockstep and replay the simulated or recorded time. A backend whose device has another clock converts. So a sample
/// or an order that waited, for this process or for the device, shows its age to whoever looks at the clock: a backend
/// hands out the newest sample it has, and never gives a waiting one the present instant.
class Kicker {
 public:
  /// Makes the kicker safe.
  virtual ~Kicker() = default;

  /// The device is there: samples can come and commands leave. Waits for it up to `timeout`.
  [[nodiscard]] virtual bool connected(std::chrono::nanoseconds timeout) = 0;

  /// The next sample, in time order; waits for it up to `timeout`. None: no sample yet.
  virtual std::optional<KickerSample> read(std::chrono::nanoseconds timeout) = 0;

  /// Energises the coil. Whoever writes to the device compares the clock with shot.until_ns immediately before, so
  /// that no stall of this process makes a kick late. The device does what it is told: whether the order is fresh, in
  /// range and wanted is its caller's business. Ignored after make_safe().
  virtual void fire(const Shot& shot) = 0;

  /// The kick `kick_id` is not carried out, if the device was not told of it yet or its instant still lies ahead; one
  /// that was carried out, or never ordered, changes nothing.
  virtual void withdraw(std::int64_t kick_id) = 0;

  /// Whether a shot that was judged at `judged_ns` must not be written any more: the game was stopped since, or the
  /// program ends. Asked by whoever writes to the device, immediately before. To be set before the first fire().
  using Hold = std::function<bool(std::int64_t judged_ns)>;
  virtual void hold_when(const Hold& hold) { static_cast<void>(hold); }

  /// Called by whoever writes to the device, immediately after a shot was written. To be set before the first fire().
  virtual void call_when_written(const std::function<void()>& written) { static_cast<void>(written); }

  /// What became of the oldest shot of which it was not said yet. A shot that was withdrawn has no result. None: there
  /// is no other, or the device's results are not known here.
  virtual std::optional<ShotResult> take_result() { return std::nullopt; }

  /// Why the device has no pulse for the set-point `power`. Empty: it has one.
  virtual std::string beyond(double power) const { return static_cast<void>(power), std::string{}; }

  /// What the capacitor shall do from now on, where the device can be told: kCharge and kHold need charge_control,
  /// kDischarge needs discharge. Said again with each sample. By default nobody listens.
  virtual void charge(ChargeCommand word) { static_cast<void>(word); }

  /// The lever shall stand for that kind of kick. Said again in each cycle. By default nobody listens.
  virtual void lever(std::uint8_t kick_kind) { static_cast<void>(kick_kind); }

  /// Nothing is energised from now on. May be called again.
  virtual void make_safe() noexcept = 0;

  virtual KickerCapabilities capabilities() const { return {}; }

  /// One line on the state of the link and on a kick that was not carried out, for a human; empty: nothing to say.
  virtual std::string status() const { return {}; }
};

}  // namespace trivela::hal
