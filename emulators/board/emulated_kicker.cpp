#include "emulators/board/emulated_kicker.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "emulators/ioboard/emulated_board.hpp"
#include "emulators/rekick/emulated_board.hpp"

namespace trivela::hal {
namespace {

double length_us(const ioboard::EmulatedBoard::Pulse& pulse) { return pulse.units * ioboard::kPulseUnit_us; }
double length_us(const rekick::EmulatedBoard::Pulse& pulse) { return pulse.pulse_us; }

/// The ioBoard tells two switches and no charge.
void stand(ioboard::EmulatedBoard& board, double /*charge*/, bool armed) { board.in_play = armed; }
void stand(rekick::EmulatedBoard& board, double charge, bool armed) {
  board.supply_on = armed;
  board.measured_energy = charge;
}

std::uint8_t lever_kind_of(const ioboard::EmulatedBoard& board, const config::IoBoardDevice& host) {
  const auto height = std::ranges::find(host.levers, board.lever());
  return height == host.levers.end() ? std::uint8_t{0} : static_cast<std::uint8_t>(height - host.levers.begin());
}
std::uint8_t lever_kind_of(const rekick::EmulatedBoard&, const config::ReKickDevice&) { return 0; }

/// `Emulator` for a host with the settings `Host`.
template <class Emulator, class Host>
class KickerOf final : public EmulatedKicker {
 public:
  explicit KickerOf(const Host& host) : host_(host) {}

  std::string setting() const override { return fmt::format("hal.{}.port=\"{}\"", Host::kName, emulator_.address()); }

  bool wait_for_host(std::chrono::nanoseconds timeout) override {
    return emulator_.wait(timeout, [](const auto& board) { return board.looks() > 0; });
  }

  void show(double charge, bool armed) override {
    emulator_.with_board([&](auto& board) { stand(board, charge, armed); });
  }

  std::uint8_t lever_kind() override {
    std::uint8_t kind = 0;
    emulator_.with_board([&](const auto& board) { kind = lever_kind_of(board, host_); });
    return kind;
  }

  std::vector<CoilPulse> take_pulses() override {
    std::vector<CoilPulse> pulses;
    emulator_.with_board([&](const auto& board) {
      for (; taken_ < board.pulses().size(); ++taken_) {
        const double us = length_us(board.pulses()[taken_]);
        pulses.push_back({board.pulses()[taken_].t_ns, us, us / host_.pulse_us_per_power});
      }
    });
    return pulses;
  }

 private:
  Host host_;
  Emulator emulator_;
  std::size_t taken_ = 0;
};

std::unique_ptr<EmulatedKicker> board_of(const config::IoBoardDevice& host) {
  return std::make_unique<KickerOf<ioboard::Emulator, config::IoBoardDevice>>(host);
}
std::unique_ptr<EmulatedKicker> board_of(const config::ReKickDevice& host) {
  return std::make_unique<KickerOf<rekick::Emulator, config::ReKickDevice>>(host);
}
std::unique_ptr<EmulatedKicker> board_of(const auto& /*no board*/) { return nullptr; }

}  // namespace

std::unique_ptr<EmulatedKicker> emulated_kicker(const config::KickerDevice& host) {
  return std::visit([](const auto& device) { return board_of(device); }, host);
}

}  // namespace trivela::hal
