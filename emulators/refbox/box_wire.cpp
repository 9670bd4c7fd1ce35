#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emulators/refbox/emulated_box.hpp"

namespace trivela::hal::refbox {
namespace {

/// The letter that the old protocol has for a command of the team in cyan, or of both.
std::string letter_of(const BoxCommand& said) {
  const Colour colour = said.team == std::size_t{1} ? Colour::kMagenta : Colour::kCyan;
  const Side side = said.team ? Side::kOurs : Side::kBoth;
  for (char letter = '!'; letter <= '~'; ++letter) {
    const ParsedCommand word = read_letter(letter, colour);
    const auto* const command = std::get_if<Command>(&word);
    if (command != nullptr && command->kind == said.kind && command->side == side) return {letter};
  }
  return {};
}

}  // namespace

std::string wire_text(const BoxCommand& said, const BoxConfig& config) {
  if (config.protocol == Protocol::kLetters) return letter_of(said);
  nlohmann::json object{{"command", name(said.kind)}, {"targetTeam", said.team ? config.groups.at(*said.team) : ""}};
  if (said.robot_id) object["robotID"] = *said.robot_id;
  if (said.kind == CommandKind::kWelcome) object["emulated"] = true;  // a key more, which teams pass over
  return object.dump() + '\0';
}

std::optional<std::string> worldstate_problem(std::string_view object) {
  const auto json = nlohmann::json::parse(object, nullptr, false);
  if (!json.is_object()) return "it is no JSON object";
  for (const char* const key : {"type", "teamName", "intention"}) {
    if (!json.contains(key) || !json[key].is_string()) return fmt::format("it has no text \"{}\"", key);
  }
  if (json["type"] != "worldstate") return "its type is not \"worldstate\"";
  if (!json.contains("ageMs") || !json["ageMs"].is_number()) return "it has no number \"ageMs\"";
  for (const char* const key : {"robots", "balls", "obstacles"}) {
    if (!json.contains(key) || !json[key].is_array()) return fmt::format("it has no array \"{}\"", key);
  }
  return std::nullopt;
}

}  // namespace trivela::hal::refbox
