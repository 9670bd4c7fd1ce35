#include "config/text/toml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "config/text/csv_row.hpp"
#include "config/text/installation.hpp"
#include "config/text/open_file.hpp"
#include "kicking/text/nearest_word.hpp"

namespace trivela::config {
namespace {

/// As a person writes it: toml++ gives a number 17 digits.
std::string text_of(const toml::node& node) {
  if (const auto number = node.as_floating_point(); number && std::isfinite(number->get())) {
    const std::string text = fmt::format("{}", number->get());
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  }
  if (const toml::array* const array = node.as_array()) {
    std::vector<std::string> elements;
    elements.reserve(array->size());
    for (const toml::node& element : *array) elements.push_back(text_of(element));
    return elements.empty() ? "[]" : fmt::format("[ {} ]", fmt::join(elements, ", "));
  }
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return out.str();
}

/// A table within a table for each part of a key: of too many the stack is too small. Texts and comments have no keys.
/// Throws Error.
void refuse_deep_keys(std::string_view text, const std::string& name) {
  constexpr int kMostParts = 100;
  int line = 1, parts = 1;
  char quote = '\0';  // of the text that is open
  bool comment = false, escaped = false;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      comment = false;
    }
    if (comment) continue;
    if (quote != '\0') {
      if (!escaped && c == quote) quote = '\0';
      escaped = !escaped && c == '\\' && quote == '"';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (std::string_view{"=,[]{}#\n"}.find(c) != std::string_view::npos) {
      parts = 1;
      comment = c == '#';
    } else if (c == '.' && ++parts > kMostParts) {
      throw Error{fmt::format("{}:{}: a key of more than {} parts", name, line, kMostParts)};
    }
  }
}

}  // namespace

TomlSource parse_text(std::string_view text, std::string name) {
  refuse_deep_keys(text, name);
  try {
    toml::table root = toml::parse(text, name);
    return {std::move(name), std::move(root)};
  } catch (const toml::parse_error& error) {
    throw Error{fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line, error.description())};
  }
}

std::string quotes_advice(std::string_view what, std::string_view line, std::string_view flag) {
  const auto equals = line.find('=');
  if (what.find("not valid TOML") == std::string_view::npos || equals == std::string_view::npos) return "";
  const std::string key = trimmed(std::string{line.substr(0, equals)});
  const std::string value = trimmed(std::string{line.substr(equals + 1)});
  const bool bare = !value.empty() && value.find_first_of("\"'[]{}#") == std::string::npos &&
                    std::string_view{"+-.0123456789"}.find(value.front()) == std::string_view::npos;
  return bare ? fmt::format("; text needs quotes: {} '{}=\"{}\"'", flag, key, value) : "";
}

TomlSource parse_file(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& why) {
    std::string looked;
    if (path.is_relative()) {
      looked = fmt::format(" (in {})", std::filesystem::current_path().string());
    } else if (const std::string trouble = trouble_with_folder();
               !trouble.empty() && path.string().starts_with(folder().string())) {
      looked = fmt::format(" ({})", trouble);
    }
    throw Error{fmt::format("{}: cannot read the configuration: {}{}", path.string(), why, looked)};
  };
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) fail("it is a folder");
  errno = 0;
  std::ifstream in{path, std::ios::binary};
  if (!in) fail(errno == 0 ? "not a file" : std::strerror(errno));
  constexpr std::size_t kMost_B = 1 << 20;
  std::string text;
  try {
    text = read_text(in, path.string(), kMost_B);
  } catch (const std::runtime_error& too_large) {
    throw Error{too_large.what()};
  }
  if (in.bad()) fail("reading it failed");
  return parse_text(text, path.string());
}

const toml::node* TableReader::find(std::string_view key) {
  asked_.emplace_back(key);
  return table_.get(key);
}

void TableReader::fail(std::string_view key, const toml::node& node, const std::string& what) const {
  throw Error{fmt::format("{}:{}: {}{}{} = {}: {}", file_, node.source().begin.line, section_,
                          section_.empty() ? "" : ".", key, text_of(node), what)};
}

