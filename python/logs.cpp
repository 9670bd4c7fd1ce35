#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/counting/metrics.hpp"
#include "log/read/reader.hpp"
#include "log/schema/stream_table.hpp"
#include "python/arrays.hpp"
#include "python/columns.hpp"
#include "python/signals.hpp"

namespace trivela::python {
namespace {

/// Logs that are open for one question; what of their kicks counts is said once, for all of them.
class OpenLogs {
 public:
  explicit OpenLogs(const std::vector<std::string>& paths, log::Check check = log::Check::kIfShort) {
    for (const std::string& path : paths) {
      readers_.push_back(std::make_unique<log::Reader>(path, check));
      logs_.push_back({readers_.back().get(), path});
    }
  }

  evaluator::LoggedOpportunities opportunities(bool truth) { return evaluator::read_opportunities(logs_, truth); }

  const std::vector<evaluator::OpenLog>& logs() const { return logs_; }

 private:
  std::vector<std::unique_ptr<log::Reader>> readers_;
  std::vector<evaluator::OpenLog> logs_;
};

/// The columns of a data frame, `log` among them where there are several logs.
void require_distinct(std::vector<std::string> names, bool several_logs) {
  if (several_logs) names.emplace_back("log");
  for (const std::string& name : names)
    if (std::ranges::count(names, name) > 1)
      throw log::BadQuestion(fmt::format("two columns are called '{}': name them with AS", name));
}

/// (names, columns of one SELECT, asked of each log, and the log of each row).
py::tuple ask(const std::vector<std::string>& paths, const std::string& sql) {
  std::vector<std::string> names;
  std::vector<Column> columns;
  Column logs;
  reading([&] {
    OpenLogs open(paths);
    if (paths.size() > 1 && sql.find("counted_kicks") != std::string::npos) open.opportunities(false);
    for (const evaluator::OpenLog& log : open.logs()) {
      const auto head = [&](const std::vector<std::string>& heads) {
        require_distinct(heads, paths.size() > 1);
        names = heads;
        columns.resize(names.size());
      };
      const auto row = [&](std::span<const log::Value> cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) columns[i].add(cells[i]);
        logs.add(log.name);
      };
      if (paths.size() > 1) {
        log.reader->ask(sql, head, row);
      } else {
        evaluator::ask_counted(*log.reader, log.name, sql, head, row);
      }
    }
  });
  py::list arrays;
  for (Column& column : columns) arrays.append(column.arrays());
  return py::make_tuple(names, arrays, logs.arrays());
}

const char* ending_of(evaluator::Ending ending) {
  switch (ending) {
    case evaluator::Ending::kNoKick:
      return "no_kick";
    case evaluator::Ending::kInside:
      return "inside";
    case evaluator::Ending::kOutside:
      return "outside";
    case evaluator::Ending::kBlocked:
      return "blocked";
    case evaluator::Ending::kUnknown:
      break;
  }
  return "unknown";
}

void add_opportunity(Columns& row, const evaluator::LoggedOpportunities& logged,
                     const evaluator::LoggedOpportunity& opportunity) {
  const evaluator::ComparedSession& session = logged.sessions[opportunity.session];
  const auto text = [](const std::string& known) { return known.empty() ? std::nullopt : std::optional(known); };
  row.begin_row();
  row.add("log", logged.logs[session.log]);
  row.add("session_id", session.session_id);
  row.add("match", session.match);
  row.add("calibration_id", session.calibration_id);
  row.add("arm", text(session.arm));
  row.add("scenario", text(session.scenario));
  row.add("table", text(session.table));
  row.add("robot_id", opportunity.robot_id);
  row.add("half", opportunity.half);
  row.add("possession_id", opportunity.has_possession ? std::optional(opportunity.possession_id) : std::nullopt);
  row.add("policy", text(opportunity.policy));
  row.add("assignment_probability", opportunity.probability);
  row.add("start_distance_m", opportunity.start_distance_m);
  row.add("start_x_m", opportunity.start_x_m);
  row.add("first_distance_m", opportunity.first ? std::optional(opportunity.first->distance_m) : std::nullopt);
  row.add("distance_m", opportunity.distance_m);
  row.add("ending", ending_of(opportunity.ending));
  row.add("blocked", opportunity.blocked);
  row.add("label_doubt", opportunity.doubt);
  row.add("bounced", opportunity.said.bounced);
  row.add("saved", opportunity.said.saved);
  row.add("truth_bounced", opportunity.said.truth_bounced);
  row.add("truth_saved", opportunity.said.truth_saved);
}

/// Of all logs together: (columns, remarks).
py::tuple opportunities(const std::vector<std::string>& paths, bool truth) {
  Columns columns;
  std::vector<std::string> remarks;
  reading([&] {
    const evaluator::LoggedOpportunities logged = OpenLogs(paths).opportunities(truth);
    for (const evaluator::LoggedOpportunity& row : logged.rows) add_opportunity(columns, logged, row);
    remarks = logged.remarks;
  });
  return py::make_tuple(columns.arrays(), remarks);
}

/// The sessions as counting sees them.
py::dict sessions(const std::vector<std::string>& paths) {
  Columns row;
  reading([&] {
    const evaluator::LoggedOpportunities logged = OpenLogs(paths).opportunities(false);
    for (const evaluator::ComparedSession& session : logged.sessions) {
      row.begin_row();
      row.add("log", paths[session.log]);
      row.add("session_id", session.session_id);
      row.add("uuid", session.uuid);
      row.add("play", session.play);
      row.add("match", session.match);
      row.add("counts", session.counts);
      row.add("half_1_left_out", session.halves_left_out.contains(1));
      row.add("half_2_left_out", session.halves_left_out.contains(2));
      row.add("started_utc_ns", session.started_utc_ns);
      row.add("closed_utc_ns", session.closed_utc_ns);
      row.add("simulated", session.simulated);
      row.add("scenario", session.scenario);
      row.add("seed", session.seed);
      row.add("arm", session.arm);
      row.add("table", session.table);
      row.add("calibration_id", session.calibration_id);
    }
  });
  return row.arrays();
}

/// Sentences on sessions that were not closed, on lost rows, and on what was not verified.
std::vector<std::string> warnings(const std::vector<std::string>& paths) {
  return reading([&] {
    std::vector<std::string> sentences;
    const OpenLogs open(paths);
    for (const evaluator::OpenLog& log : open.logs()) {
      for (const std::string& warning : log.reader->warnings()) sentences.push_back(warning);
      if (const auto doubt = log.reader->doubt()) sentences.push_back(*doubt);
    }
    return sentences;
  });
}

/// {column: (kind, meaning)} of every stream of a log; of columns of one name the first.
py::dict column_kinds() {
  static constexpr const char* kKinds[] = {"integer", "truth", "number", "label", "text"};
  py::dict kinds;
  for (const log::StreamTable& table : log::stream_tables()) {
    for (const log::StreamColumn& column : table.columns) {
      if (!kinds.contains(column.name))
        kinds[column.name.c_str()] = py::make_tuple(kKinds[static_cast<std::size_t>(column.kind)], column.meaning);
    }
  }
  return kinds;
}

py::dict metrics() {
  py::dict all;
  for (const evaluator::Metric& metric : evaluator::metrics())
    all[std::string(metric.name).c_str()] = py::make_tuple(std::string(metric.sql), metric.explanation());
  return all;
}

}  // namespace

void add_logs(py::module_& module) {
  module.def("ask", ask);
  module.def("opportunities", opportunities);
  module.def("sessions", sessions);
  module.def("warnings", warnings);
  module.def("column_kinds", column_kinds);
  module.def("metrics", metrics);
}

}  // namespace trivela::python
