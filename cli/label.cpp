#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/launch/signals.hpp"
#include "cli/options/match_mode.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/counting/named_kicks.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/text/printable.hpp"
#include "log/write/additions.hpp"
#include "pages/labels/label_server.hpp"

namespace trivela::cli {
namespace {

using evaluator::NamedKick;

struct LabelArguments {
  std::string log;
  std::string kick;
  std::string outcome;
  std::string who;
  std::string note;
  std::string session;
  bool withdraw = false;
  bool serve = false;
  int port = 0;
  std::string config = config::shipped("default.toml").string();
};

std::vector<NamedKick> counted_kicks(const std::string& log) {
  log::Reader reader(log);
  evaluator::read_opportunities(reader, log, false);  // from here on each kick once
  return evaluator::named_kicks(reader);
}

std::string text_of(const NamedKick& kick) {
  return fmt::format("kick {} at {:.2f} s ({})", kick.name(), kick.at_s, kick.policy);
}

int list_kicks(const LabelArguments& arguments) {
  std::vector<std::vector<std::string>> table{{"kick", "at s", "policy", "observer", "by hand", "who"}};
  std::size_t unknown = 0;
  const auto kicks = counted_kicks(arguments.log);
  const bool one_session = std::ranges::all_of(kicks, [&](const auto& kick) { return kick.uuid == kicks[0].uuid; });
  if (!one_session) table[0].emplace_back("--session");
  for (const NamedKick& kick : kicks) {
    unknown += kick.unknown() ? 1 : 0;
    if (!kick.unknown() && !kick.by_hand) continue;
    table.push_back({kick.name(), fmt::format("{:.2f}", kick.at_s), kick.policy,
                     kick.observed.empty() ? "-" : evaluator::words(kick.observed),
                     kick.by_hand ? evaluator::words(*kick.by_hand) : "-",
                     kicking::printable(kick.labelled_by.value_or("-"))});
    if (!one_session) table.back().push_back(kicking::printable(kick.uuid));
  }
  if (table.size() > 1) say(evaluator::text_table(table));
  say(fmt::format("{} of {} kicks are unknown\n", unknown, kicks.size()));
  return kDone;
}

const NamedKick& kick_meant(const std::vector<NamedKick>& kicks, const LabelArguments& arguments) try {
  return evaluator::kick_called(kicks, arguments.kick, arguments.session);
} catch (const std::runtime_error& none) {
  throw UsageError{none.what()};
}

int add_one(const LabelArguments& arguments) {
  const auto kicks = counted_kicks(arguments.log);
  const NamedKick& kick = kick_meant(kicks, arguments);
  if (arguments.withdraw && !kick.by_hand)
    throw std::runtime_error{fmt::format("{} has no label by hand to withdraw", text_of(kick))};
  log::Label label{.session_id = kick.session_id,
                   .robot_id = kick.robot_id,
                   .kick_id = kick.kick_id,
                   .t_ns = kick.t_ns,
                   .outcome = std::nullopt,
                   .who = arguments.who,
                   .note = arguments.note};
  if (!arguments.withdraw) label.outcome = arguments.outcome;
  log::Additions(arguments.log).add(label, log::utc_now_ns());
  const std::string observed = kick.observed.empty() ? "nothing" : evaluator::words(kick.observed);
  say(arguments.withdraw
          ? fmt::format("{}: {} by {} is withdrawn; the observer says {}, and that holds\n", text_of(kick),
                        evaluator::words(*kick.by_hand), kicking::printable(kick.labelled_by.value_or("?")), observed)
          : fmt::format("{}: {}, says {}; the observer says {}\n", text_of(kick), evaluator::words(arguments.outcome),
                        kicking::printable(arguments.who), observed));
  return kDone;
}

int serve(const LabelArguments& arguments) {
  if (!arguments.kick.empty() || arguments.withdraw || !arguments.who.empty() || !arguments.session.empty())
    throw UsageError{"--serve: the page asks for kicks, outcomes and names itself"};
  refuse_in_a_match(config::load_settings(arguments.config), "trivela label --serve");
  SignalInbox signals;  // before all threads, which must not take them
  pages::LabelStore store(arguments.log);
  const pages::LabelServer server(store, arguments.port);
  say(server.url() + '\n');
  std::fflush(stdout);
  while (!signals.stop_requested_within(-1)) continue;
  return kDone;
}

int run_label(const LabelArguments& arguments) {
  if (arguments.serve) return serve(arguments);
  if (arguments.kick.empty()) {
    if (arguments.withdraw || !arguments.who.empty())
      throw UsageError{"say which kick: trivela label LOG KICK OUTCOME"};
    return list_kicks(arguments);
  }
  if (arguments.withdraw == !arguments.outcome.empty()) {
    throw UsageError{fmt::format("say what became of the kick ({}), or --withdraw", fmt::join(log::kLabels, ", "))};
  }
  if (arguments.who.empty()) throw UsageError{"--by WHO: who says so?"};
  return add_one(arguments);
}

}  // namespace

void add_label(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "label", "Say by hand what became of a kick, or list the unknown ones", run_label);
  verb->footer(
      R"(Each label is a row of its own with who and when; nothing is changed or removed, and the observer's class stays
beside it. The latest label of a kick counts before the observer, in report, compare and every metric, which
also say how often the two disagreed. "outside" is a miss that is not said how; --withdraw is a row, too, after
which the observer's class counts again. Without KICK: the kicks that nobody knows, and those labelled. --serve
is a page that steps through them with their replay and a video's time; it prints an address that holds the right
to label, for this machine alone.)");
  verb->add_option("log", arguments->log, "Match log")->required();
  verb->add_option("kick", arguments->kick, "ROBOT:NUMBER as in trivela label LOG, its number alone, or its kick_id");
  verb->add_option("outcome", arguments->outcome, fmt::format("{}", fmt::join(log::kLabels, ", ")))
      ->check(CLI::IsMember(std::vector<std::string>(log::kLabels.begin(), log::kLabels.end())));
  verb->add_option("--by", arguments->who, "Who says so");
  verb->add_option("--note", arguments->note, "Why, such as the video's time");
  verb->add_option("--session", arguments->session, "How the uuid of the kick's session begins");
  verb->add_flag("--withdraw", arguments->withdraw, "The kick's label no longer holds");
  auto* const serve = verb->add_flag("--serve", arguments->serve, "A page for this machine's browser, until Ctrl-C");
  verb->add_option("--port", arguments->port, "of the page, 0: any free one")
      ->check(CLI::Range(0, 65535))
      ->needs(serve)
      ->capture_default_str();
  verb->add_option("--config", arguments->config, "Settings whose run.match_mode refuses --serve")
      ->check(readable_file())
      ->needs(serve)
      ->capture_default_str();
}

}  // namespace trivela::cli
