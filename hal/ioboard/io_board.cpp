#include "hal/ioboard/io_board.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hal/board/board_kicker.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::hal::ioboard {
namespace {

constexpr std::int64_t kPause_ns = 200'000'000;       // between two openings
constexpr std::int64_t kPending_ns = 10'000'000;      // an opening that takes its time is looked at so often
constexpr std::int64_t kFaultPeriod_ns = 50'000'000;  // of samples while the line is down
constexpr int kReadsPerStep = 16;                     // so that a flood keeps no shot waiting
constexpr double kLongestPulse = 255.0;
constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();
constexpr Line::Deadline kNow{};  // does not wait

std::string name_of(Command command) { return fmt::format("{:02X}", static_cast<unsigned>(command)); }

/// The eight characters, as far as they can be printed.
std::string text_of(const Payload& payload) {
  std::string text{payload.begin(), payload.end()};
  std::erase_if(text, [](char c) { return c < ' ' || c > '~'; });
  return text;
}

}  // namespace

std::optional<std::uint8_t> pulse_of(double power, double pulse_us_per_power) {
  const double units = power * pulse_us_per_power / kPulseUnit_us;
  if (!(units >= 0.0 && units <= kLongestPulse)) return std::nullopt;
  return static_cast<std::uint8_t>(std::lround(units));
}

IoBoard::IoBoard(std::unique_ptr<Line> line, const config::IoBoardDevice& settings)
    : line_(std::move(line)), settings_(settings), status_("opening " + line_->name()) {}

void IoBoard::step(std::int64_t now_ns) {
  const bool closed = phase_ == Phase::kClosed || phase_ == Phase::kOpening;
  if (closed && now_ns >= next_ns_) open(now_ns);
  if (phase_ > Phase::kOpening) receive(now_ns);
  if (phase_ > Phase::kOpening) time_out(now_ns);
  if (up() && !question_ && wanted_kind_ != told_kind_ && now_ns >= lever_stands_ns_) {
    told_kind_ = wanted_kind_;
    lever_stands_ns_ = kNever_ns;
    ask(frame_of(Command::kHeight, *height()), now_ns);
  }
  if (up() && !question_ && now_ns >= next_ns_) {
    next_ns_ = now_ns + kPollPeriod_ns;
    ask(frame_of(Command::kStatus), now_ns);
  }
  if (!up()) say_link_fault(now_ns);
}

std::int64_t IoBoard::next_ns() const {
  const bool lever_waits = up() && !question_ && wanted_kind_ != told_kind_;
  const std::int64_t step = lever_waits ? std::min(next_ns_, lever_stands_ns_) : next_ns_;
  const std::int64_t asked = question_ ? question_->last_ns + kAnswer_ns : step;
  const std::int64_t shot = shot_unanswered_ns_ ? *shot_unanswered_ns_ + kAnswer_ns : asked;
  const std::int64_t fault = fault_said_ns_ ? *fault_said_ns_ + kFaultPeriod_ns : asked;
  return std::min({asked, shot, fault});
}

std::string IoBoard::beyond(double power) const {
  if (pulse_of(power, settings_.pulse_us_per_power)) return {};
  return fmt::format("set-point {:g} is a pulse of {:g} us, the board's are 0 to {:g}", power,
                     power * settings_.pulse_us_per_power, kLongestPulse * kPulseUnit_us);
}

std::string IoBoard::shoot(double power, std::int64_t now_ns) {
  const auto pulse = pulse_of(power, settings_.pulse_us_per_power);
  if (!pulse) return beyond(power);
  if (question_ && now_ns - question_->first_ns > kDoubt_ns)
    return fmt::format("the board has not answered for {:.0f} ms", 1e3 * kicking::seconds(question_->first_ns, now_ns));
  charging_since_ns_ = now_ns;
  if (line_->write(encode(frame_of(Command::kShoot, *pulse)), kNow)) {
    shot_unanswered_ns_ = now_ns;
    return {};
  }
  lose(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()), now_ns);
  return status_;
}

std::optional<KickerSample> IoBoard::take_sample() { return std::exchange(sample_, std::nullopt); }

void IoBoard::open(std::int64_t now_ns) {
  const Line::Opening opening = line_->open(kNow);
  if (opening == Line::Opening::kFailed) {
    lose(fmt::format("no device {}: {}", line_->name(), line_->why()), now_ns);
  } else if (opening == Line::Opening::kPending) {
    phase_ = Phase::kOpening;
    next_ns_ = now_ns + kPending_ns;
  } else {
    parser_ = {};
    phase_ = Phase::kVersion;
    ask(frame_of(Command::kVersion), now_ns);
  }
}

void IoBoard::receive(std::int64_t now_ns) {
  std::array<char, 256> bytes;
  for (int i = 0; i < kReadsPerStep && phase_ > Phase::kOpening; ++i) {
    const auto count = line_->read(bytes, kNow);
    if (!count) return lose(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()), now_ns);
    if (*count == 0) return;
    for (const Frame& answer : parser_.feed({bytes.data(), *count})) {
      if (phase_ > Phase::kOpening) take(answer, now_ns);
    }
  }
}

