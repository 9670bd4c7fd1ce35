#include "cli/manual/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

}  // namespace trivela::cli
