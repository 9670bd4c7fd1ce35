#pragma once

#include <string>
#include <vector>

#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {

/// A part of a report for readers: a table, sentences under it. Numbers are rounded as people read them; names are as
/// they stand in the log, and whoever renders them makes them harmless.
struct ReportPart {
  std::string title;
  std::vector<std::vector<std::string>> table{};  ///< the first row is the head; empty: none
  std::vector<std::string> notes{};
};

/// A report as text, Markdown and LaTeX have it.
struct ReportParts {
  std::vector<std::string> heading;  ///< sentences: what was played
  std::vector<ReportPart> parts;
  std::string last;  ///< the comparison to go on with; empty: there is nothing to compare
};

ReportParts parts_of(const Report& report);

/// "moving"; of an experiment the arm, and its policy where that is another word.
std::string name_of(const PolicyRow& row);

}  // namespace trivela::evaluator
