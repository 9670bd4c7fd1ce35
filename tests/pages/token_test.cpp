#include "pages/serve/site.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "config/text/error.hpp"

namespace trivela::pages {
namespace {

namespace fs = std::filesystem;

TEST(Token, IsDrawnAnewEachTime) {
  const std::string token = draw_token();
  EXPECT_THAT(token, testing::MatchesRegex("[0-9a-f]+"));
  EXPECT_EQ(token.size(), 32u);
  EXPECT_NE(token, draw_token());
}

TEST(Token, IsTheSameOrIsNot) {
  EXPECT_TRUE(same_token("abc", "abc"));
  for (const char* const other : {"", "ab", "abcd", "abd", "Abc"}) EXPECT_FALSE(same_token(other, "abc")) << other;
}

TEST(Token, IsFoundAmongOtherCookies) {
  EXPECT_EQ(cookie_of("a=1; trivela_80=xyz; trivela_8080=abc", "trivela_8080"), "abc");
  EXPECT_EQ(cookie_of("trivela_8080=abc", "trivela_8080"), "abc");
  EXPECT_EQ(cookie_of("xtrivela_80=abc;;  ; b", "trivela_80"), "");
  EXPECT_EQ(cookie_of("", "trivela_80"), "");
}

/// A file that goes with the test.
class TokenFile : public testing::Test {
 protected:
  TokenFile() {
    std::string pattern = (fs::temp_directory_path() / "trivela_token_XXXXXX").string();
    close(mkstemp(pattern.data()));
    file = pattern;
  }
  ~TokenFile() override { fs::remove(file); }
  void write(const std::string& text) const { std::ofstream{file} << text; }

  fs::path file;
};

TEST_F(TokenFile, IsItsFirstLine) {
  write("abcdefghijklmnop-_09\nsecond\n");
  EXPECT_EQ(token_of_file(file), "abcdefghijklmnop-_09");
}

TEST_F(TokenFile, ThatIsNoneIsNamed) {
  for (const std::string& text : {std::string(), std::string("short\n"), std::string("with a blank in between\n"),
                                  std::string(129, 'a'), std::string("abcdefghijklmnop;x\n")}) {
    write(text);
    EXPECT_THROW(token_of_file(file), config::BadArgument) << text;
  }
  fs::remove(file);
  EXPECT_THROW(token_of_file(file), config::BadArgument);
}

TEST_F(TokenFile, ThatOthersMayReadIsRefused) {
  write("abcdefghijklmnopqrst\n");
  fs::permissions(file, fs::perms::group_read, fs::perm_options::add);
  try {
    token_of_file(file);
    FAIL();
  } catch (const config::BadArgument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("chmod 600"));
  }
}

}  // namespace
}  // namespace trivela::pages
