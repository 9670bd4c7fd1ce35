#include "hal/refbox/refbox_client.hpp"

#include <fmt/format.h>

#include <array>
#include <thread>
#include <utility>

namespace trivela::hal::refbox {

namespace {

// How often it is looked whether what was sent has been acknowledged.
constexpr std::chrono::milliseconds kPollInterval{20};
// What the other side takes, it takes at once.
constexpr std::chrono::milliseconds kSendingTime{50};

}  // namespace

RefboxClient::RefboxClient(std::unique_ptr<Line> line, TeamMarks team, std::chrono::nanoseconds timeout)
    : line_(std::move(line)), team_(std::move(team)), timeout_(timeout), words_(team_) {}

std::optional<BoxEvent> RefboxClient::next(std::chrono::nanoseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (events_.empty()) {
    const auto until = std::min(deadline, Clock::now() + kPollInterval);
    connected_ ? receive(until) : open(until);
    if (events_.empty() && Clock::now() >= deadline) return std::nullopt;
  }
  BoxEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

void RefboxClient::open(Clock::time_point deadline) {
  if (Clock::now() < retry_at_) return std::this_thread::sleep_until(std::min(deadline, retry_at_));
  if (!attempt_since_) attempt_since_ = Clock::now();
  switch (line_->open(deadline)) {
    case Line::Opening::kFailed:
      return refused(line_->why());
    case Line::Opening::kPending:
      if (Clock::now() - *attempt_since_ > kLongestAttempt) refused(line_->why());
      return;
    case Line::Opening::kOpen:
      connected_ = true;
      accepted_ = turned_away_ = false;
      attempt_since_.reset();
      said_.clear();
      words_ = CommandStream{team_};
      unacknowledged_ = {};
      events_.emplace_back(Connected{});
  }
}

void RefboxClient::refused(std::string why) {
  line_->close();
  attempt_since_.reset();
  retry_at_ = Clock::now() + kRetry;
  if (why == said_) return;
  said_ = why;
  events_.emplace_back(Unreachable{std::move(why)});
}

void RefboxClient::receive(Clock::time_point deadline) {
  std::array<char, 4096> bytes;
  const auto count = line_->read(bytes, deadline);
  if (!count) return lose(line_->why());
  for (ParsedCommand& word : words_.add({bytes.data(), *count})) {
    if (const auto* const command = std::get_if<Command>(&word)) {
      accepted_ = accepted_ || command->kind != CommandKind::kReset;
      turned_away_ = !accepted_;
    }
    std::visit([this](auto& said) { events_.emplace_back(std::move(said)); }, word);
  }
  if (const auto why = words_.wrong_protocol()) return lose(std::string{*why});
  look_at_acknowledgements();
}

void RefboxClient::look_at_acknowledgements() {
  const auto age = unacknowledged_.age(line_->unacknowledged_bytes(), Clock::now());
  if (age <= timeout_) return;
  lose(fmt::format("it has not acknowledged for {:.2f} s what we sent", std::chrono::duration<double>(age).count()));
}

void RefboxClient::lose(std::string why) {
  line_->close();
  connected_ = false;
  retry_at_ = Clock::now() + (turned_away_ ? std::chrono::milliseconds{kRetryTurnedAway} : kRetry);
  events_.emplace_back(Lost{std::move(why)});
}

void RefboxClient::send(std::string_view object) {
  if (!connected_) return;
  std::string bytes(object);
  bytes += '\0';
  const auto now = Clock::now();
  unacknowledged_.sent(bytes.size(), now);
  if (!line_->write(bytes, now + kSendingTime)) return lose(line_->why());
  look_at_acknowledgements();
}

std::unique_ptr<RefboxClient> refbox_client(const std::string& host, std::uint16_t port, TeamMarks team,
                                            std::chrono::nanoseconds timeout) {
  return std::make_unique<RefboxClient>(tcp_line(host, port), std::move(team), timeout);
}

}  // namespace trivela::hal::refbox
