#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator {

/// The first line of everything that was played in the simulation.
inline constexpr const char* kSimulated =
    "SIMULATED: the numbers describe the simulation's assumptions, not robots on a field.\n";

/// The same in a figure.
inline constexpr const char* kSimulatedFigure = "simulated: the simulation's assumptions, not robots on a field";

/// Columns padded to their widest cell, two blanks between them: the first to the left, the others to the right.
/// The first row is the head. Each line is indented by two blanks and ends with a newline.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// The same table as Markdown (GitHub's), and as LaTeX in a `tabular`; cells are harmless in either.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);
std::string latex_table(const std::vector<std::vector<std::string>>& rows);

/// "52.3 %".
std::string percent(double fraction);

/// "40.1 % to 63.9 %".
std::string percent(stats::Interval fractions);

/// "on target" of "on_target".
std::string words(std::string label);

/// One line of Markdown (CommonMark with GitHub's tables) that shows `text` as it is: no markup, link, mention, HTML or
/// cell's end comes of it. What a terminal could obey, line feeds too, stands as \xNN, here and below.
std::string markdown_text(std::string_view text);

/// The same for LaTeX, in text mode. What is not ASCII is left to the engine and its fonts.
std::string latex_text(std::string_view text);

/// For SVG and HTML: characters that would be markup become entities; `quotes` too, which an attribute's value needs.
/// What a terminal could obey stays.
std::string xml_text(std::string_view text, bool quotes);

/// A cell of a CSV (RFC 4180). A text that a spreadsheet would take for a formula has ' before it.
std::string csv_text(std::string_view text);

}  // namespace trivela::evaluator
