#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

#include "kicking/policy/policy.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/schema.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

// CREATE TABLE statements of the schema's source with their comments.
std::vector<std::string> tables_in_source() {
  std::ifstream file(TRIVELA_SOURCE_DIR "/log/schema/schema.sql");
  std::vector<std::string> tables;
  std::string line;
  bool inside = false;
  while (std::getline(file, line)) {
    if (line.starts_with("CREATE TABLE")) {
      inside = true;
      tables.emplace_back();
    }
    if (inside) tables.back() += line + "\n";
    if (line.starts_with(")")) inside = false;
  }
  return tables;
}

TEST(Schema, EveryTableAndEveryColumnHasAComment) {
  const std::regex start_of_column(R"(^  [a-z_0-9]+ (INTEGER|REAL|TEXT)\b)");
  int columns = 0;
  for (const std::string& table : tables_in_source()) {
    std::istringstream lines(table);
    std::vector<std::string> definitions;  // the table's head, then its columns, some of several lines
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("  PRIMARY KEY")) break;
      if (definitions.empty() || std::regex_search(line, start_of_column)) definitions.emplace_back();
      definitions.back() += line;
    }
    for (const std::string& definition : definitions) {
      EXPECT_TRUE(std::regex_search(definition, std::regex(" -- .*[a-z0-9]"))) << definition;
    }
    columns += static_cast<int>(definitions.size()) - 1;
  }
  EXPECT_GT(columns, 150);
}

TEST(Schema, EveryTableIsStrictWithoutRowidAndKeyedBySession) {
  const auto tables = tables_in_source();
  EXPECT_EQ(tables.size(), 35u);
  for (const std::string& table : tables) {
    EXPECT_NE(table.find(") STRICT, WITHOUT ROWID;"), std::string::npos) << table;
    if (table.starts_with("CREATE TABLE texts") || table.starts_with("CREATE TABLE experiments")) continue;
    EXPECT_NE(table.find("session_id INTEGER NOT NULL"), std::string::npos) << table;
    EXPECT_TRUE(std::regex_search(table, std::regex(R"(PRIMARY KEY( \(session_id|,))"))) << table;
  }
}

/// Policies that a log takes in a table, in the order of its schema.
std::vector<std::string> policies_of(const std::string& table) {
  const std::string schema(log::schema_of(log::kMatchLog));
  const auto begin = schema.find("CREATE TABLE " + table + " (");
  const std::string text = schema.substr(begin, schema.find(") STRICT", begin) - begin);
  const std::regex label("policy = '([a-z_]+)'");
  std::vector<std::string> labels;
  for (std::sregex_iterator it(text.begin(), text.end(), label), end; it != end; ++it) labels.push_back((*it)[1]);
  return labels;
}

TEST(Schema, TakesTheShadowsOfTheRegistryAndNoOthers) {
  using kicking::PolicyFacts;
  EXPECT_EQ(policies_of("shadow_decisions"), kicking::policies_where(std::mem_fn(&PolicyFacts::rides_along)));
}

TEST(Digest, Sha256OfThePublishedExamples) {
  EXPECT_EQ(log::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(log::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Digest, UuidsAreOfVersionFourAndDiffer) {
  const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  const std::string one = log::make_uuid();
  EXPECT_TRUE(std::regex_match(one, form)) << one;
  EXPECT_NE(one, log::make_uuid());
}

TEST(Digest, SessionIdIsTheFirst63BitsOfTheUuid) {
  EXPECT_EQ(log::session_id_of("00000000-0000-0003-8000-000000000000"), 1);
  EXPECT_EQ(log::session_id_of("ffffffff-ffff-ffff-8000-000000000000"), INT64_MAX);
  for (const char* const wrong :
       {"", "no", "0000000000000003800000000000000000000", "00000000-0000-000g-8000-000000000000",
        "00000000-0000-0003-8000-00000000000-", "+0000000-0000-0003-8000-000000000000"}) {
    EXPECT_THROW(log::session_id_of(wrong), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace trivela::evaluator
