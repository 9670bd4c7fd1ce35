#include "experiment/factorial/pair.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "evaluator/report/text_table.hpp"
#include "evaluator/stats/interval.hpp"
#include "experiment/effects/render.hpp"

namespace trivela::experiment {
namespace {

constexpr std::array kBlocked{std::pair{"outside", Measure::kEfficiency}, std::pair{"apart", Measure::kUnblocked}};

template <class Use>
void each(const std::vector<BiasPoint>& points, const Use& use) {
  for (const BiasPoint& point : points) {
    for (const auto& [blocked, measure] : kBlocked) use(point, blocked, measure);
  }
}

bool both_within(const BiasPoint& point, Measure measure) {
  return within_papers(point.older, measure, kPaperOlder) && within_papers(point.newer, measure, kPaperNewer);
}

}  // namespace

std::string pair_text(const std::vector<BiasPoint>& points, Law law) {
  const auto older = evaluator::stats::wilson(kPaperOlder), newer = evaluator::stats::wilson(kPaperNewer);
  std::vector<std::vector<std::string>> rows{
      {"eye's common error [m]", "blocked", "old stopped [%]", "new moving [%]", "both within the paper's"}};
  each(points, [&](const BiasPoint& point, const char* blocked, Measure measure) {
    rows.push_back({fmt::format("{:g}", point.eye_bias_m), blocked, share_text(share_of(point.older, measure)),
                    share_text(share_of(point.newer, measure)), both_within(point, measure) ? "yes" : "no"});
  });
  return fmt::format(
             "Old table and stopped against new table and moving, {} law, by two assumptions; the paper: 52.3 and 75.8 "
             "%\n(95 % {:.0f} to {:.0f} and {:.0f} to {:.0f} %):\n",
             name(law), 100.0 * older.lo, 100.0 * older.hi, 100.0 * newer.lo, 100.0 * newer.hi) +
         evaluator::text_table(rows) +
         "  Common error: balls so much too high seemed right to whoever made the old tables, at every distance.\n"
         "  Assumptions that meet two numbers are not shown to be right by it: several do.\n";
}

nlohmann::ordered_json pair_json(const std::vector<BiasPoint>& points) {
  evaluator::Json json = evaluator::Json::array();
  each(points, [&](const BiasPoint& point, const char* blocked, Measure measure) {
    json.push_back({{"eye_bias_m", point.eye_bias_m},
                    {"blocked", blocked},
                    {"old_stopped", json_of(share_of(point.older, measure))},
                    {"new_moving", json_of(share_of(point.newer, measure))},
                    {"both_within_papers", both_within(point, measure)}});
  });
  return json;
}

}  // namespace trivela::experiment
