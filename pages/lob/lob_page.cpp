#include "pages/lob/scene.hpp"

#include "config/text/parse_number.hpp"
#include "pages/lob/page.css.hpp"
#include "pages/lob/page.html.hpp"
#include "pages/lob/page.js.hpp"

namespace trivela::pages {

Page lob_page(Scene& scene) {
  Page page;
  page.assets = {{"/", kPageHtml, "text/html; charset=utf-8"},
                 {"/page.js", kPageJs, "text/javascript; charset=utf-8"},
                 {"/page.css", kPageCss, "text/css; charset=utf-8"}};
  page.resources = {
      {"/api/state", "application/json", [&scene](const auto&) { return scene.state().dump(); }},
      {"/api/frame", "application/json",
       [&scene](const auto& parameter) {
         const auto i = config::parse_integer(parameter("i"));
         if (!i) throw CommandError{400, "i must be a number"};
         return scene.frame(static_cast<std::size_t>(*i));
       }},
      {"/api/table.csv", "text/csv; charset=utf-8", [&scene](const auto&) { return scene.table_csv(); }, "lobs.csv"}};
  page.command = [&scene](const std::string& name, const nlohmann::json& arguments) { scene.command(name, arguments); };
  return page;
}

}  // namespace trivela::pages
