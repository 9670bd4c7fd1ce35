#include <fmt/format.h>
#include <sys/resource.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/report/table2.hpp"

namespace trivela::cli {
namespace {

struct ReportArguments {
  std::vector<std::string> logs;
  bool json = false;
  bool csv = false;
  bool verify = false;
  std::string blocked = "outside";
};

// All logs are open at once, each with up to three files; the usual limit is 1024.
void allow_many_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

evaluator::Report report_of(const ReportArguments& arguments) {
  using evaluator::log::Check;
  allow_many_files();
  std::vector<std::unique_ptr<evaluator::log::Reader>> readers;
  std::vector<evaluator::OpenLog> logs;
  for (const std::string& log : arguments.logs) {
    readers.push_back(
        std::make_unique<evaluator::log::Reader>(log, arguments.verify ? Check::kWhole : Check::kIfShort));
    logs.push_back({readers.back().get(), log});
  }
  return evaluator::make_report(logs, arguments.blocked == "apart");
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("report", "Table 2 of match logs, why kicks missed, and data quality");
  const auto arguments = std::make_shared<ReportArguments>();
  verb->add_option("logs", arguments->logs, "Match logs, such as out/match.db; each of their kicks counts once")
      ->type_name("DB")
      ->required();
  auto* const json = verb->add_flag("--json", arguments->json, "JSON instead of text");
  verb->add_flag("--csv", arguments->csv, "CSV instead of text, one line a policy")->excludes(json);
  verb->add_option("--blocked", arguments->blocked,
                   "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others (outside)")
      ->check(CLI::IsMember({"outside", "apart"}));
  verb->add_flag(
      "--verify", arguments->verify,
      "Compare every row with the digest that the recorder wrote, also in a long log; short ones always are");
  verb->callback([arguments, &exit_code] {
    const evaluator::Report report = report_of(*arguments);
    const bool plain = !arguments->json && !arguments->csv;
    if (arguments->json) {
      fmt::print("{}", evaluator::to_json(report));
    } else {
      say(arguments->csv ? evaluator::to_csv(report) : evaluator::to_text(report));
    }
    if (!plain) {  // the text has them
      for (const std::string& warning : report.warnings) warn(warning);
      if (report.doubt) warn(*report.doubt);
    }
    exit_code = report.data_lost() ? kDoneWithLoss : kDone;
  });
}

}  // namespace trivela::cli
