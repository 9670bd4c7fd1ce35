#pragma once

#include <fmt/core.h>

#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "config/devices.hpp"
#include "config/text/field_types.hpp"

namespace trivela::config {

/// Writes every field of a struct as TOML that TableReader reads back to the same values; numbers in their shortest
/// exact form. Sub-tables come after the plain keys of their table, as TOML demands.
class TableText {
 public:
  explicit TableText(std::string section) : section_(std::move(section)) {}

  void operator()(std::string_view key, const double& value, auto...) { line(key, number(value)); }
  void operator()(std::string_view key, Degrees angle, auto...) {
    line(key, decimal(fmt::format("{:.12g}", angle.rad * 180.0 / std::numbers::pi)));  // rad holds no more digits
  }
  void operator()(std::string_view key, const bool& value) { line(key, value ? "true" : "false"); }
  void operator()(std::string_view key, const std::string& value) { line(key, quoted(value)); }
  void operator()(std::string_view key, const std::vector<double>& value, auto...) {
    list(key, value, [](double element) { return number(element); });
  }
  template <std::integral I>
  requires(!std::same_as<I, bool>) void operator()(std::string_view key, const I& value, auto...) {
    line(key, fmt::format("{}", value));
  }
  void operator()(std::string_view key, const std::vector<std::string>& value) { list(key, value, quoted); }
  template <std::integral I>
  void operator()(std::string_view key, const std::vector<I>& value, auto...) {
    list(key, value, [](I element) { return fmt::format("{}", element); });
  }
  template <class T>
  void operator()(std::string_view key, std::optional<T>& value, auto... range) {
    if (value) (*this)(key, *value, range...);
  }
  template <NamedEnum E>
  void operator()(std::string_view key, const E& value) {
    line(key, name(value));
  }
  template <NamedEnum E>
  void operator()(std::string_view key, const std::vector<E>& value) {
    list(key, value, [](E element) { return name(element); });
  }
  template <class... Backends>
  void operator()(std::string_view key, std::variant<Backends...>& device) {
    line(key, quoted(text_of(device)));
    std::visit(
        [this](auto& backend) {
          if constexpr (Section<std::remove_reference_t<decltype(backend)>>) (*this)(backend.kName, backend);
        },
        device);
  }
  template <Section S>
  void operator()(std::string_view key, std::vector<S>& sections, auto&&...) {
    for (S& section : sections) {
      TableText inner{section_.empty() ? std::string{key} : section_ + "." + std::string{key}};
      fields(inner, section);
      tables_ += fmt::format("\n[[{}]]\n{}{}", inner.section_, inner.keys_, inner.tables_);
    }
  }
  template <Section S>
  void operator()(std::string_view key, S& section) {
    TableText inner{section_.empty() ? std::string{key} : section_ + "." + std::string{key}};
    fields(inner, section);
    tables_ += inner.text();
  }

  /// The table with its heading and its sub-tables.
  std::string text() const {
    const std::string heading = section_.empty() || keys_.empty() ? "" : fmt::format("\n[{}]\n", section_);
    return heading + keys_ + tables_;
  }

 private:
  static std::string number(double value) { return decimal(fmt::format("{}", value)); }
  static std::string decimal(const std::string& text) {
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  static std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
      if (static_cast<unsigned char>(c) < 0x20) {
        out += fmt::format("\\u{:04x}", static_cast<int>(c));
        continue;
      }
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
    return out + '"';
  }
  template <NamedEnum E>
  static std::string name(E value) {
    for (const auto& [label, candidate] : names_of(E{})) {
      if (candidate == value) return quoted(label);
    }
    return quoted("?");
  }
  void line(std::string_view key, const std::string& value) { keys_ += fmt::format("{} = {}\n", key, value); }
  void list(std::string_view key, const auto& values, auto&& format) {
    std::string joined;
    for (const auto& value : values) joined += (joined.empty() ? "" : ", ") + format(value);
    line(key, "[" + joined + "]");
  }

  std::string section_;
  std::string keys_;
  std::string tables_;
};

/// The whole struct as TOML.
template <Section S>
std::string to_toml(S value) {
  TableText text{""};
  fields(text, value);
  return text.text();
}

/// Every value of such a text by its key, e.g. "policy.predictive.threshold".
inline std::map<std::string, std::string> values_in(const std::string& toml) {
  std::map<std::string, std::string> values;
  std::istringstream lines{toml};
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) section = line.substr(1, line.size() - 2) + '.';
    if (const auto equals = line.find(" = "); equals != std::string::npos)
      values[section + line.substr(0, equals)] = line.substr(equals + 3);
  }
  return values;
}

}  // namespace trivela::config
