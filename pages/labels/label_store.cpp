#include "pages/labels/label_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

namespace trivela::pages {
namespace {

using evaluator::NamedKick;
using nlohmann::json;
using nlohmann::ordered_json;

std::string text_at(const json& command, const char* key) {
  const auto value = command.find(key);
  if (value == command.end() || !value->is_string()) throw LabelRefused{fmt::format("the command has no {}", key)};
  return value->get<std::string>();
}

ordered_json json_of(const NamedKick& kick, std::int64_t utc_ms) {
  return {{"kick", kick.name()},
          {"session_id", fmt::format("{}", kick.session_id)},
          {"kick_id", fmt::format("{}", kick.kick_id)},
          {"robot", kick.robot_id},
          {"uuid", kick.uuid},
          {"at_s", kick.at_s},
          {"utc_ms", utc_ms},
          {"policy", kick.policy},
          {"observed", kick.observed},
          {"by_hand", kick.by_hand ? ordered_json(*kick.by_hand) : ordered_json()},
          {"labelled_by", kick.labelled_by.value_or("")}};
}

}  // namespace

LabelStore::LabelStore(std::filesystem::path log) : log_(std::move(log)), additions_(log_) {
  log::Reader reader(log_);
  evaluator::read_opportunities(reader, log_.string(), false);  // from here on each kick once
  std::map<std::tuple<std::int64_t, int, std::int64_t>, std::pair<std::int64_t, std::string>> timelines;
  for (evaluator::KickTimeline& timeline : evaluator::kick_timelines(reader)) {
    timeline.truth.reset();
    timelines[{timeline.session_id, timeline.robot_id, timeline.kick_id}] = {
        timeline.utc_ns / 1'000'000, evaluator::json_of(timeline).dump(-1, ' ', true, json::error_handler_t::replace)};
  }
  kicks_ = evaluator::named_kicks(reader);
  for (const NamedKick& kick : kicks_) {
    auto& [utc_ms, text] = timelines[{kick.session_id, kick.robot_id, kick.kick_id}];
    utc_ms_.push_back(utc_ms);
    timelines_.push_back(std::move(text));
  }
}

ordered_json LabelStore::state() const {
  const std::lock_guard lock(mutex_);
  ordered_json state{{"log", log_.filename().string()}, {"outcomes", log::kLabels}};
  ordered_json& kicks = state["kicks"] = ordered_json::array();
  for (std::size_t i = 0; i < kicks_.size(); ++i) kicks.push_back(json_of(kicks_[i], utc_ms_[i]));
  return state;
}

std::string LabelStore::timeline(std::size_t place) const {
  if (place >= timelines_.size() || timelines_[place].empty())
    throw LabelRefused{fmt::format("there is no kick {}", place)};
  return timelines_[place];
}

void LabelStore::add(const json& command, std::int64_t now_utc_ns) {
  if (!command.is_object()) throw LabelRefused{"a command is an object"};
  const std::string session_id = text_at(command, "session_id"), kick_id = text_at(command, "kick_id");
  const std::lock_guard lock(mutex_);
  const auto kick = std::ranges::find_if(kicks_, [&](const NamedKick& one) {
    return fmt::format("{}", one.session_id) == session_id && fmt::format("{}", one.kick_id) == kick_id &&
           command.value("robot", json()) == json(one.robot_id);
  });
  if (kick == kicks_.end()) throw LabelRefused{"the log has no such kick"};
  log::Label label{.session_id = kick->session_id,
                   .robot_id = kick->robot_id,
                   .kick_id = kick->kick_id,
                   .t_ns = kick->t_ns,
                   .outcome = std::nullopt,
                   .who = text_at(command, "who"),
                   .note = text_at(command, "note")};
  if (!command.contains("outcome")) throw LabelRefused{"the command has no outcome"};
  if (!command["outcome"].is_null()) label.outcome = text_at(command, "outcome");
  if (!label.outcome && !kick->by_hand) throw LabelRefused{"the kick has no label to withdraw"};
  additions_.add(label, now_utc_ns);
  kick->by_hand = label.outcome;
  kick->labelled_by = label.outcome ? std::optional(label.who) : std::nullopt;
}

}  // namespace trivela::pages
