#pragma once

#include <string>
#include <string_view>

namespace trivela::evaluator {

/// One line of Markdown (CommonMark with GitHub's tables) that shows `text` as it is: no markup, link, mention, HTML or
/// cell's end comes of it. What a terminal could obey, line feeds too, stands as \xNN, here and below.
std::string markdown_text(std::string_view text);

/// The same for LaTeX, in text mode. What is not ASCII is left to the engine and its fonts.
std::string latex_text(std::string_view text);

/// A cell of a CSV (RFC 4180). A text that a spreadsheet would take for a formula has ' before it.
std::string csv_text(std::string_view text);

}  // namespace trivela::evaluator
