#include "config/field.hpp"

#include "config/text/toml_source.hpp"

namespace trivela::config {

void fields(auto& v, FieldFile& f) {
  v("field", f.field);
  v("rules", f.rules);
}

FieldFile load_field(const std::filesystem::path& path) {
  FieldFile field;
  read_into(parse_file(path), field);
  return field;
}

Settings on_field(const FieldFile& field, Settings settings) {
  settings.goal = goal_of(field.field);
  settings.field.side_line_x_m = field.field.side_line_x_m;
  settings.policy.rules = field.rules;
  return settings;
}

}  // namespace trivela::config
