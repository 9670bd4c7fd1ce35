#include "nodes/team_link/team_link_node.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "bus/executor.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {
namespace {

bus::ReaderOptions looking_on() {
  bus::ReaderOptions options;
  options.observer = true;
  return options;
}

template <class T>
robot::LatestSample<T> last_word(bus::Mailbox<T>& mailbox) {
  return {mailbox.latest(), mailbox.received_ns(0)};
}

std::string name_of(std::uint8_t participant) {
  return participant == 0 ? "the base" : fmt::format("robot {}", participant);
}

}  // namespace

bus::DomainConfig team_domain(const config::Settings& settings, const std::string& keys) {
  const config::TeamLink& link = settings.team_link;
  if (link.dds_file.empty())
    throw std::runtime_error{"team_link.dds_file is empty: trivela team configure writes the team's bus"};
  if (link.domain_id == settings.domain.domain_id)
    throw std::runtime_error{
        fmt::format("team_link.domain_id = {}: is the machine's own bus (domain.domain_id)", link.domain_id)};
  bus::DomainConfig domain = bus::from_file(link.domain_id, link.dds_file);
  if (keys.empty()) return domain;
  return bus::secured(domain, std::filesystem::path{keys} / key_folder_of(settings) / "team", "team_bus");
}

TeamLinkNode::TeamLinkNode(NodeContext& context, const bus::DomainConfig& team_bus)
    : context_(context),
      base_(context.settings.team_link.base),
      own_(base_ ? 0 : context.robot_id()),
      node_(context.participant, "team_link"),
      received_out_(node_.writer<msg::TeamHeard>()),
      peers_(own_, context.steady_ns()) {
  const bool takes_referee = !base_ && context.settings.team_link.referee;
  if (takes_referee) {
    referee_out_.emplace(node_.writer<msg::Referee>(referee_of(own_)));
    reject_duplicate_node(context_, *referee_out_, "referee");
  }
  if (base_) {
    listen_to_referee();
  } else {
    listen_to_robot();
  }
  member_.emplace(context, team_bus, own_, takes_referee);
  node_.every(base_ ? kBasePeriod : kRobotPeriod, "team_state", [this] { say_state(); });
  node_.on_device(
      "team", [this](std::chrono::nanoseconds timeout) { return member_->next(timeout); },
      [this](const TeamMember::ReceivedMessage& received) { receive(received); },
      bus::writes<msg::TeamHeard, msg::Referee>());
}

void TeamLinkNode::listen_to_robot() {
  robot_ = {node_.stores<msg::WorldState>(looking_on()),   node_.stores<msg::KickerStatus>(looking_on()),
            node_.stores<msg::KickDecision>(looking_on()), node_.stores<msg::Referee>(looking_on()),
            node_.stores<msg::VisionFrame>(looking_on()),  node_.stores<msg::DriveCommand>(looking_on())};
}

/// The box's word is one for the whole team, so that of one robot goes out for all of them.
void TeamLinkNode::listen_to_referee() {
  node_.on<msg::Referee>(
      [this](msg::Referee word) {
        if (word.robot_id != context_.robot_id()) return;
        word.robot_id = own_;
        {
          const std::lock_guard lock{mutex_};
          referee_ = {word, context_.steady_ns()};
        }
        member_->say(word);
      },
      {}, looking_on());
}

msg::TeamSummary TeamLinkNode::summary() {
  const std::int64_t now = context_.steady_ns();
  if (base_) return robot::base_summary(referee_, now);
  return robot::robot_summary({.world = last_word(*robot_.world),
                               .kicker = last_word(*robot_.kicker),
                               .decision = last_word(*robot_.decision),
                               .referee = last_word(*robot_.referee),
                               .vision_received_ns = last_word(*robot_.vision).received_ns,
                               .drive_received_ns = last_word(*robot_.drive).received_ns},
                              now);
}

void TeamLinkNode::say_state() {
  msg::TeamState state{};
  {
    const std::lock_guard lock{mutex_};
    state.summary = summary();
    peers_.fill(state, context_.steady_ns());
  }
  member_->say(state);
}

void TeamLinkNode::receive(const TeamMember::ReceivedMessage& received) {
  const std::lock_guard lock{mutex_};
  std::visit([&](const auto& word) { receive(word, received.t_ns); }, received.word);
}

void TeamLinkNode::receive(const msg::TeamState& state, std::int64_t t_ns) {
  if (peers_.is_duplicate(state)) return report_duplicate();
  const auto news = peers_.received(state, t_ns);
  if (!news) return;
  if (base_) note_alarms(news->other_robot_id, news->summary.alarms);
  received_out_.write(*news);
}

void TeamLinkNode::receive(const msg::Referee& word, std::int64_t t_ns) {
  if (word.robot_id != 0 || !referee_out_) return;
  if (const auto ours = peers_.own_referee(word, t_ns)) referee_out_->write(*ours);
}

/// What the base's log tells of a robot; a word each time that it changes.
void TeamLinkNode::note_alarms(std::uint8_t other, std::uint32_t alarms) {
  if (alarms_[other] == alarms) return;
  alarms_[other] = alarms;
  if (alarms == 0) {
    context_.logger->info("{}: no alarm any more", name_of(other));
  } else {
    context_.logger->warn("{}: {}", name_of(other), robot::alarm_words(alarms));
  }
}

void TeamLinkNode::report_duplicate() {
  constexpr std::int64_t kPause_ns = 10'000'000'000;
  const std::int64_t now = context_.steady_ns();
  if (duplicate_told_ns_ != 0 && now - duplicate_told_ns_ < kPause_ns) return;
  duplicate_told_ns_ = now;
  context_.logger->error("somebody else says on the team's bus that it is {}: one of the two is configured wrongly",
                         name_of(own_));
}

int team_link_main(int argc, char** argv) {
  return node_main(argc, argv, "team_link", [](NodeContext& context) {
    TeamLinkNode node{context, team_domain(context.settings, context.keys)};
    // On the team's bus silence is no fault of this node: nobody watches its inputs.
    const auto kind = context.settings.run.lockstep ? bus::Executor::kWaitset : bus::Executor::kListener;
    bus::Executor{kind, context.stop, {&node.node()}, context.watchdog_hook()}.run();
  });
}

}  // namespace trivela::nodes
