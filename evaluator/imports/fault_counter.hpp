#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::evaluator::imports {

/// A kind of fault of a file, how often it was seen, and where first.
struct Fault {
  std::string name;  ///< such as "ageMs missing"
  std::int64_t count = 0;
  std::int64_t first = 0;  ///< number of the first line or record that has it, from 1; 0: the file as a whole
  std::string key{};       ///< what the first one is about; empty: nothing in particular
  std::string value{};     ///< as it stood there
};

/// Faults of one file, counted by their names, in the order in which they were first seen.
class FaultCounter {
 public:
  /// `file`: what sentences call it; `unit`: what its places are, "line" or "record".
  FaultCounter(std::string file, std::string unit) : file_(std::move(file)), unit_(std::move(unit)) {}

  /// Counts a fault at a place. Only of the first of a name are key and value kept.
  template <class T>
  void note(std::string_view name, std::int64_t place, std::string_view key, const T& value) {
    if (Fault* const first = count(name)) *first = {first->name, 1, place, std::string(key), shown(value)};
  }
  void note(std::string_view name, std::int64_t place) { note(name, place, "", ""); }

  const std::vector<Fault>& all() const { return faults_; }
  std::int64_t of(std::string_view name) const;

  /// "FILE: NAME: 12 times, first in record 3: ageMs = 4.5"
  std::vector<std::string> sentences() const;

 private:
  static constexpr std::size_t kMostShown = 40;  ///< characters of a value

  template <class T>
  static std::string shown(const T& value) {
    std::string text = fmt::format("{}", value);
    if (text.size() > kMostShown) text = text.substr(0, kMostShown) + "...";
    return text;
  }

  /// The new fault, or nullptr where one of that name is known and was counted.
  Fault* count(std::string_view name);

  std::string file_, unit_;
  std::vector<Fault> faults_;
};

}  // namespace trivela::evaluator::imports
