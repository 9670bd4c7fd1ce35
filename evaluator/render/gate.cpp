#include "evaluator/render/gate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "kicking/text/nearest_word.hpp"

namespace trivela::evaluator {
namespace {

struct Sign {
  std::string_view text;
  Relation relation;
  bool (*holds)(double value, double bound);
};

constexpr Sign kSigns[] = {{">=", Relation::kAtLeast, [](double value, double bound) { return value >= bound; }},
                           {"<=", Relation::kAtMost, [](double value, double bound) { return value <= bound; }},
                           {"==", Relation::kEqual, [](double value, double bound) { return value == bound; }},
                           {">", Relation::kAbove, [](double value, double bound) { return value > bound; }},
                           {"<", Relation::kBelow, [](double value, double bound) { return value < bound; }}};

/// Reads a gate from left to right.
class GateText {
 public:
  GateText(const std::string& text, const GateMetrics& known) : text_(text), known_(known) { gate_.text = text; }

  Gate read() && {
    read_metric();
    skip_blanks();
    if (rest().starts_with('(')) read_subjects();
    read_relation();
    read_number();
    return std::move(gate_);
  }

 private:
  std::string_view rest() const { return std::string_view(text_).substr(at_); }

  void skip_blanks() {
    while (rest().starts_with(' ')) ++at_;
  }

  [[noreturn]] void fail(std::size_t at, const std::string& why) const {
    throw BadGate(fmt::format("'{}', character {}: {}", text_, at + 1, why));
  }

  std::string_view word() const {
    const auto is_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    const auto end = std::ranges::find_if_not(rest(), is_word);
    return rest().substr(0, static_cast<std::size_t>(end - rest().begin()));
  }

  void read_metric() {
    skip_blanks();
    gate_.metric = word();
    std::vector<std::string> all = known_.of_subject;
    all.insert(all.end(), known_.of_whole.begin(), known_.of_whole.end());
    if (std::ranges::find(all, gate_.metric) == all.end()) {
      const auto meant = kicking::nearest_word(gate_.metric, all);
      fail(at_, fmt::format("{}{} (a metric is one of {})",
                            gate_.metric.empty() ? "a metric is missing" : "'" + gate_.metric + "' is no metric",
                            meant ? fmt::format(", did you mean {}?", *meant) : "", fmt::join(all, ", ")));
    }
    at_ += gate_.metric.size();
  }

  void read_subjects() {
    if (std::ranges::find(known_.of_whole, gate_.metric) != known_.of_whole.end())
      fail(at_, gate_.metric + " is of the whole report and takes no subject");
    do {
      ++at_;
      skip_blanks();
      const std::size_t begin = at_;
      const bool quoted = rest().starts_with('"');
      add_subject(quoted ? read_quoted() : read_bare(), quoted, begin);
      skip_blanks();
    } while (rest().starts_with(','));
    if (!rest().starts_with(')')) fail(at_, "')' is missing");
    ++at_;
  }

  std::string read_quoted() {
    std::string name;
    for (++at_; !rest().starts_with('"'); ++at_) {
      if (rest().starts_with('\\')) ++at_;
      if (rest().empty()) fail(at_, "the quote is not closed");
      name += rest().front();
    }
    ++at_;
    return name;
  }

  std::string read_bare() {
    std::string name(rest().substr(0, rest().find_first_of(",)")));
    at_ += name.size();
    while (name.ends_with(' ')) name.pop_back();
    return name;
  }

  void add_subject(const std::string& name, bool quoted, std::size_t begin) {
    if (name.empty()) fail(begin, "a subject is missing: a policy, an arm, a group or all");
    if (!quoted && known_.robots && name.starts_with("robot ")) {
      int id = 0;
      const auto [end, error] = std::from_chars(name.data() + 6, name.data() + name.size(), id);
      if (error != std::errc{} || end != name.data() + name.size()) fail(begin, "write robot N, such as robot 2");
      if (gate_.robot_id) fail(begin, "a second robot");
      gate_.robot_id = id;
      return;
    }
    if (!gate_.subject.empty() || all_) fail(begin, "a second subject");
    if (!quoted && name == "all") {
      all_ = true;
    } else {
      gate_.subject = name;
    }
  }

  void read_relation() {
    skip_blanks();
    for (const Sign& sign : kSigns) {
      if (!rest().starts_with(sign.text)) continue;
      gate_.relation = sign.relation;
      at_ += sign.text.size();
      return;
    }
    fail(at_, "one of >= <= > < == is missing");
  }

  void read_number() {
    skip_blanks();
    std::string_view number = rest();
    while (number.ends_with(' ')) number.remove_suffix(1);
    const bool percent = number.ends_with('%');
    if (percent) number.remove_suffix(1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), gate_.bound);
    if (error != std::errc{} || !std::isfinite(gate_.bound)) fail(at_, "a number is missing, such as 0.7 or 70%");
    if (end != number.data() + number.size())
      fail(static_cast<std::size_t>(end - text_.data()), "nothing may follow the number");
    if (percent) gate_.bound /= 100.0;
  }

  const std::string& text_;
  const GateMetrics& known_;
  std::size_t at_ = 0;
  bool all_ = false;
  Gate gate_;
};

}  // namespace

bool Gate::passes(double value) const {
  return std::ranges::find(kSigns, relation, &Sign::relation)->holds(value, bound);
}

Gate parse_gate(const std::string& text, const GateMetrics& known) { return GateText(text, known).read(); }

GateResult judged(const Gate& gate, std::vector<Measured> measured) {
  const bool met = !measured.empty() && std::ranges::all_of(measured, [&](const Measured& of) {
    return of.value && gate.passes(*of.value);
  });
  return {gate.text, met, std::move(measured)};
}

Json gates_json(std::span<const GateResult> gates) {
  const auto measured_json = [](const Measured& of) {
    return Json{{"name", of.name.empty() ? Json() : Json(of.name)},
                {"value", json_of(of.value)},
                {"why", of.value ? Json() : Json(of.why)}};
  };
  return json_list(gates, [&](const GateResult& gate) {
    return Json{{"gate", gate.gate}, {"met", gate.met}, {"measured", json_list(gate.measured, measured_json)}};
  });
}

std::string GateResult::sentence() const {
  std::vector<std::string> values;
  for (const Measured& of : measured) {
    values.push_back((of.name.empty() ? "" : of.name + " ") +
                     (of.value ? fmt::format("{:.6g}", *of.value) : "no data, " + of.why));
  }
  return fmt::format("gate {}: {}: {}", met ? "met" : "MISSED", gate,
                     values.empty() ? "no data" : fmt::format("{}", fmt::join(values, "; ")));
}

}  // namespace trivela::evaluator
