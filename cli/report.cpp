#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/report/page/report_page.hpp"
#include "evaluator/report/table2.hpp"

namespace trivela::cli {
namespace {

struct ReportArguments {
  std::string log;
  std::string html;
  bool json = false;
  bool csv = false;
  bool verify = false;
  std::string blocked = "outside";
};

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("report", "Table 2 of a match log, why kicks missed, and data quality");
  const auto arguments = std::make_shared<ReportArguments>();
  verb->add_option("log", arguments->log, "Match log, such as out/match.db")->required();
  auto* const json = verb->add_flag("--json", arguments->json, "JSON instead of text");
  verb->add_flag("--csv", arguments->csv, "CSV instead of text, one line a policy")->excludes(json);
  verb->add_option("--blocked", arguments->blocked,
                   "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others (outside)")
      ->check(CLI::IsMember({"outside", "apart"}));
  verb->add_flag(
      "--verify", arguments->verify,
      "Compare every row with the digest that the recorder wrote, also in a long log; short ones always are");
  verb->add_option("--html", arguments->html,
                   "Write a page with figures, the list of kicks and their replays to this file as well: one file that "
                   "needs nothing else");
  verb->callback([arguments, &exit_code] {
    using evaluator::log::Check;
    require_writable("--html", arguments->html);
    const evaluator::log::Reader reader(arguments->log, arguments->verify ? Check::kWhole : Check::kIfShort);
    const evaluator::Report report = evaluator::make_report(reader, arguments->blocked == "apart");
    if (!arguments->html.empty()) {
      write_file(arguments->html, evaluator::page::report_page(report, {arguments->log}));
    }
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
