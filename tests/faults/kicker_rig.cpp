#include "tests/faults/kicker_rig.hpp"

#include <fmt/core.h>

#include <fstream>
#include <stdexcept>
#include <utility>

namespace trivela::faults {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kPowers = 25;  // told apart by the length of their pulse
constexpr milliseconds kBetweenOrders{50};

config::Settings with_board(config::Settings settings, const TroubledBoard& board, const tests::Folder& folder) {
  settings.hal.kicker = board.host();
  settings.recorder.log = folder / "match.db";
  return settings;
}

}  // namespace

KickerRig::KickerRig(std::unique_ptr<TroubledBoard> board, config::Settings settings, bool referees)
    : board_(std::move(board)),
      settings_(with_board(std::move(settings), *board_, folder_)),
      participant_(bus::loopback(static_cast<std::uint32_t>(settings_.domain.domain_id), settings_.domain.tag)),
      drive_(participant_, own_decision()),
      decision_(participant_, own_decision()) {
  std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
  if (referees) referee_.emplace(participant_);
  recorder_.emplace("trivela-recorder", std::vector<std::string>{"--config", "nodes.toml"}, folder_.path());
  start_driver();
  if (!decision_.wait_for_readers(2, std::chrono::seconds{20}))
    throw std::runtime_error{"driver and recorder do not come: " + driver_->errors() + recorder_->errors()};
}

void KickerRig::start_driver() {
  driver_.emplace("trivela-kicker_driver", std::vector<std::string>{"--config", "nodes.toml"}, folder_.path());
}

void KickerRig::play(std::int64_t until_ns, const std::function<bool()>& done) {
  while (steady_now_ns() < until_ns && !done()) {
    const std::int64_t began_ns = steady_now_ns();
    say();
    order();
    board_->stir();
    board_->wait_for_pulse(board_->pulses().size(), kBetweenOrders);
    until_ns += stalled_ns(began_ns, std::chrono::nanoseconds{kBetweenOrders}.count());
  }
}

void KickerRig::say() {
  msg::DriveCommand command{};
  command.robot_id = 1;
  command.seq = ++words_;
  command.t_ns = steady_now_ns();
  drive_.write(command);
  if (!referee_) return;
  msg::Referee word{};
  word.robot_id = 1;
  word.seq = words_;
  word.t_ns = steady_now_ns();
  word.playing = playing_;
  auto& said = timeline_.playing;
  if (said.empty() || said.rbegin()->second != playing_) said[word.t_ns] = playing_;
  referee_->write(word);
}

void KickerRig::order() {
  const std::uint64_t draw = random_() % 6;
  write_order(decision_, draw < 3 ? OrderKind::kLawful : static_cast<OrderKind>(draw - 2));
}

void KickerRig::unauthorised_orders() {
  bus::Writer<msg::KickOrder> unauthorised{
      participant_, {.period = {}, .lease = std::chrono::hours{1}, .strength = 10, .owner = "somebody"}};
  if (!unauthorised.wait_for_readers(1, std::chrono::seconds{5}))
    throw std::runtime_error{"nobody receives the unauthorised orders"};
  for (int i = 0; i < 4; ++i) {
    say();
    write_order(unauthorised, OrderKind::kUnauthorised);
    board_->wait_for_pulse(board_->pulses().size(), kBetweenOrders);
  }
}

void KickerRig::write_order(bus::Writer<msg::KickOrder>& writer, OrderKind kind, std::int64_t ahead_ns) {
  const Ordered ordered{steady_now_ns(), kind, static_cast<int>(20 + ids_ % kPowers)};
  msg::KickOrder out{};
  out.robot_id = 1;
  out.seq = out.kick_id = static_cast<std::int64_t>(++ids_);
  out.t_ns = out.fire_t_ns = ordered.t_ns - (kind == OrderKind::kStale ? 400 * kMs : 0);
  out.fire_t_ns += ahead_ns;
  out.valid_until_t_ns = ordered.t_ns + 1'000 * kMs;
  out.power = kind == OrderKind::kOutOfRange ? 200.0 : ordered.units;
  out.possession = kind != OrderKind::kWithoutBall;
  timeline_.ordered[out.kick_id] = ordered;
  writer.write(out);
}

/// The signal comes within 2 ms of an order that the process may fire: before its receipt, between receipt and pulse,
/// or after. A stop comes while a shot that was accepted waits for its instant, so that each one is late when the
/// process goes on.
void KickerRig::signal_amid_a_kick(int signal) {
  const std::int64_t rested_ns = steady_now_ns() + 600 * kMs;
  while (steady_now_ns() < rested_ns) {
    say();
    board_->wait_for_pulse(board_->pulses().size(), kBetweenOrders);
  }
  say();
  const bool stops = signal == SIGSTOP;
  write_order(decision_, OrderKind::kLawful, stops ? 15 * kMs : 0);
  const std::int64_t at_most_ns = stops ? 8 * kMs : 2 * kMs;
  const std::int64_t then_ns = steady_now_ns() + (stops ? 6 * kMs : 0) +
                               static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(at_most_ns));
  while (steady_now_ns() < then_ns) continue;
  driver_->signal(signal);
  if (signal == SIGKILL) driver_->wait();
}

void KickerRig::suffer(Trouble what, std::int64_t for_ns) {
  if (what == Trouble::kKill) signal_amid_a_kick(SIGKILL);
  if (what == Trouble::kStop) signal_amid_a_kick(SIGSTOP);
  timeline_.troubles[steady_now_ns()] = what;
  if (what == Trouble::kRestart) {
    driver_->signal(SIGTERM);
    if (driver_->wait() != 0) throw std::runtime_error{"the driver did not end well: " + driver_->errors()};
    return start_driver();
  }
  board_->begin(what);
  play(steady_now_ns() + for_ns);
  board_->end();
  if (what == Trouble::kStop) driver_->signal(SIGCONT);
  if (what == Trouble::kKill) start_driver();
}

bool KickerRig::fires(std::int64_t within_ns) {
  const std::size_t before = board_->pulses().size();
  play(steady_now_ns() + within_ns, [&] { return board_->pulses().size() > before; });
  return board_->pulses().size() > before;
}

std::string KickerRig::end() {
  driver_->signal(SIGTERM);
  std::string wrong = driver_->wait() == 0 ? "" : "the driver did not end well: " + driver_->errors();
  recorder_->signal(SIGTERM);
  if (recorder_->wait() != 0) wrong += "the recorder did not end well: " + recorder_->errors();
  return wrong;
}

}  // namespace trivela::faults
