#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/poisson.hpp"

namespace trivela::evaluator::page {

std::string rates_section(const PageView& view) {
  const auto& policies = view.report.policies;
  const auto known = [](const PolicyRow& row) { return row.played_min && *row.played_min > 0.0; };
  if (std::ranges::none_of(policies, known)) return paragraphs({"How long was played is not in the log."});
  IntervalPlot plot{.head = {.id = "rates-figure",
                             .says = "Chances, kicks and shots on target a minute of play",
                             .simulated = view.simulated},
                    .axis_label = "a minute of play",
                    .note =
                        "A minute of play is one in which the policy's robots had the ball and the game ran. A "
                        "chance is a possession. Lines: 95 % intervals, as if events came independently."};
  const auto rows_of = [&](const std::string& name, const auto& events_of) {
    plot.rows.push_back({.label = name, .heading = true});
    for (const PolicyRow& row : policies) {
      const std::optional<std::int64_t> events = events_of(row);
      if (!known(row) || !events) continue;
      const auto ci = stats::rate_interval({*events, *row.played_min});
      const double rate = static_cast<double>(*events) / *row.played_min;
      plot.to = std::max(plot.to, ci.hi);
      plot.rows.push_back({.label = name_of(row),
                           .value = rate,
                           .lo = ci.lo,
                           .hi = ci.hi,
                           .numbers = fmt::format("{} in {:.1f} min", *events, *row.played_min),
                           .colour = colour_of(view, row.policy)});
    }
  };
  const auto& chances = view.data.opportunities;
  if (!chances.empty()) {
    rows_of("chances", [&](const PolicyRow& row) -> std::optional<std::int64_t> {
      const auto found = chances.find(row.policy);
      const bool shared =
          std::ranges::count(policies, row.policy, &PolicyRow::policy) > 1;  // whose they were is not said
      return shared || found == chances.end() ? std::nullopt : std::optional(found->second);
    });
  }
  rows_of("kicks", [](const PolicyRow& row) { return std::optional(row.kicks()); });
  rows_of("on target", [](const PolicyRow& row) { return std::optional(row.inside()); });
  return interval_plot(plot) + (chances.empty() ? paragraphs({"Nobody counted chances in these logs."}) : "");
}

namespace {

/// Nobody could have kicked: the game stood, or a kick was under way.
bool is_idle(const HeldReason& row) { return row.reason == "not_playing" || row.reason == "order_pending"; }

std::string bars(const PageView& view, const std::vector<HeldReason>& rows) {
  constexpr double kLeft = 150.0, kRight = 340.0, kRow = 24.0;
  std::int64_t most = 1;
  for (const HeldReason& row : rows) most = std::max(most, row.cycles);
  const Scale x{0.0, static_cast<double>(most), kLeft, kRight};
  std::string svg, policy;
  double y = 16.0;
  for (const HeldReason& row : rows) {
    if (row.policy != policy) {
      policy = row.policy;
      svg += svg_text(4.0, y + 5.0, "start", policy, " class=\"heading\"");
      y += kRow;
    }
    svg += svg_text(16.0, y + 5.0, "start", words(row.reason));
    svg += svg_rect("bar " + colour(colour_of(view, policy)), {kLeft, y - 7.0},
                    std::max(1.0, x.length_px(static_cast<double>(row.cycles))), 14.0);
    svg += svg_text(kRight + 8.0, y + 5.0, "start",
                    fmt::format("{} in {}", row.cycles, counted(row.chances, "chance", "chances")));
    y += kRow;
  }
  return figure({"held-figure", "Cycles in which each policy held, by reason", y, view.simulated}, svg,
                "Cycles of the decision in which the active policy held, and the possessions in which it did so for "
                "that reason. Cycles in which the game stood or a kick was under way are left out.");
}

std::string shadow_table(const std::vector<HeldReason>& rows, const std::vector<std::string>& shadows) {
  std::vector<std::vector<std::string>> cells{{"policy", "held because", "cycles", "chances"}};
  for (const std::string& shadow : shadows) cells[0].push_back(shadow + " would have kicked");
  for (const HeldReason& row : rows) {
    auto& line = cells.emplace_back(std::vector<std::string>{row.policy, words(row.reason), std::to_string(row.cycles),
                                                             std::to_string(row.chances)});
    for (const std::string& shadow : shadows) {
      const auto would = row.would.find(shadow);
      line.push_back(
          shadow == row.policy ? "\u2013"
          : would == row.would.end()
              ? "never"
              : fmt::format("in {} of {}", counted(would->second.chances, "chance", "chances"), row.chances));
    }
  }
  return table("Why it held, and what the policies that rode along would have done", cells);
}

std::string idle_sentence(const std::vector<HeldReason>& held) {
  std::map<std::string, std::int64_t> idle;
  for (const HeldReason& row : held) {
    if (is_idle(row)) idle[row.reason] += row.cycles;
  }
  if (idle.empty()) return "";
  return fmt::format("Left out: {} cycles in which the game stood, {} with a kick under way.", idle["not_playing"],
                     idle["order_pending"]);
}

/// What the shadows predicted for the kicks that nobody took, by the policy that held. A sentence each.
std::vector<std::string> cost_sentences(const std::vector<HeldChance>& chances) {
  struct Cost {
    std::int64_t would = 0;      // chances in which a shadow would have kicked
    std::int64_t predicted = 0;  // of them those with a probability
    double on_target = 0.0;      // their sum
  };
  std::map<std::string, Cost> costs;
  for (const HeldChance& chance : chances) {
    if (!chance.shadow_would) continue;
    Cost& cost = costs[chance.policy];
    ++cost.would;
    cost.predicted += chance.p_on_target ? 1 : 0;
    cost.on_target += chance.p_on_target.value_or(0.0);
  }
  std::vector<std::string> sentences;
  for (const auto& [policy, cost] : costs) {
    if (cost.predicted == 0) continue;
    sentences.push_back(
        fmt::format("What holding cost, by the model: in {} in which {} kicked nothing a policy that rode along would "
                    "have kicked; in {} of them it predicted how likely its kick was on target, and the best "
                    "predictions add up to {:.1f} shots on target.",
                    counted(cost.would, "chance", "chances"), policy, cost.predicted, cost.on_target));
  }
  if (!sentences.empty())
    sentences.emplace_back(
        "That is a model's estimate and no outcome: nobody kicked, the prediction may be wrong, and what became of the "
        "ball instead is not in it.");
  return sentences;
}

}  // namespace

std::string held_section(const PageView& view) {
  std::vector<HeldReason> rows;
  std::ranges::copy_if(view.data.held, std::back_inserter(rows), [](const HeldReason& row) { return !is_idle(row); });
  if (rows.empty())
    return paragraphs({"The log has no decision that held: it keeps the kicks alone, or they were imported."});
  std::string body = bars(view, rows) + shadow_table(rows, view.data.shadows);
  if (const std::string idle = idle_sentence(view.data.held); !idle.empty()) body += paragraphs({idle});
  body += paragraphs(cost_sentences(view.data.held_chances));
  return body +
         paragraphs(
             {view.data.shadows.empty()
                  ? "No other policy rode along."
                  : "A shadow policy judges the same cycle and orders nothing. It would have kicked once and held no "
                    "more: where it would have kicked is counted by possession. What its kick would have become "
                    "nobody knows."});
}

}  // namespace trivela::evaluator::page
