#include "bus/node.hpp"

#include <fmt/core.h>

namespace trivela::bus {

Node::Node(Participant participant, std::string name, std::optional<std::uint8_t> robot_id)
    : participant_(std::move(participant)),
      name_(std::move(name)),
      robot_id_(robot_id),
      interrupt_(std::make_shared<Guard>(participant_)) {}

std::string owner_of_robot(std::string_view node, std::uint8_t robot_id) {
  return fmt::format("{}/{}", node, robot_id);
}

std::string Node::owner() const { return robot_id_ ? owner_of_robot(name_, *robot_id_) : name_; }

Node::Slot& Node::add(const std::string& what, std::string input, std::vector<std::string> outputs) {
  auto& slot = slots_.emplace_back(std::make_unique<Slot>());
  slot->reaction = {name_ + "/" + what, std::move(input), std::move(outputs)};
  return *slot;
}

void Node::add_input(std::string name, double period_s, std::function<std::int64_t(std::int64_t)> received_ns) {
  inputs_.push_back({std::move(name), period_s, std::move(received_ns)});
}

std::shared_ptr<LastReceived> Node::listen(std::string input, double period_s) {
  auto received = std::make_shared<LastReceived>();
  add_input(std::move(input), period_s, [received](std::int64_t) { return received->ns(); });
  return received;
}

std::vector<Reaction> Node::reactions() const {
  std::vector<Reaction> reactions;
  for (const auto& slot : slots_) reactions.push_back(slot->reaction);
  return reactions;
}

}  // namespace trivela::bus
