#include "robot/referee/set_piece_clock.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

void SetPieceClock::receive(const msg::Referee& word) {
  if (!word.playing) {
    began_t_ns_.reset();
  } else if (announced_ && word.restart == msg::RESTART_NONE) {
    began_t_ns_ = word.t_ns;
    had_ball_ = false;
  }
  announced_ = word.restart != msg::RESTART_NONE && word.ours;
}

kicking::OptionalDouble SetPieceClock::left_s(const msg::WorldState& world) {
  if (!(limit_s_ > 0.0) || !began_t_ns_) return std::nullopt;
  const double left_s = std::min(limit_s_, limit_s_ - kicking::seconds(*began_t_ns_, world.t_ns));
  if (left_s <= 0.0 || (had_ball_ && !world.possession)) began_t_ns_.reset();
  had_ball_ = world.possession;
  return began_t_ns_ ? kicking::OptionalDouble{left_s} : std::nullopt;
}

}  // namespace trivela::robot
