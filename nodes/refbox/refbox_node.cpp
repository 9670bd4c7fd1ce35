#include "nodes/refbox/refbox_node.hpp"

#include <algorithm>
#include <utility>

#include "hal/refbox/worldstate.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/text/printable.hpp"
#include "nodes/runtime/node_main.hpp"
#include "robot/team/team_summary.hpp"

namespace trivela::nodes {
namespace {

using std::chrono::steady_clock;
namespace box = hal::refbox;

constexpr std::int64_t kFreshBelief_ns =
    1'000'000'000;  // of a robot that has said nothing for longer the box hears nothing

std::vector<std::uint32_t> robots_of(const config::Settings& settings) {
  return settings.refbox.robots.empty() ? std::vector{settings.run.robot_id} : settings.refbox.robots;
}

std::string in_words(const box::Command& command) {
  std::string text(box::name(command.kind));
  if (command.side != box::Side::kBoth) text += command.side == box::Side::kOurs ? " for us" : " for them";
  if (command.robot_id) text += ", robot " + std::to_string(*command.robot_id);
  return text;
}

}  // namespace

std::shared_ptr<RefboxLink> open_refbox(const config::Refbox& settings) {
  const bool magenta = settings.colour == config::TeamColour::kMagenta;
  const box::TeamMarks team{.protocol = settings.letters ? box::Protocol::kLetters : box::Protocol::kJson,
                            .group = settings.group,
                            .colour = magenta ? box::Colour::kMagenta : box::Colour::kCyan};
  const std::chrono::nanoseconds timeout{kicking::nanoseconds(settings.acknowledgement_s)};
  auto link = std::make_shared<RefboxLink>();
  link->client = box::refbox_client(settings.host, static_cast<std::uint16_t>(settings.port), team, timeout);
  return link;
}

RefboxNode::RefboxNode(NodeContext& context, std::shared_ptr<RefboxLink> link)
    : context_(context), link_(std::move(link)), node_(context.participant, "refbox"), emulation_(context, node_) {
  const config::Refbox& settings = context.settings.refbox;
  if (context.settings.run.lockstep) throw std::runtime_error{"run.lockstep = true: a referee box waits for nobody"};
  if (settings.group.empty() && !settings.letters)
    throw std::runtime_error{"refbox.group is empty: the referee box names us by our multicast group, 224.16.32.N"};
  for (const std::uint32_t robot_id : robots_of(context.settings))
    robots_.push_back({static_cast<std::uint8_t>(robot_id), node_.writer<msg::Referee>(referee_of(robot_id))});
  for (const Robot& robot : robots_) reject_duplicate_node(context_, robot.referee_out, "referee", robot.robot_id);
  node_.on<msg::WorldState>([this](const msg::WorldState& world) { on_world(world); });
  node_.on<msg::TeamHeard>(
      [this](const msg::TeamHeard& received) {  // on the base: of robots whose own bus is elsewhere
        if (const auto world = robot::world_of(received)) on_world(*world);
      });
  node_.on_device(
      "refbox", [this](std::chrono::nanoseconds timeout) { return next(timeout); },
      [this](const Event& event) { on_event(event); }, bus::writes<msg::Referee, msg::DeviceEmulated>());
}

/// What the box does, and a tick each cycle, by which others see that this thread lives. A flood of commands does not
/// put it off.
std::optional<RefboxNode::Event> RefboxNode::next(std::chrono::nanoseconds timeout) {
  const auto now = steady_clock::now();
  if (now >= next_tick_) {
    next_tick_ = now + context_.cycle();
    return Event{Tick{}};
  }
  const auto event = link_->client->next(std::min<std::chrono::nanoseconds>(timeout, next_tick_ - now));
  return event ? std::optional<Event>{*event} : std::nullopt;
}

void RefboxNode::on_event(const Event& event) {
  if (const auto* const happened = std::get_if<box::BoxEvent>(&event)) {
    std::visit([this](const auto& what) { on_box(what); }, *happened);
  } else {
    on_tick();
  }
}

void RefboxNode::on_tick() {
  const auto now = steady_clock::now();
  if (now < next_telling_) return;
  const std::chrono::nanoseconds period{kicking::nanoseconds(context_.settings.refbox.period_s)};
  emulation_.see(msg::PART_REFEREE_BOX, link_->emulated, context_.steady_ns());
  next_telling_ = std::max(next_telling_ + period, now - period);  // late ones are made up for, but not for ever
  publish();
  tell_box();
}

void RefboxNode::on_box(const box::Connected&) {
  link_->match.connected();
  context_.logger->info("connected to the referee box {}", link_->client->box());
}

void RefboxNode::on_box(const box::Command& command) {
  link_->match.command(command, context_.steady_ns());
  link_->emulated = link_->emulated || command.emulated;
  publish();
  context_.logger->info("referee: {}", in_words(command));
}

void RefboxNode::on_box(const box::NoCommand& word) {
  context_.logger->warn("the referee box said {}", kicking::printable(word.why));
}

void RefboxNode::on_box(const box::Lost& lost) {
  link_->match.disconnected();
  publish();
  context_.logger->error("the referee box {} is lost: {}: the game is stopped", link_->client->box(), lost.why);
}

void RefboxNode::on_box(const box::Unreachable& failure) {
  context_.logger->warn("the referee box {} cannot be reached: {}: the game is stopped", link_->client->box(),
                        failure.why);
}

void RefboxNode::on_world(const msg::WorldState& world) {
  if (!speaks_for(world.robot_id) || !context_.participant.believes(world.t_ns)) return;
  const std::lock_guard lock{worlds_mutex_};
  worlds_.at(world.robot_id) = world;
}

bool RefboxNode::speaks_for(std::uint8_t robot_id) const {
  return std::ranges::any_of(robots_, [robot_id](const Robot& robot) { return robot.robot_id == robot_id; });
}

void RefboxNode::publish() {
  msg::Referee word = link_->match.message(context_.steady_ns());
  word.seq = ++seq_;
  for (const Robot& robot : robots_) {
    word.robot_id = robot.robot_id;
    robot.referee_out.write(word);
  }
}

void RefboxNode::tell_box() {
  const std::int64_t now_ns = context_.steady_ns();
  std::vector<msg::WorldState> fresh;
  {
    const std::lock_guard lock{worlds_mutex_};
    for (const auto& world : worlds_)
      if (world && now_ns - world->t_ns <= kFreshBelief_ns) fresh.push_back(*world);
  }
  const config::Refbox& settings = context_.settings.refbox;
  link_->client->send(box::worldstate_object(fresh, {settings.team_name, settings.intention}, now_ns));
}

int refbox_main(int argc, char** argv) {
  std::shared_ptr<RefboxLink> link;  // one connection, also where the node joins the bus again
  return node_main(argc, argv, "refbox", [&link](NodeContext& context) {
    if (!link) link = open_refbox(context.settings.refbox);
    RefboxNode node{context, link};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
