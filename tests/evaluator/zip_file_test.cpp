#include "evaluator/imports/zip_file.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>

#include "tests/evaluator/zip_writing.hpp"
#include "tests/support/folder.hpp"

namespace trivela::evaluator::imports {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

namespace fs = std::filesystem;

class ZipFile : public testing::Test {
 protected:
  fs::path write(const std::string& bytes) const {
    std::ofstream(path(), std::ios::binary) << bytes;
    return path();
  }
  fs::path path() const { return directory_ / "x.zip"; }

  std::pair<std::string, std::string> read(const ZipEntry& entry) const {  // and the fault
    ZipStream in(path(), entry);
    std::string text(std::istreambuf_iterator<char>(in), {});
    return {std::move(text), in.fault()};
  }

  tests::Folder directory_;
};

std::string long_text() {
  std::string text;
  for (int i = 0; i < 60'000; ++i) text += std::to_string(i * 7919 % 10007) + ",";
  return text;
}

TEST_F(ZipFile, EntriesAreUnpackedAsTheyWere) {
  write(zip_of({{"a.msl", long_text(), true}, {"b.msl", long_text(), false}, {"empty.msl", "", true}}));
  EXPECT_TRUE(is_zip(path()));
  const auto entries = zip_entries(path());
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].name, "a.msl");
  EXPECT_LT(entries[0].compressed_bytes, entries[0].bytes);
  for (const ZipEntry& entry : entries) {
    const auto [text, fault] = read(entry);
    EXPECT_EQ(text, entry.name == "empty.msl" ? "" : long_text());
    EXPECT_EQ(fault, "");
  }
}

TEST_F(ZipFile, ACutArchiveIsRefusedWithItsName) {
  const std::string whole = zip_of({{"a.msl", long_text(), true}});
  write(whole.substr(0, whole.size() - 30));
  EXPECT_THAT(
      [&] { zip_entries(path()); },
      ThrowsMessage<std::runtime_error>(HasSubstr("x.zip: no zip archive that can be read: it has no directory")));
}

TEST_F(ZipFile, ChangedBytesAreAFaultWhereverTheyAre) {
  const std::string whole = zip_of({{"a.msl", long_text(), true}});
  for (std::size_t at = 40; at < whole.size() - 80; at += 9973) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    write(changed);
    EXPECT_NE(read(zip_entries(path()).front()).second, "") << at;
  }
}

TEST_F(ZipFile, NoByteOfTheDirectoryLeadsOutOfIt) {
  const std::string whole = zip_of({{"a.msl", "hello", true}, {"b.msl", "hello", false}});
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char byte : {'\0', '\x7f', '\xff'}) {
      std::string changed = whole;
      changed[at] = byte;
      write(changed);
      try {
        for (const ZipEntry& entry : zip_entries(path())) read(entry);
      } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("x.zip")) << at;
      }
    }
  }
}

TEST_F(ZipFile, WhatIsNoArchiveIsNone) {
  EXPECT_FALSE(is_zip(write("1529326805014,06:53(00:00)")));
  EXPECT_FALSE(is_zip(write("")));
}

}  // namespace
}  // namespace trivela::evaluator::imports
