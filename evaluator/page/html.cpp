#include "evaluator/page/html.hpp"

#include <fmt/format.h>

#include <array>

#include "evaluator/render/text_table.hpp"
#include "kicking/text/printable.hpp"
#include "log/schema/digest.hpp"

namespace trivela::evaluator::page {

std::string html(std::string_view text) { return xml_text(kicking::printable(text), true); }

std::string script_json(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

std::string section(const std::string& id, const std::string& title, const std::string& body) {
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}</h2>\n{2}</section>\n", id,
      html(title), body);
}

std::string paragraphs(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "<p>" + html(sentence) + "</p>\n";
  return text;
}

std::string list_of(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string text = "<ul>\n";
  for (const std::string& sentence : sentences) text += "<li>" + html(sentence) + "</li>\n";
  return text + "</ul>\n";
}

std::string table(const std::string& caption, const std::vector<std::vector<std::string>>& rows) {
  std::string text = fmt::format(
      "<div class=\"scrolls\" role=\"group\" aria-label=\"{0}\" tabindex=\"0\">\n<table>\n<caption>{0}</caption>\n",
      html(caption));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += i == 0 ? "<thead><tr>" : "<tr>";
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      const bool head = i == 0 || j == 0;
      text += head ? fmt::format("<th scope=\"{}\">", i == 0 ? "col" : "row") : "<td>";
      text += html(rows[i][j]) + (head ? "</th>" : "</td>");
    }
    text += i == 0 ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
  }
  return text + (rows.empty() ? "" : "</tbody>\n") + "</table>\n</div>\n";
}

std::string details(const std::string& summary, const std::string& body) {
  return fmt::format("<details>\n<summary>{}</summary>\n{}</details>\n", html(summary), body);
}

std::string counted(std::int64_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string csp_hash(const std::string& text) {
  const std::string hex = log::sha256(text);
  std::array<unsigned char, 32> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<unsigned char>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
  return "'sha256-" + log::base64(bytes) + "'";
}

}  // namespace trivela::evaluator::page
