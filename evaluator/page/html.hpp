#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator::page {

/// A text of anybody as text and as an attribute's value: what is not printable as \xNN, what HTML would read as
/// &lt; &gt; &amp; &quot; and &#39;.
std::string html(std::string_view text);

/// JSON within a script element: nothing in it can end the element, since `<` is written as \u003c.
std::string script_json(const Json& json);

/// A section of the page; `body` is HTML.
std::string section(const std::string& id, const std::string& title, const std::string& body);

/// Sentences of plain text, a paragraph each.
std::string paragraphs(const std::vector<std::string>& sentences);

/// Sentences of plain text as a list; empty where there are none.
std::string list_of(const std::vector<std::string>& sentences);

/// A table of plain text: the first row is the head, the first cell of each other row names it. It scrolls by itself
/// where the window is narrow.
std::string table(const std::string& caption, const std::vector<std::vector<std::string>>& rows);

/// What follows a table or figure, opened by a click.
std::string details(const std::string& summary, const std::string& body);

/// "1 kick", "2 kicks".
std::string counted(std::int64_t n, const std::string& one, const std::string& many);

/// SHA-256 of a text as a content-security policy names it: 'sha256-...' in base 64.
std::string csp_hash(const std::string& text);

}  // namespace trivela::evaluator::page
