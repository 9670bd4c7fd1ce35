#include "nodes/runtime/lockstep.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <string>

namespace trivela::nodes {
namespace {

constexpr std::chrono::seconds kTimeout{20};
constexpr std::chrono::milliseconds kPollInterval{100};  // how often a stop is looked for

}  // namespace

bool LockstepBarrier::finished(std::int64_t t_ns) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].t_ns < due(i, t_ns)) return false;
  }
  return nodes_[msg::STEP_KICKER_DRIVER].orders == nodes_[msg::STEP_KICK_DECISION].orders;
}

bool LockstepBarrier::wait_for(std::int64_t t_ns, const bus::Stop& stop) {
  auto last_news = std::chrono::steady_clock::now();
  for (;;) {
    const std::size_t taken = reader_.take([this](const msg::StepDone& done) {
      if (done.robot_id == robot_id_ && done.node < nodes_.size())
        nodes_[done.node] = {done.t_ns, done.orders, done.fires, done.lever_kind};
    });
    if (finished(t_ns)) return true;
    if (stop.requested()) return false;
    if (taken > 0) last_news = std::chrono::steady_clock::now();
    if (std::chrono::steady_clock::now() - last_news > kTimeout) {
      std::string missing;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].t_ns < due(i, t_ns)) missing += std::string{" "} + bus::label(static_cast<msg::StepNode>(i));
      }
      throw std::runtime_error{fmt::format("cycle of t {} ns was not finished within 20 s by:{}", t_ns,
                                           missing.empty() ? " kicker_driver (an order is unanswered)" : missing)};
    }
    reader_.wait(kPollInterval);
  }
}

}  // namespace trivela::nodes
