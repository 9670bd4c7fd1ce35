#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/import/refbox.hpp"
#include "cli/launch/log_claim.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::cli {
namespace {

namespace imports = evaluator::imports;

struct RefboxArguments {
  std::vector<std::string> files;
  std::string out;
  std::string team = "cyan";
  bool json = false;
};

const imports::RefereeLog& one_text_log(const imports::BoxLogs& logs) {
  if (logs.referee.empty())
    throw UsageError("--out needs the box's text log, TIME.msl: team logs do not say when the game ran");
  if (logs.referee.size() > 1)
    throw UsageError(fmt::format("--out makes a log of one match, and these are {} text logs: {} and {}",
                                 logs.referee.size(), logs.referee[0].file, logs.referee[1].file));
  return logs.referee.front();
}

imports::BoxSide side_called(const std::string& name) {
  return name == "magenta" || name == "right" ? imports::BoxSide::kMagenta : imports::BoxSide::kCyan;
}

const imports::SidedTeamLog* team_of(const imports::BoxLogs& logs, const std::string& side) {
  const auto of_side = [&](const imports::SidedTeamLog& team) { return side == side_name(team.side); };
  const auto team = std::ranges::find_if(logs.teams, of_side);
  if (team == logs.teams.end()) return nullptr;
  if (std::ranges::count_if(logs.teams, of_side) > 1)
    throw UsageError(fmt::format("--out makes a log of one match, and several logs are of the {} team", side));
  return &*team;
}

/// What the match log and its reports say of where it is from.
std::vector<std::string> sentences_of(const imports::RefereeLog& referee, const imports::SidedTeamLog* team,
                                      const std::vector<std::string>& faults) {
  std::vector<std::string> sentences{fmt::format(
      "imported from the referee box's {}: {} commands, no kick decision in it", referee.file, referee.lines.size())};
  if (team != nullptr) {
    sentences.push_back(
        fmt::format("world states as {} ({}) sent to the box in {}, by game time; what it does not receive is "
                    "none, standard deviations stand as 0",
                    team->log.team, side_name(team->side), team->log.file));
  }
  for (const std::string& fault : faults) sentences.push_back("fault: " + fault);
  for (std::string& sentence : sentences) sentence = kicking::printable(sentence);
  return sentences;
}

std::string write_log(const imports::BoxLogs& logs, const RefboxArguments& arguments) {
  const imports::RefereeLog& referee = one_text_log(logs);
  const imports::BoxSide ours = side_called(arguments.team);
  const imports::SidedTeamLog* const team = team_of(logs, side_name(ours));
  const ImportedRows rows =
      write_match_log(referee, ours, team, sentences_of(referee, team, logs.faults()), arguments.out);
  std::string text =
      fmt::format("{}: {} commands of the referee, {} world states", arguments.out, rows.referee, rows.world_states);
  if (team != nullptr) text += fmt::format(" of the {} team", arguments.team);
  if (rows.without_velocity > 0) text += fmt::format("; {} without a velocity left out", rows.without_velocity);
  if (logs.teams.size() > (team != nullptr ? 1U : 0U)) text += "; --team takes the other team's";
  return text + "\n";
}

int import_refbox(const RefboxArguments& arguments) {
  if (!arguments.out.empty()) const LogClaim before_anything_is_read(arguments.out);
  const imports::BoxLogs logs = imports::read_box_logs({arguments.files.begin(), arguments.files.end()});
  const RefboxSummary summary = summary_of(logs);
  if (arguments.json) {
    fmt::print("{}", to_json(summary));
  } else {
    say(to_text(summary));
  }
  if (!arguments.out.empty()) {
    const std::string written = write_log(logs, arguments);
    if (!arguments.json) say(written);
  }
  const bool nothing = std::ranges::all_of(logs.referee, [](const auto& log) { return log.lines.empty(); }) &&
                       std::ranges::all_of(logs.teams, [](const auto& team) { return team.log.usable.empty(); });
  return nothing ? kFailed : logs.unusable() > 0 ? kDoneWithLoss : kDone;
}

void add_import_refbox(CLI::App& verb, int& exit_code) {
  const auto [subcommand, arguments] =
      add_verb(verb, exit_code, "refbox", "Logs of the league's referee box: the game, their faults", import_refbox);
  subcommand->add_option("files", arguments->files, "TIME.msl, TIME.A.msl (cyan), TIME.B.msl (magenta), or their zip")
      ->required()
      ->type_name("FILE");
  subcommand->add_option("--out", arguments->out, "Match log to make of one match, must not exist")->type_name("DB");
  subcommand
      ->add_option("--team", arguments->team,
                   "Our side, whose robots stand in it: cyan or left, magenta or right (cyan)")
      ->check(CLI::IsMember({"cyan", "magenta", "left", "right"}));
  subcommand->add_flag("--json", arguments->json, "JSON instead of text");
  subcommand->footer(
      R"(Records count in the order of the file and by game time. Ends with 1 where nothing could be used, with 3
where lines or records could not.)");
}

}  // namespace

void add_import(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("import", "What others recorded, as a match log: a referee box, hand labels");
  verb->require_subcommand(1);
  add_import_refbox(*verb, exit_code);
  add_import_kicks(*verb, exit_code);
}

}  // namespace trivela::cli
