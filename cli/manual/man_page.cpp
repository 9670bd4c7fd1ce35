#include "cli/manual/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "config/text/installation.hpp"

namespace trivela::cli {
namespace {

const char* const kEnvironment =
    ".SH ENVIRONMENT\n.TP\n\\fBTRIVELA_CONFIG\\fR\nthe folder of the shipped configuration, before all other places\n"
    ".TP\n\\fBCYCLONEDDS_URI\\fR\nof no effect on nodes, whose network is that of [domain]\n";
const char* const kFiles =
    ".SH FILES\n.TP\n\\fI/etc/trivela\\fR\nconfiguration, where the program has none beside it\n"
    ".TP\n\\fI/etc/trivela/robot.env\\fR\nwhat this machine's nodes are started with\n"
    ".TP\n\\fI/var/lib/trivela\\fR\nlogs\n";

std::string head(const std::string& title, int section) {
  return fmt::format(".TH {} {} \"\" \"trivela {}\" \"Trivela\"\n", title, section, roff(config::software_version()));
}

std::string entry(const ManualFlag& flag) {
  std::string names;
  for (const std::string& name : flag.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
  const std::string value = flag.value.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(flag.value));
  return fmt::format(".TP\n{}{}\n{}\n", names, value, roff(flag.description));
}

std::string synopsis(const ManualVerb& verb) {
  std::string line = fmt::format("\\fB{}\\fR", roff(verb.path));
  if (!verb.flags.empty()) line += " [\\fIOPTIONS\\fR]";
  for (const ManualFlag& argument : verb.arguments) line += fmt::format(" \\fI{}\\fR", roff(argument.names.front()));
  if (!verb.verbs.empty()) line += " \\fIVERB\\fR ...";
  return line + "\n";
}

std::string flags_of(const ManualVerb& verb) {
  std::string page;
  for (const auto* part : {&verb.arguments, &verb.flags})
    for (const ManualFlag& flag : *part) page += entry(flag);
  return page;
}

std::string section_of(const ManualVerb& verb) {
  std::string page =
      fmt::format(".SS {}\n{}.PP\n{}\n{}", roff(verb.path), synopsis(verb), roff(verb.description), flags_of(verb));
  if (!verb.footer.empty()) page += fmt::format(".PP\n{}\n", roff(verb.footer));
  for (const ManualVerb& below : verb.verbs) page += section_of(below);
  return page;
}

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

std::string roff(const std::string& text) {
  std::string shown;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) shown += "\\&";
    if (c == '\\') {
      shown += "\\e";
    } else if (c == '-') {
      shown += "\\-";
    } else if (c == '\n') {
      shown += line_begins ? "" : "\n.br\n";
    } else {
      shown += c;
    }
    line_begins = c == '\n';
  }
  return shown;
}

std::string man_page(const ManualVerb& program) {
  std::string page = head("TRIVELA", 1) +
                     fmt::format(".SH NAME\n{} \\- {}\n", program.name, roff(program.description)) + ".SH SYNOPSIS\n" +
                     synopsis(program) + ".SH OPTIONS\n" + flags_of(program);
  std::string group;
  for (const ManualVerb& verb : program.verbs) {
    if (verb.group != group) page += fmt::format(".SH VERBS: {}\n", roff(verb.group));
    group = verb.group;
    page += section_of(verb);
  }
  page += fmt::format(".SH NOTES\n{}\n", roff(program.footer));
  return page + kEnvironment + kFiles + ".SH SEE ALSO\n.BR trivela\\-nodes (8)\n";
}

std::string nodes_man_page(const std::vector<std::string>& nodes, const ManualVerb& node) {
  std::string page =
      head("TRIVELA\\-NODES", 8) + fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                                               roff(fmt::format("{}", fmt::join(nodes, ", "))), roff(node.description));
  for (const std::string& name : nodes) page += fmt::format("\\fB{}\\fR [\\fIOPTIONS\\fR]\n.br\n", roff(name));
  page +=
      ".SH DESCRIPTION\nEach is a process of its own. SIGTERM and SIGINT end it well: the kicker's driver tells the "
      "capacitor to "
      "empty, the recorder finalises its log. With systemd each is an instance of \\fItrivela@.service\\fR, such as "
      "trivela@odometry: the node says when it is ready, and that it lives while its loops come round. Without systemd "
      "\\fBtrivela\\-launch\\fR starts those that \\fIrobot.env\\fR names.\n.SH OPTIONS\n";
  page += flags_of(node);
  page += ".SH EXIT STATUS\n0 stopped on request, 1 failed, 2 bad usage\n";
  return page + kEnvironment + kFiles + ".SH SEE ALSO\n.BR trivela (1)\n";
}

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
