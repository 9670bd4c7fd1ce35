#include "kicking/in_place.hpp"

#include <gtest/gtest.h>

namespace trivela::kicking {
namespace {

struct Made {
  const void* where = nullptr;
  int number = 0;
  double rest[4]{};  // too much for registers, as a message is

  explicit Made(int n) : where(this), number(n) {}
};

TEST(InPlace, MakesAnObjectWhereItIsWithoutACopy) {
  Made made{1};
  make_in_place(made, [] { return Made{2}; });
  EXPECT_EQ(made.number, 2);
  EXPECT_EQ(made.where, &made);
}

}  // namespace
}  // namespace trivela::kicking
