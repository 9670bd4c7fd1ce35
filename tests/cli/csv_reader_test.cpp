#include "cli/csv_reader.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace trivela::cli {
namespace {

using testing::ElementsAre;

std::vector<CsvRecord> read_all(const std::string& text) {
  std::istringstream in(text);
  CsvReader reader(in);
  std::vector<CsvRecord> records;
  while (auto record = reader.next()) records.push_back(*record);
  return records;
}

TEST(CsvReader, KeepsCommasQuotesAndLineEndsInsideQuotes) {
  const auto records = read_all("\"a, \"\"b\"\"\",c\n\"two\nlines\",d\nlast,e\n");
  ASSERT_EQ(records.size(), 3u);
  EXPECT_THAT(records[0].cells, ElementsAre("a, \"b\"", "c"));
  EXPECT_THAT(records[1].cells, ElementsAre("two\nlines", "d"));
  EXPECT_EQ(records[1].line, 2u);
  EXPECT_EQ(records[2].line, 4u);
}

TEST(CsvReader, PassesOverCommentsEmptyLinesAndAByteOrderMark) {
  const auto records = read_all("\xEF\xBB\xBF# about\r\nx,y\r\n\r\n1,2");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_THAT(records[0].cells, ElementsAre("x", "y"));
  EXPECT_THAT(records[1].cells, ElementsAre("1", "2"));
  EXPECT_EQ(records[1].line, 4u);
}

TEST(CsvReader, CountsEmptyCells) { EXPECT_THAT(read_all(",,\n").at(0).cells, ElementsAre("", "", "")); }

}  // namespace
}  // namespace trivela::cli
