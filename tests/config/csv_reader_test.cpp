#include "config/text/csv_reader.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace trivela::config {
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

/// What it says to a text that it cannot read; empty: nothing.
std::string error_of(const std::string& text) {
  std::istringstream in(text);
  CsvReader reader(in, "x.csv");
  try {
    while (reader.next()) continue;
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CsvReader, NamesTheLineOfAQuoteThatIsNeverClosed) {
  EXPECT_EQ(error_of("policy,on_target,note\na,1,q\na,1,\"x\na,1,y\n"),
            "x.csv:3: column 3: the quote that opens here is never closed");
  EXPECT_EQ(error_of("a,b\n\"two\nlines\",\"x\ny\n"), "x.csv:3: column 2: the quote that opens here is never closed");
  EXPECT_EQ(error_of("a\n\"x\"\""), "x.csv:2: column 1: the quote that opens here is never closed");
}

TEST(CsvReader, DoesNotTakeTheNextCellsQuoteForTheClosingOne) {
  EXPECT_EQ(error_of("a,b\n1,\"x\n2,\"y\"\n"),
            "x.csv:3: column 2: text behind the closing quote of the cell whose quote opens on line 2");
  EXPECT_THAT(read_all("\"x\" ,5\" tube,\"\"\n").at(0).cells, ElementsAre("x", "5\" tube", ""));
}

TEST(CsvReader, RefusesWhatIsNotUtf8) {
  EXPECT_EQ(error_of("a,b\n1,caf\xE9\n"), "x.csv:2: column 2: byte 0xE9 is not UTF-8");
  EXPECT_EQ(error_of("a,b\n\"1\n2\",\"3\n\xFF\"\n"), "x.csv:4: column 2: byte 0xFF is not UTF-8");
  EXPECT_EQ(error_of("\xFF\xFE"), "x.csv:1: column 1: byte 0xFF is not UTF-8");
  for (const char* text :
       {"\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8", "\xE2\x82", "\x80"}) {
    EXPECT_THAT(error_of(text), testing::HasSubstr("is not UTF-8"));
  }
  const std::string beyond_ascii = "\u00E9\u20AC\U0001F916";
  EXPECT_THAT(read_all(beyond_ascii + ",b").at(0).cells, ElementsAre(beyond_ascii, "b"));
}

TEST(CsvReader, RefusesControlCharactersButTheTab) {
  EXPECT_EQ(error_of("a\n\x1B[31mred\n"), "x.csv:2: column 1: a control character (byte 0x1B) in a cell");
  EXPECT_THAT(error_of(std::string{"a,\0b", 4}), testing::HasSubstr("(byte 0x00)"));
  EXPECT_THAT(error_of("a\rb\n"), testing::HasSubstr("(byte 0x0D)"));
  EXPECT_THAT(error_of("\xC2\x9B"), testing::HasSubstr("control character"));
  EXPECT_THAT(read_all("a\tb,c\n").at(0).cells, ElementsAre("a\tb", "c"));
}

TEST(CsvReader, PassesOverCommentsInOtherEncodings) { EXPECT_EQ(read_all("# caf\xE9\na\n").size(), 1u); }

TEST(CsvReader, CountsEmptyCells) { EXPECT_THAT(read_all("a,b,c\n,x,\n").at(1).cells, ElementsAre("", "x", "")); }

TEST(CsvReader, LinesAndCellsWithoutEndAreNotRead) {
  std::istringstream line(std::string((1 << 20) + 1, 'a'));
  EXPECT_THAT([&] { CsvReader(line, "x.csv").next(); },
              testing::ThrowsMessage<std::runtime_error>("x.csv:1: a line of more than 1 MB: not read"));
  std::string many = "\"";
  for (int i = 0; i < 3; ++i) many += std::string(500'000, 'b') + "\n";
  std::istringstream cell(many);
  EXPECT_THAT([&] { CsvReader(cell, "x.csv").next(); },
              testing::ThrowsMessage<std::runtime_error>("x.csv:1: column 1: more than 1 MB in a cell"));
}

TEST(CsvReader, ReadsCellsApartByTabsOrBlanksAsThoseApartByCommas) {
  for (const char* const text : {"power,height_m\n15,0.5\n", "power\theight_m\n15\t0.5\n", "power height_m\n15   0.5\n",
                                 "  power \t height_m\n15\t\t0.5 \n", "power\t\theight_m\n15 0.5\n"}) {
    const auto records = read_all(text);
    ASSERT_EQ(records.size(), 2u) << text;
    EXPECT_THAT(records[0].cells, ElementsAre("power", "height_m")) << text;
    EXPECT_THAT(records[1].cells, ElementsAre("15", "0.5")) << text;
  }
  EXPECT_THAT(read_all("by\tnote\nAda B.\t\n").at(1).cells, ElementsAre("Ada B.", "")) << "a tab keeps blanks";
}

TEST(CsvReader, PassesOverEmptyRowsAndWhatFollowsANumberSign) {
  const auto records = read_all("x,y # the columns\n,,\n1,2 # a kick\n , \n3,a#b\n\"# 4\",5\n");
  ASSERT_EQ(records.size(), 4u);
  EXPECT_THAT(records[0].cells, ElementsAre("x", "y "));
  EXPECT_THAT(records[1].cells, ElementsAre("1", "2 "));
  EXPECT_THAT(records[2].cells, ElementsAre("3", "a#b"));
  EXPECT_THAT(records[3].cells, ElementsAre("# 4", "5"));
}

TEST(CsvReader, NamesSemicolonsBetweenTheCells) {
  EXPECT_EQ(error_of("power;height_m\n15;0,5\n"),
            "x.csv:1: the cells are apart by ; : save the table with , and decimal points");
  EXPECT_EQ(error_of("# of Excel\n15;0,5\n"),
            "x.csv:2: the cells are apart by ; : save the table with , and decimal points");
  EXPECT_EQ(error_of("policy,note\nmoving,a; b\n"), "");
}

}  // namespace
}  // namespace trivela::config
