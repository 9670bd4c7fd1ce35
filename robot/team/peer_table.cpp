#include "robot/team/peer_table.hpp"

#include <algorithm>

namespace trivela::robot {
namespace {

constexpr std::uint8_t kBase = 0;

}  // namespace

std::optional<msg::TeamHeard> PeerTable::received(const msg::TeamState& state, std::int64_t now_ns) {
  if (state.robot_id == own_) return std::nullopt;
  Other& other = others_[state.robot_id];
  if (other.started_t_ns != state.started_t_ns) other = {.started_t_ns = state.started_t_ns};
  other.clocks.received({state.t_ns, now_ns});
  // What another life of ours said was perhaps by another clock.
  const bool ours = state.echoes && state.echo_robot_id == own_;
  if (ours && state.echo_t_ns >= started_ns_ && state.echo_t_ns <= now_ns)
    other.clocks.told({state.echo_t_ns, state.echo_heard_t_ns});
  if (state.seq <= other.seq) return std::nullopt;
  other.seq = state.seq;
  msg::TeamHeard news{};
  news.robot_id = own_;
  news.other_robot_id = state.robot_id;
  news.seq = ++received_seq_;
  news.t_ns = now_ns;
  if (const auto offset = other.clocks.estimate(now_ns)) {
    news.clock_known = true;
    news.offset_ns = offset->offset_ns;
    news.error_ns = offset->error_ns;
  }
  news.summary = state.summary;
  return news;
}

void PeerTable::fill(msg::TeamState& state, std::int64_t now_ns) {
  state.robot_id = own_;
  state.seq = ++seq_;
  state.t_ns = now_ns;
  state.started_t_ns = started_ns_;
  auto next = others_.upper_bound(last_echoed_);
  for (std::size_t asked = 0; asked < others_.size(); ++asked, ++next) {
    if (next == others_.end()) next = others_.begin();
    const auto quickest = next->second.clocks.quickest(now_ns);
    if (!quickest) continue;
    state.echoes = true;
    state.echo_robot_id = last_echoed_ = next->first;
    state.echo_t_ns = quickest->sent_t_ns;
    state.echo_heard_t_ns = quickest->received_t_ns;
    return;
  }
}

std::optional<OffsetEstimate> PeerTable::offset(std::uint8_t other, std::int64_t now_ns) {
  const auto known = others_.find(other);
  return known == others_.end() ? std::nullopt : known->second.clocks.estimate(now_ns);
}

std::optional<msg::Referee> PeerTable::own_referee(msg::Referee word, std::int64_t now_ns) {
  const auto base = others_.find(kBase);
  const auto offset = this->offset(kBase, now_ns);
  if (base == others_.end() || !offset) return std::nullopt;
  if (base->second.started_t_ns != base_started_ns_) last_word_t_ns_ = 0;
  base_started_ns_ = base->second.started_t_ns;
  if (word.t_ns < last_word_t_ns_ || !is_instant(word.t_ns)) return std::nullopt;
  last_word_t_ns_ = word.t_ns;
  word.robot_id = own_;
  word.seq = ++referee_seq_;
  word.t_ns = std::min(word.t_ns - offset->offset_ns - offset->error_ns, now_ns);
  return word;
}

}  // namespace trivela::robot
