#include "emulators/refbox/box_act.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "hal/refbox/words.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::hal::refbox {

std::optional<BoxAct> act_of_key(char key) {
  for (const BoxFaultWord& word : kBoxFaults) {
    if (word.key == key) return word.fault;
  }
  if (key == ' ') return BoxCommand{.kind = CommandKind::kStop};
  if (key == 'E') return BoxCommand{.kind = CommandKind::kEndPart};
  const ParsedCommand letter = read_letter(key, Colour::kCyan);
  const auto* const command = std::get_if<Command>(&letter);
  if (command == nullptr) return std::nullopt;
  BoxCommand said{.kind = command->kind};
  if (command->side != Side::kBoth) said.team = command->side == Side::kOurs ? 0 : 1;
  return said;
}

namespace {

/// The next line of what is left, without its end.
std::string_view take_line(std::string_view& rest) {
  const auto end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  while (true) {
    const auto begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// One line of a script; fails with what is wrong with it.
class ScriptLine {
 public:
  ScriptLine(const std::vector<std::string_view>& words, std::string place) : words_(words), place_(std::move(place)) {}

  BoxStep read(double earliest_s) const {
    const auto at_s = number_of<double>(words_[0]);
    if (!at_s || !std::isfinite(*at_s) || *at_s < 0.0) fail("is no time in seconds", words_[0]);
    if (*at_s < earliest_s) fail(fmt::format("is before the line above it, {}", earliest_s), words_[0]);
    if (words_.size() < 2) fail("has no command", words_[0]);
    return {*at_s, words_[1] == "fault" ? BoxAct{fault()} : BoxAct{said()}};
  }

 private:
  BoxFault fault() const {
    if (words_.size() != 3) fail("wants the name of one fault", words_[1]);
    for (const BoxFaultWord& known : kBoxFaults) {
      if (known.name == words_[2]) return known.fault;
    }
    fail("is no fault", words_[2]);
  }

  BoxCommand said() const {
    const auto kind = kind_of(words_[1]);
    if (!kind) fail("is no command", words_[1]);
    BoxCommand said{.kind = *kind};
    if (words_.size() > 2) said.team = team(words_[2]);
    if (words_.size() > 3) {
      said.robot_id = number_of<int>(words_[3]);
      if (!said.robot_id || *said.robot_id < 0 || *said.robot_id > 255) fail("is no robot's number", words_[3]);
    }
    if (words_.size() > 4) fail("is one word too many", words_[4]);
    return said;
  }

  std::size_t team(std::string_view word) const {
    if (word != "left" && word != "right") fail("is neither left nor right", word);
    return word == "left" ? 0 : 1;
  }

  [[noreturn]] void fail(const std::string& what, std::string_view value) const {
    throw std::runtime_error{fmt::format("{}: \"{}\" {}", place_, kicking::printable(value), what)};
  }

  const std::vector<std::string_view>& words_;
  std::string place_;
};

/// The teams of a log's objects: the first that is named is the left one.
class LoggedTeams {
 public:
  std::optional<BoxCommand> said(const std::string& object) {
    const auto json = nlohmann::json::parse(object, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    const auto target = json.find("targetTeam");
    if (left_.empty() && target != json.end() && target->is_string()) left_ = target->get<std::string>();
    const ParsedCommand word = read_object(object, left_);
    const auto* const command = std::get_if<Command>(&word);
    if (command == nullptr) return std::nullopt;
    return from(*command);
  }

  /// Of a box since 2020: "robotID:N," where it is of a robot, then the team's name. The first name is the left one's.
  BoxCommand said(CommandKind kind, std::string_view behind) {
    BoxCommand said{.kind = kind};
    constexpr std::string_view kRobot = "robotID:";
    if (const auto place = behind.find(kRobot); place != std::string_view::npos) {
      const std::string_view number = behind.substr(place + kRobot.size());
      const auto robot_id = number_of<int>(number.substr(0, number.find(',')));
      if (robot_id && *robot_id >= 0 && *robot_id <= 255) said.robot_id = robot_id;
    }
    if (kind == CommandKind::kStop) return said;  // everybody's
    const std::string_view name = behind.substr(behind.rfind(',') + 1);
    if (name.empty()) return said;
    if (left_.empty()) left_ = name;
    said.team = name == left_ ? 0 : 1;
    return said;
  }

  static BoxCommand from(const Command& command) {
    BoxCommand said{.kind = command.kind, .robot_id = command.robot_id};
    if (command.side != Side::kBoth) said.team = command.side == Side::kOurs ? 0 : 1;
    return said;
  }

 private:
  std::string left_;
};

/// What a line's code says: everything after the third comma of the line.
std::optional<BoxCommand> logged(std::string_view code, LoggedTeams& teams) {
  if (code.starts_with('{')) return teams.said(std::string(code.substr(0, code.rfind('}') + 1)));
  const std::string_view word = code.substr(0, code.find(','));
  if (word.size() == 1) {
    const ParsedCommand read = read_letter(word[0], Colour::kCyan);
    const auto* const command = std::get_if<Command>(&read);
    return command ? std::optional{LoggedTeams::from(*command)} : std::nullopt;
  }
  const auto kind = kind_of(word);
  if (!kind) return std::nullopt;
  if (name(*kind) == word) return BoxCommand{.kind = *kind};
  return teams.said(*kind, code.substr(std::min(word.size() + 1, code.size())));
}

}  // namespace

std::vector<BoxStep> read_box_script(std::string_view text, const std::string& name) {
  std::vector<BoxStep> steps;
  for (int number = 1; !text.empty(); ++number) {
    const auto words = words_of(take_line(text));
    if (words.empty()) continue;
    const ScriptLine line{words, fmt::format("{}:{}", name, number)};
    steps.push_back(line.read(steps.empty() ? 0.0 : steps.back().at_s));
  }
  return steps;
}

std::vector<BoxStep> read_box_log(std::string_view text, const std::string& name) {
  std::vector<BoxStep> steps;
  std::optional<std::int64_t> first_ms;
  LoggedTeams teams;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const auto ms = number_of<std::int64_t>(line.substr(0, line.find(',')));
    for (int comma = 0; comma < 3 && !line.empty(); ++comma)
      line.remove_prefix(std::min(line.find(','), line.size() - 1) + 1);
    const auto said = ms ? logged(line, teams) : std::nullopt;
    if (!said) continue;
    if (!first_ms) first_ms = ms;
    const double at_s = (static_cast<double>(*ms) - static_cast<double>(*first_ms)) * 1e-3;  // no time overflows
    steps.push_back({std::max(at_s, steps.empty() ? 0.0 : steps.back().at_s), *said});       // a clock may be set back
  }
  if (steps.empty()) throw std::runtime_error{fmt::format("{} holds no command of a referee box", name)};
  return steps;
}

}  // namespace trivela::hal::refbox