std::string TableReader::joined(const std::vector<std::string_view>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

void TableReader::check_range(std::string_view key, double value, Range range) {
  if (!range.contains(value)) {
    fail(key, *table_.get(key), fmt::format("must lie in [{}, {}]", range.min, range.max));
  }
}

void TableReader::read_number(std::string_view key, double& value, const Range* range) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_number()) fail(key, *node, "expected a number");
  const double number = *node->value<double>();
  if (!std::isfinite(number)) fail(key, *node, "expected a finite number");
  if (range != nullptr) check_range(key, number, *range);
  value = number;
}

void TableReader::read_angle(std::string_view key, double& value_rad, const Range* range_deg) {
  double value_deg = value_rad * 180.0 / std::numbers::pi;
  const double before = value_deg;
  read_number(key, value_deg, range_deg);
  if (value_deg != before) value_rad = value_deg * std::numbers::pi / 180.0;
}

bool TableReader::read_integer(std::string_view key, std::int64_t& value, Range range) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  if (!node->is_integer()) fail(key, *node, "expected a whole number");
  value = *node->value<std::int64_t>();
  check_range(key, static_cast<double>(value), range);
  return true;
}

void TableReader::operator()(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) fail(key, *node, "expected true or false");
  value = *node->value<bool>();
}

void TableReader::operator()(std::string_view key, std::string& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  if (!node->is_string()) fail(key, *node, "expected a string");
  value = *node->value<std::string>();
}

void TableReader::operator()(std::string_view key, std::vector<double>& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  std::vector<double> numbers;
  for (const toml::node& element : array_of(key, *node)) {
    if (!element.is_number() || !std::isfinite(*element.value<double>())) fail(key, element, "expected finite numbers");
    numbers.push_back(*element.value<double>());
  }
  value = std::move(numbers);
}

void TableReader::operator()(std::string_view key, std::vector<std::string>& value) {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  std::vector<std::string> texts;
  for (const toml::node& element : array_of(key, *node)) {
    if (!element.is_string()) fail(key, element, "expected strings");
    texts.push_back(*element.value<std::string>());
  }
  value = std::move(texts);
}

const toml::table& TableReader::table_of(std::string_view key, const toml::node& node) const {
  if (!node.is_table()) fail(key, node, "expected a table");
  return *node.as_table();
}

const toml::array& TableReader::array_of(std::string_view key, const toml::node& node) const {
  if (!node.is_array()) fail(key, node, "expected an array");
  return *node.as_array();
}

std::map<std::string, std::vector<std::string>> TableReader::tables() const {
  std::map<std::string, std::vector<std::string>> tables;
  for (const auto& [name, node] : table_) {
    if (!node.is_table()) continue;
    auto& keys = tables[std::string{name.str()}];
    for (const auto& [key, value] : *node.as_table()) keys.emplace_back(key.str());
  }
  return tables;
}

void TableReader::require(std::string_view key, const std::function<void()>& check) {
  try {
    check();
  } catch (const std::invalid_argument& wrong) {
    if (const toml::node* const node = table_.get(key)) fail(key, *node, wrong.what());
    throw Error{fmt::format("{}: {}{}{}: {}", file_, section_, section_.empty() ? "" : ".", key, wrong.what())};
  }
}

std::vector<std::string> TableReader::unknown_keys() const {
  std::vector<std::string> unknown;
  for (const auto& [key, node] : table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
    const auto choice = choice_of_.find(key.str());
    const auto meant = kicking::nearest_word(key.str(), asked_);
    std::string hint;
    if (choice != choice_of_.end())
      hint = fmt::format("; it is read where {}", choice->second);
    else if (meant)
      hint = fmt::format("; did you mean {}?", *meant);
    unknown.push_back(fmt::format("{}:{}: {}{}{}: unknown key{}", file_, key.source().begin.line, section_,
                                  section_.empty() ? "" : ".", key.str(), hint));
  }
  return unknown;
}

void TableReader::refuse_unknown_keys() const {
  if (const auto unknown = unknown_keys(); !unknown.empty()) throw Error{unknown.front()};
}

}  // namespace trivela::config
