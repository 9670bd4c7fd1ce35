#include "evaluator/report/write_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;
using testing::ThrowsMessage;

class WriteFile : public testing::Test {
 protected:
  WriteFile() {
    std::string pattern = (fs::temp_directory_path() / "trivela_write_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~WriteFile() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }
  std::string text_of(const std::string& name) const {
    std::ifstream in{path(name)};
    return {std::istreambuf_iterator<char>{in}, {}};
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator{folder_}, {}); }

 private:
  fs::path folder_;
};

TEST_F(WriteFile, ReplacesWhatWasThere) {
  write_file(path("a"), "longer than the new");
  write_file(path("a"), "new\n");
  EXPECT_EQ(text_of("a"), "new\n");
  replace_file(path("a"), "newer\n", "the text");
  EXPECT_EQ(text_of("a"), "newer\n");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, NamesWhatCannotBeWritten) {
  const fs::path nowhere = path("no/a");
  EXPECT_THAT([&] { write_file(nowhere, ""); },
              ThrowsMessage<std::runtime_error>("cannot write " + nowhere.string() + ": No such file or directory"));
  EXPECT_THAT([&] { replace_file(nowhere, "", "the text"); },
              ThrowsMessage<std::runtime_error>("cannot write the text " + nowhere.string()));
}

TEST_F(WriteFile, KeepsTheFileWhereTheNewOneIsRefused) {
  write_file(path("a"), "old");
  const auto refuse = [](const fs::path& beside) {
    EXPECT_TRUE(fs::exists(beside));
    throw std::runtime_error{"not this"};
  };
  EXPECT_THAT([&] { replace_file(path("a"), "new", "the text", refuse); },
              ThrowsMessage<std::runtime_error>("not this"));
  EXPECT_EQ(text_of("a"), "old");
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace trivela::evaluator
