#include "pages/monitor/match_feed.hpp"

#include <utility>

#include "pages/monitor/monitor.css.hpp"
#include "pages/monitor/monitor.html.hpp"
#include "pages/monitor/monitor.js.hpp"
#include "pages/monitor/pitch.js.hpp"

namespace trivela::pages {

Page monitor_page(std::string token) {
  Page page;
  page.assets = {{"/", kMonitorHtml, "text/html; charset=utf-8"},
                 {"/monitor.js", kMonitorJs, "text/javascript; charset=utf-8"},
                 {"/pitch.js", kPitchJs, "text/javascript; charset=utf-8"},
                 {"/monitor.css", kMonitorCss, "text/css; charset=utf-8"}};
  page.token = std::move(token);
  page.most_viewers = 48;
  return page;
}

}  // namespace trivela::pages
