#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace trivela::tests {

/// What a JSON value does against a schema, a sentence each: the keywords type, enum, minimum, maximum, required,
/// properties, additionalProperties (false), items, minItems and maxItems of JSON Schema. Throws std::logic_error for a
/// keyword that it does not know, so that no rule of a schema is passed over.
class SchemaCheck {
 public:
  static std::vector<std::string> problems(const nlohmann::json& value, const nlohmann::json& schema) {
    SchemaCheck check;
    check.look(value, schema, "object");
    return check.problems_;
  }

 private:
  using json = nlohmann::json;

  void look(const json& value, const json& schema, const std::string& at) {
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "type") {
        says(is_of(value, rule), at + " is no " + rule.dump());
      } else if (keyword == "enum") {
        says(std::find(rule.begin(), rule.end(), value) != rule.end(), at + " is none of " + rule.dump());
      } else if (keyword == "minimum") {
        says(!value.is_number() || value >= rule, at + " is below " + rule.dump());
      } else if (keyword == "maximum") {
        says(!value.is_number() || value <= rule, at + " is over " + rule.dump());
      } else if (keyword == "minItems") {
        says(!value.is_array() || value.size() >= rule.get<std::size_t>(), at + " is too short");
      } else if (keyword == "maxItems") {
        says(!value.is_array() || value.size() <= rule.get<std::size_t>(), at + " is too long");
      } else if (keyword == "items") {
        if (value.is_array())
          for (std::size_t i = 0; i < value.size(); ++i) look(value[i], rule, at + "[" + std::to_string(i) + "]");
      } else if (keyword == "required") {
        for (const auto& key : rule) says(value.contains(key.get<std::string>()), at + " has no " + key.dump());
      } else if (keyword == "properties") {
        for (const auto& [key, inner] : rule.items())
          if (value.contains(key)) look(value[key], inner, at + "." + key);
      } else if (keyword == "additionalProperties") {
        if (value.is_object())
          for (const auto& [key, ignored] : value.items())
            says(schema["properties"].contains(key), at + " has a key \"" + key + "\" that nobody knows");
      } else if (keyword != "title") {
        throw std::logic_error("the schema has the keyword " + keyword);
      }
    }
  }

  static bool is_of(const json& value, const json& type) {
    if (type.is_array())
      return std::any_of(type.begin(), type.end(), [&](const json& one) { return is_of(value, one); });
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == value.type_name();
  }

  void says(bool right, const std::string& problem) {
    if (!right) problems_.push_back(problem);
  }

  std::vector<std::string> problems_;
};

}  // namespace trivela::tests
