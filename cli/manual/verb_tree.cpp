#include "cli/manual/manual.hpp"

#include <algorithm>
#include <utility>

namespace trivela::cli {
namespace {

/// "TEXT:{a,b}" has a and b.
std::vector<std::string> choices_of(const std::string& type) {
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  std::vector<std::string> choices = CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
  for (std::string& choice : choices) choice = choice.substr(0, choice.find("->"));
  return choices;
}

ManualFlag flag_of(const CLI::Option& option) {
  ManualFlag flag;
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  if (flag.names.empty()) flag.names.push_back(option.get_name());
  if (option.get_items_expected_max() > 0) {
    flag.value = option.get_type_name();
    flag.choices = choices_of(flag.value);
    if (!option.get_default_str().empty()) flag.value += "=" + option.get_default_str();
    if (option.get_items_expected_max() > 1) flag.value += " ...";
  }
  flag.description = option.get_description();
  if (option.get_required()) flag.description += flag.description.empty() ? "required" : "; required";
  return flag;
}

/// A group of options has no name, and what it has is its verb's.
void add_parts(const CLI::App& app, ManualVerb& verb) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    auto& place = option->get_positional() && option->get_lnames().empty() ? verb.arguments : verb.flags;
    ManualFlag flag = flag_of(*option);
    // Each group has the help flag again.
    if (std::ranges::find(place, flag.names, &ManualFlag::names) == place.end()) place.push_back(std::move(flag));
  }
  for (const CLI::App* part : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (part->get_name().empty()) {
      add_parts(*part, verb);
    } else if (!part->get_group().empty()) {
      verb.verbs.push_back(verb_tree(*part, verb.path));
    }
  }
}

}  // namespace

ManualVerb verb_tree(const CLI::App& app, const std::string& above) {
  ManualVerb verb;
  verb.name = app.get_name();
  verb.path = above.empty() ? verb.name : above + " " + verb.name;
  verb.group = app.get_group();
  verb.description = app.get_description();
  verb.footer = app.get_footer();
  add_parts(app, verb);
  return verb;
}

}  // namespace trivela::cli
