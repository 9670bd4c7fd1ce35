#include "tests/bench/board_driver.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bus/domain/domain.hpp"
#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "config/settings.hpp"
#include "emulators/ioboard/emulated_board.hpp"
#include "hal/ioboard/io_board.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using Board = hal::ioboard::EmulatedBoard;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kAhead_ns = 13 * kMs;
constexpr std::size_t kPowers = 25;  // told apart by the length of their pulse

std::int64_t now_ns() { return steady_clock::now().time_since_epoch().count(); }

/// A board that is charged at once, so that the driver is ready as often as it may be.
config::Settings settings_for(const std::string& port) {
  config::Settings settings = config::load_settings(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml");
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("board-bench-{}-{:08x}", getpid(), random());
  settings.kicker_driver.min_interval_s = 0.06;
  settings.hal.kicker = config::IoBoardDevice{.port = port, .charge_time_s = 0.01};
  return settings;
}

/// A driver with an emulated board, and whoever orders its kicks.
class DrivenBoard {
 public:
  explicit DrivenBoard(int priority) : settings_(settings_for(board_.address())) {
    std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
    std::vector<std::string> arguments{"--config", "nodes.toml"};
    if (priority > 0) arguments.insert(arguments.end(), {"--realtime", std::to_string(priority)});
    driver_.emplace("trivela-kicker_driver", std::move(arguments), folder_.path());
  }

  /// One shot, `ahead_ns` after its order: how long after that instant the board had the frame; none: it was refused.
  std::optional<std::int64_t> shoot(std::int64_t ahead_ns) {
    wait_until_ready();
    const std::size_t before = pulses();
    const auto units = static_cast<std::uint8_t>(20 + ++kicks_ % kPowers);
    msg::KickOrder order{};
    order.robot_id = 1;
    order.seq = kicks_;
    order.kick_id = static_cast<std::int64_t>(kicks_);
    order.power = units;
    order.possession = true;
    order.t_ns = now_ns();
    order.fire_t_ns = order.t_ns + ahead_ns;
    order.valid_until_t_ns = order.t_ns + 100 * kMs;
    decision_.write(order);
    std::optional<std::int64_t> late_ns;
    board_.wait(seconds(1), [&](const Board& board) {
      for (std::size_t i = before; i < board.pulses().size(); ++i) {
        if (board.pulses()[i].units == units) late_ns = board.pulses()[i].t_ns - order.fire_t_ns;
      }
      return late_ns.has_value();
    });
    return late_ns;
  }

 private:
  void wait_until_ready() {
    const auto fired_ns = now_ns();
    bool ready = false;
    for (const auto end = steady_clock::now() + seconds(30); !ready;) {
      if (steady_clock::now() > end) throw std::runtime_error{"the driver is never ready: " + driver_->errors()};
      say_play();
      say_decision_lives();
      status_.wait(milliseconds(50));
      status_.take([&](const msg::KickerStatus& status) { ready = status.ready && status.t_ns > fired_ns; });
    }
  }

  void say_play() {
    msg::Referee word{};
    word.robot_id = 1;
    word.seq = ++words_;
    word.t_ns = now_ns();
    word.playing = true;
    referee_.write(word);
  }

  void say_decision_lives() {
    msg::DriveCommand command{};
    command.robot_id = 1;
    command.seq = ++drives_;
    command.t_ns = now_ns();
    drive_.write(command);
  }

  std::size_t pulses() {
    std::size_t count = 0;
    board_.with_board([&](const Board& board) { count = board.pulses().size(); });
    return count;
  }

  tests::Folder folder_;
  hal::ioboard::Emulator board_;
  config::Settings settings_;
  bus::Participant participant_{
      bus::loopback(static_cast<std::uint32_t>(settings_.domain.domain_id), settings_.domain.tag)};
  bus::Writer<msg::Referee> referee_{participant_};
  const bus::WriterOptions own_{
      .period = {}, .lease = std::chrono::hours{1}, .strength = 0, .owner = "kick_decision/1"};
  bus::Writer<msg::KickOrder> decision_{participant_, own_};
  bus::Writer<msg::DriveCommand> drive_{participant_, own_};
  bus::Reader<msg::KickerStatus> status_{participant_};
  std::optional<e2e::Program> driver_;
  std::uint64_t kicks_ = 0, words_ = 0, drives_ = 0;
};

/// The same frame to the same kind of far end, written by whoever decides.
class BareLine {
 public:
  BareLine() : line_(hal::serial_line(board_.address())) {
    if (line_->open({}) != hal::Line::Opening::kOpen) throw std::runtime_error{"the emulated line cannot be opened"};
  }

  std::int64_t shoot() {
    const std::int64_t begin_ns = now_ns();
    line_->write(encode(hal::ioboard::frame_of(hal::ioboard::Command::kShoot, 1)), {});
    ++shots_;
    if (!board_.wait(seconds(10), [&](const Board& board) { return board.pulses().size() == shots_; }))
      throw std::runtime_error{"the emulated board takes no shot"};
    std::int64_t read_ns = 0;
    board_.with_board([&](const Board& board) { read_ns = board.pulses().back().t_ns; });
    return read_ns - begin_ns;
  }

 private:
  hal::ioboard::Emulator board_;
  std::unique_ptr<hal::Line> line_;
  std::size_t shots_ = 0;
};

}  // namespace

DriverSpans measure_driver(int shots, int priority) {
  DriverSpans spans;
  BareLine bare;
  DrivenBoard board{priority};
  const auto shoot = [&](std::int64_t ahead_ns) {
    while (spans.refused <= shots) {
      if (const auto span_ns = board.shoot(ahead_ns)) return *span_ns;
      ++spans.refused;
    }
    throw std::runtime_error{"more orders are refused than fired"};
  };
  for (int i = 0; i < shots; ++i) {  // in turns: what else the machine does is the same for all
    spans.bare_ns.push_back(bare.shoot());
    spans.order_ns.push_back(shoot(0));
    spans.late_ns.push_back(shoot(kAhead_ns));
  }
  return spans;
}

}  // namespace trivela::bench
