// Ctrl-C while matches are computed: the first asks, the second ends the program.
#include "cli/launch/signals.hpp"

#include <gmock/gmock.h>

namespace trivela::cli {
namespace {

using testing::HasSubstr;

using Handler = void (*)(int);

Handler handler_of(int signal) {
  struct sigaction now {};
  sigaction(signal, nullptr, &now);
  return now.sa_handler;
}

TEST(StopRequest, TheFirstSignalAsksAndSaysWhatHappens) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const StopRequest request;
    EXPECT_FALSE(StopRequest::asked()) << "what was asked of the run before does not count";
    testing::internal::CaptureStderr();
    raise(signal);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("stops after the matches under way"));
    EXPECT_TRUE(StopRequest::asked());
  }
}

TEST(StopRequest, TheSecondSignalEndsTheProgramWhicheverCameFirst) {
  for (const auto& [first, second] : {std::pair{SIGINT, SIGINT}, std::pair{SIGTERM, SIGINT}}) {
    EXPECT_EXIT(
        {
          const StopRequest request;
          raise(first);
          raise(second);
        },
        testing::KilledBySignal(second), "Ctrl-C once more stops at once");
  }
}

TEST(StopRequest, LeavesTheSignalsAsTheyWere) {
  const Handler interrupt = handler_of(SIGINT), terminate = handler_of(SIGTERM);
  {
    const StopRequest request;
    EXPECT_NE(handler_of(SIGINT), interrupt);
    EXPECT_NE(handler_of(SIGTERM), terminate);
    testing::internal::CaptureStderr();
    raise(SIGTERM);
    testing::internal::GetCapturedStderr();
  }
  EXPECT_EQ(handler_of(SIGINT), interrupt);
  EXPECT_EQ(handler_of(SIGTERM), terminate);
}

}  // namespace
}  // namespace trivela::cli
