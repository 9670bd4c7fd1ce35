#include "hal/refbox/words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

#include "kicking/text/printable.hpp"

namespace trivela::hal::refbox {

void Framing::extend(std::string_view part) {
  if (overlong_) return;
  if (pending_.size() + part.size() > kLongestObject_B) {
    overlong_ = true;
    std::string{}.swap(pending_);
    return;
  }
  pending_ += part;
}

std::vector<Framed> Framing::add(std::string_view bytes) {
  std::vector<Framed> whole;
  for (auto end = bytes.find('\0'); end != std::string_view::npos; end = bytes.find('\0')) {
    extend(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
    std::string text = std::exchange(pending_, {});
    const bool overlong = std::exchange(overlong_, false);
    if (overlong || text.find_first_not_of(" \t\r\n") != std::string::npos)
      whole.push_back({std::move(text), overlong});
  }
  extend(bytes);
  return whole;
}

namespace {

/// The beginning of what came, for a line of a log.
std::string shown(std::string_view text) {
  constexpr std::size_t kShown_B = 120;
  const std::string begin = kicking::printable(text.substr(0, kShown_B));
  return text.size() > kShown_B ? begin + " ..." : begin;
}

NoCommand no_command(std::string_view what, std::string_view object) {
  return {fmt::format("{}: {}", what, shown(object))};
}

Side side_of(std::string_view target, std::string_view group) {
  if (target.empty()) return Side::kBoth;
  if (target == group) return Side::kOurs;
  const bool of_two_alike = target.ends_with(":1") && target.substr(0, target.size() - 2) == group;
  return of_two_alike ? Side::kOurs : Side::kTheirs;
}

}  // namespace

ParsedCommand read_object(std::string_view object, std::string_view group) {
  const auto json = nlohmann::json::parse(object, nullptr, false);
  if (json.is_discarded()) return no_command("what is no JSON", object);
  if (!json.is_object()) return no_command("JSON that is no object", object);
  const auto text_of = [&](const char* key) -> const std::string* {
    const auto found = json.find(key);
    return found == json.end() ? nullptr : found->get_ptr<const std::string*>();
  };
  const std::string* const word = text_of("command");
  if (word == nullptr) return no_command("an object without a command", object);
  const auto kind = kind_of(*word);
  if (!kind) return no_command("a command that nobody knows", object);
  Command command{.kind = *kind};
  const auto target = json.find("targetTeam");
  if (target != json.end() && !target->is_null() &&
      *kind != CommandKind::kStop) {  // a stop is everybody's, whatever else it says
    const std::string* const team = text_of("targetTeam");
    if (team == nullptr) return no_command("a targetTeam that is no text", object);
    command.side = side_of(*team, group);
  }
  if (const auto robot = json.find("robotID"); robot != json.end() && robot->is_number_integer()) {
    const auto number = robot->get<std::int64_t>();
    if (number >= 0 && number <= 255) command.robot_id = static_cast<int>(number);
  }
  if (const auto emulated = json.find("emulated"); emulated != json.end() && emulated->is_boolean())
    command.emulated = *kind == CommandKind::kWelcome && emulated->get<bool>();
  return command;
}

ParsedCommand read_letter(char letter, Colour ours) {
  const auto known = trivela::refbox::word_of_letter(letter);
  if (!known) return no_command("a letter that nobody knows", std::string_view{&letter, 1});
  if (!known->team) return Command{known->kind, Side::kBoth};
  return Command{known->kind, *known->team == ours ? Side::kOurs : Side::kTheirs};
}

std::optional<std::string_view> CommandStream::wrong_protocol() const {
  if (!objects_for_letters_) return std::nullopt;
  return "it speaks objects, not letters: set refbox.letters = false";
}

std::vector<ParsedCommand> CommandStream::letters(std::string_view bytes) {
  std::vector<ParsedCommand> words;
  for (const char letter : bytes) {
    objects_for_letters_ = objects_for_letters_ || letter == '{';
    if (objects_for_letters_) break;
    const bool space = letter == '\0' || letter == '\n' || letter == '\r' || letter == ' ';
    if (!space) words.push_back(read_letter(letter, team_.colour));
  }
  return words;
}

std::optional<ParsedCommand> CommandStream::no_object(std::string_view bytes) {
  using namespace std::string_view_literals;
  const auto first = bytes.find_first_not_of(" \t\r\n\0"sv);
  if (begun_ || first == std::string_view::npos) return std::nullopt;
  begun_ = true;
  if (bytes[first] == '{') return std::nullopt;
  return no_command("a beginning that is no object (of a box that speaks letters? refbox.letters = true)",
                    bytes.substr(first, 1));
}

std::vector<ParsedCommand> CommandStream::add(std::string_view bytes) {
  if (team_.protocol == Protocol::kLetters) return letters(bytes);
  std::vector<ParsedCommand> words;
  if (auto word = no_object(bytes)) words.push_back(std::move(*word));
  for (const Framed& framed : framing_.add(bytes)) {
    words.push_back(framed.overlong
                        ? ParsedCommand{NoCommand{fmt::format("an object of over {} bytes", kLongestObject_B)}}
                        : read_object(framed.text, team_.group));
  }
  return words;
}

}  // namespace trivela::hal::refbox
