#include "pages/serve/broadcast.hpp"

#include <utility>

namespace trivela::pages {

Broadcast::Broadcast(std::vector<std::string> channels)
    : names_(std::move(channels)), newest_(names_.size()), versions_(names_.size()) {}

void Broadcast::publish(std::size_t channel, const std::string& json) {
  auto message = std::make_shared<const std::string>("event: " + names_[channel] + "\ndata: " + json + "\n\n");
  {
    const std::lock_guard lock(mutex_);
    newest_[channel] = std::move(message);
    ++versions_[channel];
  }
  changed_.notify_all();
}

std::vector<Broadcast::Message> Broadcast::wait(Seen& seen, std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  seen.resize(names_.size());
  changed_.wait_for(lock, timeout, [&] { return closed_ || seen != versions_; });
  std::vector<Message> messages;
  if (closed_) return messages;
  for (std::size_t i = 0; i < names_.size(); ++i) {
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
