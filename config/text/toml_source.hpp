#pragma once

#include <fmt/core.h>
#include <toml++/toml.h>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/devices.hpp"
#include "config/text/error.hpp"
#include "config/text/field_types.hpp"

namespace trivela::config {

/// A parsed TOML file that knows its name, for error messages.
struct TomlSource {
  std::string file;
  toml::table root;
};

/// Reads and parses `path`; throws Error naming file and line when it is missing or malformed.
TomlSource parse_file(const std::filesystem::path& path);

/// Parses `text`, calling it `name` in messages.
TomlSource parse_text(std::string_view text, std::string name);

/// What to add to `what` is wrong with a line that was no TOML since the text that it sets has no quotes; else nothing.
/// `flag`: by which the line is given.
std::string quotes_advice(std::string_view what, std::string_view line, std::string_view flag);

/// Sets the struct fields that a TOML table names and refuses everything else in it. Fields that the table does not
/// name keep their value, so that a file overrides defaults. Throws Error for an unknown key, a wrong type, a value
/// that is not finite or outside its Range, naming file, line, key and value.
class TableReader {
 public:
  TableReader(const std::string& file, const toml::table& table, std::string section)
      : file_(file), table_(table), section_(std::move(section)) {}

  void operator()(std::string_view key, double& value) { read_number(key, value, nullptr); }
  void operator()(std::string_view key, double& value, Range range) { read_number(key, value, &range); }
  void operator()(std::string_view key, Degrees angle) { read_angle(key, angle.rad, nullptr); }
  void operator()(std::string_view key, Degrees angle, Range range) { read_angle(key, angle.rad, &range); }
  void operator()(std::string_view key, bool& value);
  void operator()(std::string_view key, std::string& value);
  void operator()(std::string_view key, std::vector<double>& value);
  void operator()(std::string_view key, std::vector<double>& value, Range range) {
    (*this)(key, value);
    for (const double number : value) check_range(key, number, range);
  }
  template <std::integral I>
  requires(!std::same_as<I, bool>) void operator()(std::string_view key, I& value, Range range = {0.0, 4294967295.0}) {
    std::int64_t number = static_cast<std::int64_t>(value);
    if (read_integer(key, number, range)) value = static_cast<I>(number);
  }
  void operator()(std::string_view key, std::vector<std::string>& value);
  template <std::integral I>
  void operator()(std::string_view key, std::vector<I>& value, Range range) {
    std::vector<double> numbers(value.begin(), value.end());
    (*this)(key, numbers, range);
    value.clear();
    for (const double number : numbers) {
      if (number != std::floor(number)) fail(key, *table_.get(key), "expected whole numbers");
      value.push_back(static_cast<I>(number));
    }
  }
  template <class T>
  void operator()(std::string_view key, std::optional<T>& value, auto... range) {
    if (find(key) == nullptr) return;
    if (!value) value.emplace();
    (*this)(key, *value, range...);
  }
  template <NamedEnum E>
  void operator()(std::string_view key, E& value) {
    if (const toml::node* node = find(key)) value = enum_of<E>(key, *node);
  }
  template <NamedEnum E>
  void operator()(std::string_view key, std::vector<E>& value) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    value.clear();
    for (const toml::node& element : array_of(key, *node)) value.push_back(enum_of<E>(key, element));
  }
  /// Throws Error for a text that no backend of the device stands for, and reads the settings of the one that does.
  template <class... Backends>
  void operator()(std::string_view key, std::variant<Backends...>& device) {
    if (const toml::node* node = find(key)) {
      const auto text = node->value<std::string>();
      const auto choose = [&](const auto& backend) { return backend.has_value() && (device = *backend, true); };
      const bool known = text && (*text == text_of(device) || (choose(backend_of<Backends>(*text)) || ...));
      if (!known) fail(key, *node, "expected one of: " + joined({Backends::kName...}));
    }
    std::visit(
        [this](auto& backend) {
          if constexpr (Section<std::remove_reference_t<decltype(backend)>>) (*this)(backend.kName, backend);
        },
        device);
    (read_where<Backends>(key), ...);
  }
  /// [[key]]: an element for each, which begins as `prototype`.
  template <Section S>
  void operator()(std::string_view key, std::vector<S>& sections, const S& prototype) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    sections.clear();
    for (const toml::node& element : array_of(key, *node)) {
      TableReader inner{file_, table_of(key, element),
                        fmt::format("{}{}[{}]", section_.empty() ? "" : section_ + ".", key, sections.size())};
      fields(inner, sections.emplace_back(prototype));
      inner.refuse_unknown_keys();
    }
  }
  template <Section S>
  void operator()(std::string_view key, S& section) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    TableReader inner{file_, table_of(key, *node),
                      section_.empty() ? std::string{key} : section_ + "." + std::string{key}};
    fields(inner, section);
    inner.refuse_unknown_keys();
  }

  /// The sub-tables by their names, with the keys of each.
  std::map<std::string, std::vector<std::string>> tables() const;
  /// Throws Error at that key where `check` throws std::invalid_argument.
  void require(std::string_view key, const std::function<void()>& check);

  /// In words, each key that no field asked for, with its line and the key that was probably meant.
  std::vector<std::string> unknown_keys() const;

  /// Throws Error at the first of them.
  void refuse_unknown_keys() const;

 private:
  const toml::node* find(std::string_view key);
  /// For the message where the backend's table is there and another backend is chosen.
  template <class Backend>
  void read_where(std::string_view key) {
    if constexpr (Section<Backend>)
      choice_of_[std::string{Backend::kName}] =
          (section_.empty() ? "" : section_ + ".") + std::string{key} + " = \"" + std::string{Backend::kName} + '"';
  }
  void read_number(std::string_view key, double& value, const Range* range);
  void read_angle(std::string_view key, double& value_rad, const Range* range_deg);
  bool read_integer(std::string_view key, std::int64_t& value, Range range);
  void check_range(std::string_view key, double value, Range range);
  const toml::table& table_of(std::string_view key, const toml::node& node) const;
  const toml::array& array_of(std::string_view key, const toml::node& node) const;
  static std::string joined(const std::vector<std::string_view>& names);
  [[noreturn]] void fail(std::string_view key, const toml::node& node, const std::string& what) const;

  template <NamedEnum E>
  E enum_of(std::string_view key, const toml::node& node) const {
    if (const auto text = node.value<std::string>()) {
      for (const auto& [name, value] : names_of(E{})) {
        if (name == *text) return value;
      }
    }
    std::vector<std::string_view> known;
    for (const auto& entry : names_of(E{})) known.push_back(entry.first);
    fail(key, node, "expected one of: " + joined(known));
  }

  const std::string& file_;
  const toml::table& table_;
  std::string section_;
  std::vector<std::string> asked_;
  std::map<std::string, std::string, std::less<>> choice_of_;  // by table of a backend
};

/// Overrides `target` with what `source` names.
template <Section S>
void read_into(const TomlSource& source, S& target) {
  TableReader reader{source.file, source.root, ""};
  fields(reader, target);
  reader.refuse_unknown_keys();
}

}  // namespace trivela::config