void IoBoard::take(const Frame& answer, std::int64_t now_ns) {
  if (answer.command == Command::kUnknown) return refused(now_ns);
  if (answer.command == Command::kShoot) shot_unanswered_ns_.reset();
  if (!question_ || answer.command != question_->frame.command) return;
  const Question question = *std::exchange(question_, std::nullopt);
  switch (answer.command) {
    case Command::kVersion:
      return take_version(answer, now_ns);
    case Command::kHeight:
      return take_height(answer, now_ns);
    case Command::kStatus:
      return take_switches(answer, question.first_ns);
    default:
      return;
  }
}

void IoBoard::take_version(const Frame& answer, std::int64_t now_ns) {
  version_ = text_of(answer.payload);
  told_kind_ = wanted_kind_;
  if (!height()) return come_up(now_ns);
  phase_ = Phase::kHeight;
  ask(frame_of(Command::kHeight, *height()), now_ns);
}

void IoBoard::lever(std::uint8_t kick_kind) {
  if (kick_kind < settings_.levers.size()) wanted_kind_ = kick_kind;
}

/// That the board was told last.
std::optional<std::uint8_t> IoBoard::height() const {
  return settings_.levers.empty() ? settings_.lever : settings_.levers[told_kind_];
}

void IoBoard::take_height(const Frame& answer, std::int64_t now_ns) {
  if (answer.payload[0] != height())
    return lose(fmt::format("{}: the lever was set to {} and answered {}", line_->name(), *height(), answer.payload[0]),
                now_ns);
  lever_stands_ns_ = now_ns + kicking::nanoseconds(settings_.lever_s);
  if (phase_ == Phase::kHeight) come_up(now_ns);
}

std::uint8_t IoBoard::lever_kind(std::int64_t now_ns) const {
  return now_ns >= lever_stands_ns_ ? told_kind_ : kicking::kLeverMoves;
}

void IoBoard::come_up(std::int64_t now_ns) {
  phase_ = Phase::kUp;
  next_ns_ = charging_since_ns_ = now_ns;
  closed_once_ = false;
  fault_said_ns_.reset();
  status_ = fmt::format("{}: ioBoard version {}", line_->name(), version_);
}

void IoBoard::take_switches(const Frame& answer, std::int64_t asked_ns) {
  const bool closed = answer.payload[0] != 0 && answer.payload[1] != 0;
  sample_ = KickerSample{.t_ns = asked_ns,
                         .charge = charge(asked_ns),
                         .armed = closed && closed_once_,
                         .fault = KickerFault::kNone,
                         .charge_modelled = true,
                         .emulated = version_ == kEmulatedVersion,
                         .lever_kind = lever_kind(asked_ns)};
  closed_once_ = closed;
}

/// The board does not know a command; it says not which: the one that has waited longest for its answer.
void IoBoard::refused(std::int64_t now_ns) {
  const bool of_shot = shot_unanswered_ns_ && !(question_ && question_->first_ns < *shot_unanswered_ns_);
  if (!of_shot && !question_) return;
  const Command command = of_shot ? Command::kShoot : question_->frame.command;
  lose(fmt::format("{}: the board does not know command {}", line_->name(), name_of(command)), now_ns);
}

void IoBoard::time_out(std::int64_t now_ns) {
  if (shot_unanswered_ns_ && now_ns >= *shot_unanswered_ns_ + kAnswer_ns) {
    line_->drop_unsent();
    shot_unanswered_ns_.reset();
  }
  if (!question_ || now_ns < question_->last_ns + kAnswer_ns) return;
  line_->drop_unsent();
  closed_once_ = false;
  const Frame frame = question_->frame;
  const bool may_be_asked_again = frame.command != Command::kHeight;
  if (!may_be_asked_again || question_->asked > kRetries)
    return lose(fmt::format("{}: no answer to command {}", line_->name(), name_of(frame.command)), now_ns);
  ++question_->asked;
  question_->last_ns = now_ns;
  send(frame, now_ns);
}

void IoBoard::ask(const Frame& frame, std::int64_t now_ns) {
  question_ = Question{frame, now_ns, now_ns, 1};
  send(frame, now_ns);
}

void IoBoard::send(const Frame& frame, std::int64_t now_ns) {
  if (!line_->write(encode(frame), kNow))
    lose(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()), now_ns);
}

void IoBoard::lose(const std::string& why, std::int64_t now_ns) {
  line_->drop_unsent();
  line_->close();
  question_.reset();
  shot_unanswered_ns_.reset();
  fault_said_ns_.reset();
  phase_ = Phase::kClosed;
  next_ns_ = now_ns + kPause_ns;
  status_ = why;
}

void IoBoard::say_link_fault(std::int64_t now_ns) {
  if (fault_said_ns_ && now_ns < *fault_said_ns_ + kFaultPeriod_ns) return;
  fault_said_ns_ = now_ns;
  sample_ =
      KickerSample{.t_ns = now_ns, .charge = 0.0, .armed = false, .fault = KickerFault::kLink, .charge_modelled = true};
}

double IoBoard::charge(std::int64_t now_ns) const {
  const double since_s = kicking::seconds(charging_since_ns_, now_ns);
  return settings_.charge_time_s > 0.0 ? std::clamp(since_s / settings_.charge_time_s, 0.0, 1.0) : 1.0;
}

}  // namespace trivela::hal::ioboard

namespace trivela::config {

std::unique_ptr<hal::Kicker> kicker_of(const IoBoardDevice& board, const Hal&, const hal::Owner&) {
  return std::make_unique<hal::BoardKicker>(
      std::make_unique<hal::ioboard::IoBoard>(hal::serial_line(board.port), board));
}

}  // namespace trivela::config
