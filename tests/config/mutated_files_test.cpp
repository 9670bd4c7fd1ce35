// Every key of every shipped TOML file with every kind of wrong value, one at a time: what reads it plays with it or
// says one sentence with the file's name, and never ends the program.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "config/arms.hpp"
#include "config/field.hpp"
#include "config/learned_model.hpp"
#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "config/team/team.hpp"
#include "config/team/team_bus.hpp"
#include "config/team/team_settings.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;

/// Values that a key may hold in a file, by the grammar of TOML: numbers of all kinds, texts, arrays and tables.
const std::vector<std::string>& wrong_values() {
  static const std::vector<std::string> values{"0",          "-1",
                                               "256",        "9223372036854775807",
                                               "0.5",        "1e308",
                                               "5e-324",     "nan",
                                               "-inf",       "true",
                                               "''",         "'1'",
                                               "'../..'",    "\"\\u0000\"",
                                               "[]",         "[nan]",
                                               "[3, 2, 1]",  "['a', 1]",
                                               "{}",         "[{}]",
                                               "2026-11-27", "'" + std::string(5000, 'x') + "'"};
  return values;
}

/// The text of a file in which each node is written, but the one at `path`, which is `value`, or left out where that
/// is empty.
class Mutant {
 public:
  Mutant(const toml::table& root, std::vector<std::string> path, std::string value)
      : path_(std::move(path)), value_(std::move(value)) {
    write_table(root, 0);
  }
  const std::string& text() const { return text_; }

 private:
  // Inline tables alone, so that every node can be put in the place of every other.
  void write_table(const toml::table& table, std::size_t depth) {
    for (const auto& [key, node] : table) {
      const bool on_path = depth < path_.size() && matching_ == depth && path_[depth] == key.str();
      if (on_path && depth + 1 == path_.size() && value_.empty()) continue;
      text_ += (depth > 0 && text_.back() != '{') ? ", " : "";
      text_ += quoted(key.str()) + " = ";
      if (on_path) ++matching_;
      on_path&& depth + 1 == path_.size() ? void(text_ += value_) : write_node(node, depth + 1);
      if (on_path) --matching_;
      if (depth == 0) text_ += '\n';
    }
  }
  void write_node(const toml::node& node, std::size_t depth) {
    if (const toml::table* const table = node.as_table()) {
      text_ += '{';
      write_table(*table, depth);
      text_ += '}';
    } else if (const toml::array* const array = node.as_array()) {
      text_ += '[';
      for (std::size_t i = 0; i < array->size(); ++i) {
        if (i > 0) text_ += ", ";
        const bool on_path = depth < path_.size() && matching_ == depth && path_[depth] == std::to_string(i);
        if (on_path) ++matching_;
        on_path&& depth + 1 == path_.size() ? void(text_ += value_.empty() ? "0" : value_)
                                            : write_node((*array)[i], depth + 1);
        if (on_path) --matching_;
      }
      text_ += ']';
    } else {
      std::ostringstream out;
      node.visit([&out](const auto& value) { out << value; });
      text_ += out.str();
    }
  }
  static std::string quoted(std::string_view key) { return '"' + std::string{key} + '"'; }

  std::vector<std::string> path_;
  std::string value_;
  std::string text_;
  std::size_t matching_ = 0;  // of path_, so far
};

/// Every place of a document: keys, and the first and last element of arrays.
void places_in(const toml::node& node, std::vector<std::string>& at, std::vector<std::vector<std::string>>& places) {
  if (!at.empty()) places.push_back(at);
  const auto below = [&](const std::string& step, const toml::node& child) {
    at.push_back(step);
    places_in(child, at, places);
    at.pop_back();
  };
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [key, child] : *table) below(std::string{key.str()}, child);
  } else if (const toml::array* const array = node.as_array(); array != nullptr && !array->empty()) {
    below("0", array->front());
    if (array->size() > 1) below(std::to_string(array->size() - 1), array->back());
  }
}

struct Kind {
  std::string name;
  std::vector<std::string> files;  ///< below config/
  std::function<void(const fs::path&)> read;
};

void read_team(const fs::path& path) {
  const ReadTeam read = load_team(path);
  const auto findings = team_findings(read.team);
  if (!read.findings.empty()) throw std::runtime_error{read.findings.front()};
  if (!findings.empty()) throw std::runtime_error{findings.front()};
  for (const TeamRobot& robot : read.team.robots) team_files(read.team, &robot, "/nowhere", "");
  team_files(read.team, nullptr, "/nowhere", "");
  air_estimate(read.team);
}

void read_settings(const fs::path& path) { to_toml_text(load_settings(path)); }

class MutatedFiles : public testing::TestWithParam<Kind> {};

TEST_P(MutatedFiles, AreReadOrRefusedInASentence) {
  const Kind& kind = GetParam();
  std::size_t read = 0, refused = 0;
  const tests::Folder folder;
  const fs::path copy = folder / "config";  // whole, since files name each other
  fs::copy(fs::path{TRIVELA_SOURCE_DIR} / "config", copy, fs::copy_options::recursive);
  for (const std::string& file : kind.files) {
    const fs::path original = copy / file;
    const toml::table root = toml::parse_file(original.string());
    std::vector<std::vector<std::string>> places;
    std::vector<std::string> at;
    places_in(root, at, places);
    ASSERT_FALSE(places.empty());
    // Beside the original, by whose folder its names of files go.
    const fs::path mutant = original.parent_path() / "mutant.toml";
    const auto play = [&](const std::vector<std::string>& place, const std::string& value) {
      std::ofstream{mutant} << Mutant{root, place, value}.text();
      try {
        kind.read(mutant);
        ++read;
      } catch (const std::exception& error) {
        ++refused;
        ASSERT_NE(std::string{error.what()}, "");
        ASSERT_EQ(std::string{error.what()}.find('\n'), std::string::npos) << error.what();
      }
    };
    play({"no such key"}, "");
    for (const auto& place : places) {
      play(place, "");
      for (const std::string& value : wrong_values()) play(place, value);
    }
  }
  EXPECT_GT(read, 0u) << "the file as it is, written again, reads";
  EXPECT_GT(refused, read / 10);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, MutatedFiles,
    testing::Values(
        Kind{"Team", {"teams/example.toml"}, read_team}, Kind{"Settings", {"default.toml"}, read_settings},
        Kind{"Policies", {"policies/tuned_moving.toml"}, read_settings},
        Kind{"Robots",
             {"robots/cambada_1.toml", "robots/calibrated_1.toml"},
             [](const fs::path& path) {
               to_toml_text(robot_for(load_robot(path), Settings{}));
               load_robot_of_any_table(path);
             }},
        Kind{"Scenarios",
             {"scenarios/team.toml", "scenarios/keeper.toml"},
             [](const fs::path& path) { to_toml_text(load_scenario(path)); }},
        Kind{"Arms", {"arms/policies.toml", "arms/drawn.toml"}, [](const fs::path& path) { load_arms(path); }},
        Kind{"Fields", {"fields/msl_2026.toml"}, [](const fs::path& path) { on_field(load_field(path), Settings{}); }},
        Kind{"LearnedModels", {"learned.toml"}, [](const fs::path& path) { to_toml_text(load_learned_model(path)); }}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace trivela::config
