#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "bus/writer_watch.hpp"
#include "hal/kicker.hpp"
#include "idl/messages.hpp"

namespace trivela::hal {

/// The kicker behind a bridge: device/kicker in, device/fire and, for a board that can do it, device/charge out. An
/// order is for the bridge that is there: before connected() here, and before the bridge's reader knows this writer, it
/// is lost.
class BusKicker final : public Kicker {
 public:
  /// Throws bus::Error if the bus refuses.
  BusKicker(const bus::Participant& participant, std::uint8_t robot_id);
  ~BusKicker() override { make_safe(); }
  BusKicker(const BusKicker&) = delete;
  BusKicker& operator=(const BusKicker&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  std::optional<KickerSample> read(std::chrono::nanoseconds timeout) override;
  void fire(const Shot& shot) override;
  void withdraw(std::int64_t kick_id) override;
  void hold_when(const Hold& hold) override { hold_ = hold; }
  void call_when_written(const std::function<void()>& written) override { written_ = written; }
  std::optional<ShotResult> take_result() override;
  void charge(ChargeCommand word) override;
  /// Said with the next charge().
  void lever(std::uint8_t kick_kind) override { lever_kind_ = kick_kind; }
  void make_safe() noexcept override;
  /// That several bridges write, which is a fault of the link while it lasts.
  std::string status() const override;
  /// As the latest sample says.
  KickerCapabilities capabilities() const override { return capabilities_; }

 private:
  void write_charge(ChargeCommand word);

  std::uint8_t robot_id_;
  bus::Reader<msg::DeviceKicker> samples_;
  bus::Writer<msg::DeviceFire> fires_;
  std::optional<std::int64_t> read_t_ns_;
  bus::WriterWatch bridges_;
  std::atomic<bool> contested_ = false;
  bus::Writer<msg::DeviceCharge> charges_;
  std::uint64_t fire_seq_ = 0;
  std::atomic<std::uint64_t> charge_seq_ = 0;
  std::atomic<KickerCapabilities> capabilities_{};
  std::atomic<std::uint8_t> lever_kind_ = 0;
  std::atomic<bool> safe_ = false;
  Hold hold_;
  std::function<void()> written_;
  std::optional<ShotResult> dropped_;
};

}  // namespace trivela::hal
