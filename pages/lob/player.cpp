#include "pages/lob/player.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::pages {

Player::Player(std::vector<std::int64_t> t_ns) : t_ns_(std::move(t_ns)) {}

void Player::play() {
  const auto last = static_cast<std::int64_t>(t_ns_.size()) - 1;
  if (speed_ > 0.0 && position_ + 1 == t_ns_.size()) seek(0);
  if (speed_ < 0.0 && position_ == 0) seek(last);
  playing_ = true;
}

void Player::seek(std::int64_t position) {
  position_ =
      static_cast<std::size_t>(std::clamp<std::int64_t>(position, 0, static_cast<std::int64_t>(t_ns_.size()) - 1));
  now_s_ = kicking::seconds(t_ns_[position_] - t_ns_.front());
}

void Player::advance(double passed_s) {
  if (!playing_) return;
  const double end_s = kicking::seconds(t_ns_.back() - t_ns_.front());
  now_s_ = std::clamp(now_s_ + passed_s * speed_, 0.0, end_s);
  // Rounded: the start of a scan, in seconds and back, is that scan.
  const std::int64_t now_ns = t_ns_.front() + kicking::nanoseconds(now_s_);
  position_ = static_cast<std::size_t>(std::upper_bound(t_ns_.begin(), t_ns_.end(), now_ns) - t_ns_.begin()) - 1;
  const bool at_end = now_ns == (speed_ > 0.0 ? t_ns_.back() : t_ns_.front());
  if (at_end) playing_ = false;
}

}  // namespace trivela::pages
