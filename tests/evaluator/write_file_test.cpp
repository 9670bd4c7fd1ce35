#include "evaluator/render/write_file.hpp"
#include "tests/support/folder.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;
using testing::ThrowsMessage;

class WriteFile : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }
  std::string text_of(const std::string& name) const {
    std::ifstream in{path(name)};
    return {std::istreambuf_iterator<char>{in}, {}};
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator{folder_}, {}); }

 private:
  tests::Folder folder_;
};

TEST_F(WriteFile, ReplacesWhatWasThere) {
  write_file(path("a"), "longer than the new");
  write_file(path("a"), "new\n");
  EXPECT_EQ(text_of("a"), "new\n");
  replace_file(path("a"), "newer\n", "the text");
  EXPECT_EQ(text_of("a"), "newer\n");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, KeepsTheLastPageWhereTheNewOneDoesNotFit) {
  write_file(path("a"), "the last page");
  const rlimit small{4096, RLIM_INFINITY};  // as a full disk: the write ends within the text
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_file(path("a"), std::string(100'000, 'x')), std::runtime_error);
  EXPECT_THROW(write_file(path("b"), std::string(100'000, 'x')), std::runtime_error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(text_of("a"), "the last page");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, FollowsALinkAndKeepsPermissions) {
  write_file(path("a"), "old");
  fs::permissions(path("a"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(path("a"), path("link"));
  write_file(path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(text_of("a"), "new");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
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
