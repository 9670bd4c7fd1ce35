#include "experiment/study/robustness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/render/simulated.hpp"
#include "evaluator/render/svg_chart.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

/// Places of the arms that are compared with the rival.
std::vector<std::size_t> others(const RobustnessReport& report) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < report.arms.size(); ++i)
    if (i != report.rival) places.push_back(i);
  return places;
}

std::string difference_name(const RobustnessReport& report, std::size_t arm) {
  return fmt::format("{} - {}", report.arms[arm], report.arms[report.rival]);
}

bool below_zero(const Effect& effect) { return has_interval(effect) && effect.ci.lo < 0.0; }

constexpr double kWorldNames = 230.0, kCellWidth = 118.0, kCellHeight = 26.0, kHeatTop = 96.0, kHeatGap = 18.0,
                 kHeatBottom = 30.0;

/// Black on light grey, white on dark grey; `share` from 0 to 1.
std::string heat_cell(double x, double y, double share, const std::string& words, bool framed) {
  const int grey = static_cast<int>(std::lround(245.0 - 205.0 * std::clamp(share, 0.0, 1.0)));
  const std::string ink = grey > 130 ? "#000" : "#fff";
  std::string svg =
      fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"rgb({},{},{})\"{}/>\n",
                  x + 1.0, y + 1.0, kCellWidth - 2.0, kCellHeight - 2.0, grey, grey, grey,
                  framed ? " stroke=\"#d55e00\" stroke-width=\"2.5\"" : "");
  return svg + evaluator::svg_text(x + 0.5 * kCellWidth, y + 0.5 * kCellHeight + 5.0, "middle", words,
                                   fmt::format(" style=\"fill:{}\"", ink));
}

}  // namespace

Effect against_rival(const RobustnessReport& report, const PlayedWorld& world, std::size_t arm) {
  const Term terms[] = {{&world.arms.at(arm), 1.0}, {&world.arms.at(report.rival), -1.0}};
  return contrast(terms, Measure::kPerOpportunity);
}

std::vector<StudyRow> rows_of(const RobustnessReport& report) {
  std::vector<StudyRow> rows;
  for (const PlayedWorld& world : report.worlds) {
    for (std::size_t i = 0; i < report.arms.size(); ++i) {
      rows.push_back({{{"world", world.name}, {"arm", report.arms[i]}}, world.arms[i]});
      if (i != report.rival) rows.back().change = against_rival(report, world, i);
    }
  }
  return rows;
}

std::string to_text(const RobustnessReport& report) {
  std::string text = heading(report.played, "arm of a world");
  text += fmt::format(
      "Shots on target per 100 opportunities. No robot is calibrated again for a world. Differences from {}:\n"
      "95 % intervals by match and calibration; ! the interval reaches below 0.\n\n",
      report.arms[report.rival]);
  std::vector<std::vector<std::string>> rows{{"world"}};
  for (const std::string& arm : report.arms) rows[0].push_back(arm);
  for (const std::size_t arm : others(report)) rows[0].push_back(difference_name(report, arm));
  std::vector<std::size_t> below(report.arms.size());
  for (const PlayedWorld& world : report.worlds) {
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{world.name});
    for (const ArmTally& arm : world.arms)
      row.push_back(fmt::format("{:.1f}", 100.0 * share_of(arm, Measure::kPerOpportunity).value));
    for (const std::size_t arm : others(report)) {
      const Effect effect = against_rival(report, world, arm);
      row.push_back(points_text(effect) + (below_zero(effect) ? " !" : ""));
      below[arm] += below_zero(effect) ? 1 : 0;
    }
  }
  text += evaluator::text_table(rows) + "\nWorlds where the interval reaches below 0:\n";
  for (const std::size_t arm : others(report))
    text += fmt::format("  {}: {} of {}\n", difference_name(report, arm), below[arm], report.worlds.size());
  return text;
}

Json to_json(const RobustnessReport& report) {
  Json json = json_of("robustness", rows_of(report), report.played);
  json["rival"] = report.arms[report.rival];
  json["worlds"] = Json::array();
  for (const PlayedWorld& world : report.worlds) json["worlds"].push_back({{"world", world.name}, {"why", world.why}});
  return json;
}

std::string to_svg(const RobustnessReport& report) {
  const auto compared = others(report);
  const double shares = kWorldNames + kCellWidth * static_cast<double>(report.arms.size()) + kHeatGap;
  const double width = shares + kCellWidth * static_cast<double>(compared.size()) + kHeatGap;
  const double height = kHeatTop + kCellHeight * static_cast<double>(report.worlds.size()) + kHeatBottom;
  std::string svg = evaluator::svg_head(width, height, "Robustness");
  svg += evaluator::svg_text(0.5 * width, 26.0, "middle", "Shots on target per 100 opportunities", " class=\"title\"");
  svg += evaluator::svg_text(0.5 * width, 45.0, "middle", evaluator::kSimulatedFigure);
  svg += evaluator::svg_text(shares + 0.5 * kCellWidth * static_cast<double>(compared.size()), kHeatTop - 32.0,
                             "middle", "less " + report.arms[report.rival] + "; framed: the interval reaches below 0");
  const auto head = [&](double x, const std::string& name) {
    return evaluator::svg_text(x + 0.5 * kCellWidth, kHeatTop - 10.0, "middle", name, " style=\"font-size:12px\"");
  };
  for (std::size_t i = 0; i < report.arms.size(); ++i)
    svg += head(kWorldNames + kCellWidth * static_cast<double>(i), report.arms[i]);
  for (std::size_t i = 0; i < compared.size(); ++i)
    svg += head(shares + kCellWidth * static_cast<double>(i), report.arms[compared[i]]);
  double y = kHeatTop;
  for (const PlayedWorld& world : report.worlds) {
    svg += evaluator::svg_text(kWorldNames - 12.0, y + 0.5 * kCellHeight + 5.0, "end", world.name);
    for (std::size_t i = 0; i < world.arms.size(); ++i) {
      const double share = share_of(world.arms[i], Measure::kPerOpportunity).value;
      svg += heat_cell(kWorldNames + kCellWidth * static_cast<double>(i), y, share,
                       fmt::format("{:.1f}", 100.0 * share), false);
    }
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const Effect effect = against_rival(report, world, compared[i]);
      svg += heat_cell(shares + kCellWidth * static_cast<double>(i), y, 2.0 * effect.value,
                       fmt::format("{:+.1f}", std::round(1000.0 * effect.value) / 10.0 + 0.0), below_zero(effect));
    }
    y += kCellHeight;
  }
  return svg + "</svg>\n";
}

}  // namespace trivela::experiment
