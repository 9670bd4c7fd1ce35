#include "pages/lob/broadcast.hpp"

namespace trivela::pages {
namespace {

constexpr std::array<const char*, Broadcast::kChannels> kNames{"setup", "lobs", "status", "frame"};

}  // namespace

void Broadcast::publish(Channel channel, const std::string& json) {
  const auto place = static_cast<std::size_t>(channel);
  auto message =
      std::make_shared<const std::string>(std::string("event: ") + kNames[place] + "\ndata: " + json + "\n\n");
  {
    const std::lock_guard lock(mutex_);
    newest_[place] = std::move(message);
    ++versions_[place];
  }
  changed_.notify_all();
}

std::vector<Broadcast::Message> Broadcast::wait(Seen& seen, std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return closed_ || seen != versions_; });
  std::vector<Message> messages;
  if (closed_) return messages;
  for (std::size_t i = 0; i < kChannels; ++i) {
    if (seen[i] != versions_[i]) messages.push_back(newest_[i]);
  }
  seen = versions_;
  return messages;
}

void Broadcast::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Broadcast::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace trivela::pages
