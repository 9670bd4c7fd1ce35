#include "cli/manual/manual.hpp"
#include "nodes/runtime/node_flags.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

namespace trivela::cli {
namespace {

/// The text in single quotes, as all three shells read it.
std::string quoted(const std::string& text, const char* quote = "'\\''") {
  std::string shown = "'";
  for (const char c : text) shown += c == '\'' ? std::string{quote} : std::string{c};
  return shown + "'";
}

void each_verb(const ManualVerb& verb, const std::function<void(const ManualVerb&)>& see) {
  see(verb);
  for (const ManualVerb& below : verb.verbs) each_verb(below, see);
}

/// Lines of two associative arrays: what may stand after a verb, and after a flag of it ("" where anything may).
std::string tables(const ManualVerb& program) {
  std::string below = "  local -A below=(\n", values = "  local -A values=(\n";
  each_verb(program, [&](const ManualVerb& verb) {
    std::vector<std::string> words;
    for (const ManualVerb& part : verb.verbs) words.push_back(part.name);
    for (const ManualFlag& flag : verb.flags) {
      words.insert(words.end(), flag.names.begin(), flag.names.end());
      if (flag.value.empty()) continue;
      for (const std::string& name : flag.names)
        values += fmt::format("    [{}]={}\n", quoted(verb.path + " " + name),
                              quoted(fmt::format("{}", fmt::join(flag.choices, " "))));
    }
    below += fmt::format("    [{}]={}\n", quoted(verb.path), quoted(fmt::format("{}", fmt::join(words, " "))));
  });
  return below + "  )\n" + values + "  )\n";
}

const char* const kBash = R"(  local at=trivela now=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} i
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ -z ${below["$at ${COMP_WORDS[i]}"]+there} ]] || at="$at ${COMP_WORDS[i]}"
  done
  COMPREPLY=()
  if [[ -n ${values["$at $before"]+there} ]]; then
    [[ -z ${values["$at $before"]} ]] || mapfile -t COMPREPLY < <(compgen -W "${values["$at $before"]}" -- "$now")
  else
    mapfile -t COMPREPLY < <(compgen -W "${below["$at"]}" -- "$now")
  fi
}
complete -o default -F _trivela trivela
)";

const char* const kZsh = R"(  local at=trivela word before=${words[CURRENT-1]}
  for word in ${words[2,CURRENT-1]}; do
    (( ! ${+below[$at $word]} )) || at="$at $word"
  done
  if (( ${+values[$at $before]} )); then
    if [[ -n ${values[$at $before]} ]]; then compadd -- ${=values[$at $before]}; else _files; fi
  else
    compadd -- ${=below[$at]}
    _files
  fi
}
)";

/// A verb's lines for fish, each with the condition that it and no verb below it was said.
std::string fish_lines(const ManualVerb& verb, const std::string& said) {
  std::vector<std::string> names;
  for (const ManualVerb& part : verb.verbs) names.push_back(part.name);
  std::string where = said;
  if (!names.empty())
    where += fmt::format("{}not __fish_seen_subcommand_from {}", where.empty() ? "" : "; and ", fmt::join(names, " "));
  const std::string condition = where.empty() ? "" : " -n " + quoted(where, "\\'");
  std::string lines;
  for (const ManualVerb& part : verb.verbs)
    lines += fmt::format("complete -c trivela{} -a {} -d {}\n", condition, part.name, quoted(part.description, "\\'"));
  for (const ManualFlag& flag : verb.flags) {
    lines += "complete -c trivela" + condition;
    for (const std::string& name : flag.names)
      lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!flag.value.empty()) lines += " -r";
    if (!flag.choices.empty())
      lines += fmt::format(" -f -a {}", quoted(fmt::format("{}", fmt::join(flag.choices, " "))));
    lines += fmt::format(" -d {}\n", quoted(flag.description, "\\'"));
  }
  for (const ManualVerb& part : verb.verbs)
    lines += fish_lines(
        part, fmt::format("{}{}__fish_seen_subcommand_from {}", said, said.empty() ? "" : "; and ", part.name));
  return lines;
}

std::string page_of_nodes() {
  CLI::App node{"Trivela's nodes", "trivela-NODE"};
  nodes::NodeFlags flags;
  nodes::add_node_flags(node, flags);
  return nodes_man_page(CLI::detail::split(TRIVELA_NODE_NAMES, ','), verb_tree(node));
}

}  // namespace

std::string bash_completion(const ManualVerb& program) {
  return "# bash completion for trivela, made by `trivela --completion bash`\n_trivela() {\n" + tables(program) + kBash;
}

std::string zsh_completion(const ManualVerb& program) {
  return "#compdef trivela\n# made by `trivela --completion zsh`\n_trivela() {\n" + tables(program) + kZsh +
         "if [[ $funcstack[1] == _trivela ]]; then _trivela \"$@\"; else compdef _trivela trivela; fi\n";
}

std::string fish_completion(const ManualVerb& program) {
  return "# fish completion for trivela, made by `trivela --completion fish`\n" + fish_lines(program, "");
}

void add_manual_flags(CLI::App& app) {
  const auto man = [&app](const std::string& page) {
    fmt::print("{}", page == "nodes" ? page_of_nodes() : man_page(verb_tree(app)));
    throw CLI::Success{};
  };
  app.add_option_function<std::string>("--man", man, "The manual page of the verbs or of the nodes, for man -l -")
      ->check(CLI::IsMember{{"verbs", "nodes"}});
  const auto completion = [&app](const std::string& shell) {
    const auto make = shell == "bash" ? bash_completion : shell == "zsh" ? zsh_completion : fish_completion;
    fmt::print("{}", make(verb_tree(app)));
    throw CLI::Success{};
  };
  app.add_option_function<std::string>("--completion", completion, "What a shell completes: its script")
      ->check(CLI::IsMember{{"bash", "zsh", "fish"}});
}

}  // namespace trivela::cli
