#include "evaluator/render/svg_style.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace trivela::evaluator {
namespace {

// After Okabe and Ito (2008), darkened where white paper, lightened where a dark screen would swallow them.
constexpr std::array<std::pair<const char*, const char*>, 8> kColours{{{"#0072b2", "#4da3e0"},
                                                                       {"#d55e00", "#ff7f32"},
                                                                       {"#009e73", "#2cc79b"},
                                                                       {"#b8588f", "#e6a8cb"},
                                                                       {"#a87800", "#e6b422"},
                                                                       {"#2f93d1", "#9ad4f7"},
                                                                       {"#222222", "#eeeeee"},
                                                                       {"#7a5c3a", "#c8a57a"}}};
constexpr std::array<const char*, 4> kDashes{"none", "7 4", "2 4", "10 3 2 3"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string style() {
  std::string light =
      "text{font:14px sans-serif;fill:#222}\n.title{font-size:17px;font-weight:600}\n.paper{fill:#fff}\n"
      ".grid{stroke:#ddd}\n.axis{stroke:#444;stroke-width:1.5}\npolyline{fill:none;stroke-width:2.4}\n"
      "polyline.thin{stroke-width:1.2}\ncircle{stroke:none}\n";
  std::string dark = "text{fill:#ddd}\n.paper{fill:#161616}\n.grid{stroke:#383838}\n.axis{stroke:#aaa}\n";
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const auto& [on_white, on_black] = kColours[i];
    light += fmt::format("polyline.c{0}{{stroke:{1}}}\ncircle.c{0}{{fill:{1}}}\n", i, on_white);
    dark += fmt::format("polyline.c{0}{{stroke:{1}}}\ncircle.c{0}{{fill:{1}}}\n", i, on_black);
  }
  for (std::size_t i = 1; i < kDashes.size(); ++i) {
    light += fmt::format("polyline.d{}{{stroke-dasharray:{}}}\n", i, kDashes[i]);
  }
  return light + "@media (prefers-color-scheme:dark){\n" + dark + "}\n";
}

}  // namespace

std::string svg_head(double width, double height, const std::string& title, const std::string& more_style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<title>{2}</title>\n<style>\n{3}{4}</style>\n"
      "<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n",
      width, height, escaped(title), style(), more_style);
}

std::string svg_class(const ChartSeries& series) {
  const auto colours = static_cast<int>(kColours.size());
  std::string style = fmt::format("c{}", series.colour % colours);
  if (series.colour >= colours) style += " thin";
  if (const int dash = series.dash % static_cast<int>(kDashes.size()); dash > 0) style += fmt::format(" d{}", dash);
  return style;
}

std::string svg_text(double x, double y, const char* anchor, const std::string& words, const std::string& more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     escaped(words));
}

std::string svg_line(const std::string& kind, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x1, y1, x2,
                     y2);
}

std::string svg_polyline(const std::string& kind, const std::vector<ChartPoint>& points) {
  std::string svg = fmt::format("<polyline class=\"{}\" points=\"", kind);
  for (const ChartPoint& p : points) svg += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  return svg + "\"/>\n";
}

std::string svg_circle(const std::string& kind, const ChartPoint& centre, double radius) {
  return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.3g}\"/>\n", kind, centre.x, centre.y,
                     radius);
}

std::string svg_rect(const std::string& kind, const ChartPoint& corner, double width, double height) {
  return fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", kind,
                     corner.x, corner.y, width, height);
}

}  // namespace trivela::evaluator
