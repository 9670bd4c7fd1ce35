#include "pages/lob/lob_session.hpp"

#include <gmock/gmock.h>

#include "config/text/error.hpp"

namespace trivela::pages {
namespace {

using kicking::lob::LobRecord;
using kicking::lob::Refusal;
using testing::ElementsAre;
using testing::HasSubstr;

std::string message_of(const std::string& list) {
  try {
    parse_powers(list, "--plan");
  } catch (const config::BadArgument& error) {
    return error.what();
  }
  return "";
}

LobRecord lob_of(double power, Refusal refusal = Refusal::kNone) {
  LobRecord lob;
  lob.power = power;
  lob.refusal = refusal;
  return lob;
}

TEST(Plan, ReadsListsAndGoesOnInTheirStep) {
  EXPECT_THAT(parse_powers("15,20,...,50"), ElementsAre(15, 20, 25, 30, 35, 40, 45, 50));
  EXPECT_THAT(parse_powers("30"), ElementsAre(30));
  EXPECT_THAT(parse_powers("50,40,...,10,5"), ElementsAre(50, 40, 30, 20, 10, 5));
  EXPECT_THAT(parse_powers("0.5,0.6,...,0.8"), ElementsAre(0.5, 0.6, testing::DoubleEq(0.7), 0.8));
}

TEST(Plan, SaysWhatIsWrongWithAList) {
  EXPECT_THAT(message_of("15,x"), HasSubstr("--plan 15,x: 'x' is no power"));
  EXPECT_THAT(message_of("-1"), HasSubstr("is no power"));
  EXPECT_THAT(message_of("0"), HasSubstr("is no power"));
  EXPECT_THAT(message_of("inf"), HasSubstr("is no power"));
  EXPECT_THAT(message_of("15,...,20"), HasSubstr("'...' is no power"));
  EXPECT_THAT(message_of("15,20,..."), HasSubstr("a power must follow"));
  EXPECT_THAT(message_of("15,20,...,33"), HasSubstr("do not lead to"));
  EXPECT_THAT(message_of("20,15,...,30"), HasSubstr("do not lead to"));
  EXPECT_THAT(message_of("15,20,15"), HasSubstr("15 stands in it twice"));
  EXPECT_THAT(message_of("1,2,...,1e9"), HasSubstr("more than 32 powers"));
}

TEST(Plan, CountsAcceptedKicksOfItsPowers) {
  const CalibrationPlan plan{.powers = {15, 20}, .trials = 2};
  const std::vector<LobRecord> lobs{lob_of(15), lob_of(15, Refusal::kOperator), lob_of(20), lob_of(20), lob_of(25),
                                    LobRecord{}};
  EXPECT_THAT(kicks_done(plan, lobs), ElementsAre(1, 2));
}

TEST(Plan, GoesOnWhenAPowerHasItsKicksAndComesBackForThoseThatLack) {
  const CalibrationPlan plan{.powers = {15, 20, 25}, .trials = 2};
  EXPECT_EQ(next_power(plan, {1, 0, 0}, 15), 15);
  EXPECT_EQ(next_power(plan, {2, 0, 0}, 15), 20);
  EXPECT_EQ(next_power(plan, {2, 2, 1}, 20), 25);
  EXPECT_EQ(next_power(plan, {1, 2, 2}, 25), 15) << "one was rejected";
  EXPECT_EQ(next_power(plan, {2, 2, 2}, 25), std::nullopt) << "all done: a further kick is nobody's trial";
  EXPECT_EQ(next_power(plan, {2, 2, 3}, 25), 25) << "named by hand when all was done";
  EXPECT_EQ(next_power(plan, {2, 0, 0}, 99), 20) << "a power outside the plan";
  EXPECT_EQ(next_power({}, {}, 30), 30) << "no plan";
}

}  // namespace
}  // namespace trivela::pages
