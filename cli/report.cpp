#include <sys/resource.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/launch/progress_bar.hpp"
#include "cli/options/gate_option.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/gate.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/table2/table2.hpp"

namespace trivela::cli {
namespace {

using Written = std::string (*)(const evaluator::Report& report);

struct ReportArguments {
  std::vector<std::string> logs;
  std::string html;
  Written written = evaluator::to_text;
  bool verify = false;
  std::string blocked = "outside";
  std::string out;
  std::vector<std::string> gates;
};

// All logs are open at once, each with up to three files; the usual limit is 1024.
void allow_many_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

evaluator::Report report_of(const ReportArguments& arguments) {
  using log::Check;
  const auto gates = parse_gates(arguments.gates, evaluator::report_gate_metrics());
  require_writable("--out", arguments.out);
  require_writable("--html", arguments.html);
  allow_many_files();
  std::vector<std::unique_ptr<log::Reader>> readers;
  std::vector<evaluator::OpenLog> logs;
  for (const std::string& log : arguments.logs) {
    readers.push_back(std::make_unique<log::Reader>(log, arguments.verify ? Check::kWhole : Check::kIfShort));
    logs.push_back({readers.back().get(), log});
  }
  evaluator::Report report = evaluator::make_report(logs, arguments.blocked == "apart");
  report.gates = evaluator::judge_gates(report, gates);
  return report;
}

// What a reader of the text finds in it stands on standard error beside the other forms.
void warn_of(const evaluator::Report& report) {
  for (const std::string& warning : report.warnings) warn(warning);
  if (report.doubt) warn(*report.doubt);
}

void write_page(const evaluator::Report& report, const ReportArguments& arguments) {
  ProgressBar bar;
  const auto progress = [&bar](std::size_t done, std::size_t parts, const std::string& what) {
    bar.show(static_cast<double>(done), static_cast<double>(parts), "page: " + what);
  };
  write_file(arguments.html,
             evaluator::page::report_page(report, {arguments.logs.begin(), arguments.logs.end()}, progress));
}

int run_report(const ReportArguments& arguments) {
  const evaluator::Report report = report_of(arguments);
  if (!arguments.html.empty()) write_page(report, arguments);
  const std::string text = arguments.written(report);
  arguments.out.empty() ? say(text) : write_file(arguments.out, text);
  if (arguments.written != Written{evaluator::to_text} || !arguments.out.empty()) warn_of(report);
  const bool met = warn_of_gates(report.gates);
  return report.data_lost() || !met ? kDoneWithLoss : kDone;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "report", "Table 2 of match logs, why kicks missed, and data quality", run_report);
  verb->add_option("logs", arguments->logs, "Match logs, such as out/match.db; each of their kicks counts once")
      ->type_name("DB")
      ->required();
  auto* const form = verb->add_option_group("form", "One of these in place of text");
  const auto add_form = [form, given = arguments](const char* flag, const char* help, Written written) {
    form->add_flag_callback(
        flag, [given, written] { given->written = written; }, help);
  };
  add_form("--json", "JSON", evaluator::to_json);
  add_form("--csv", "CSV, a line for each policy, robot and number of the data quality", evaluator::to_csv);
  add_form("--markdown", "Markdown", evaluator::to_markdown);
  add_form("--latex", "LaTeX, for \\input", evaluator::to_latex);
  form->require_option(0, 1);
  verb->add_option("--out", arguments->out, "Write to this file, not to standard output")->type_name("FILE");
  verb->add_option("--blocked", arguments->blocked,
                   "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others (outside)")
      ->check(CLI::IsMember({"outside", "apart"}));
  add_gates(*verb, arguments->gates, "'efficiency(moving)>=0.7', 'missing_rows==0'");
  verb->add_flag(
      "--verify", arguments->verify,
      "Compare every row with the digest that the recorder wrote, also in a long log; short ones always are");
  verb->add_option("--html", arguments->html,
                   "Write a page with figures, the list of kicks and their replays to this file as well: one file that "
                   "needs nothing else");
}

}  // namespace trivela::cli
