#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/kicking/lob_scene.hpp"

namespace {

std::size_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trivela::kicking::lob {
namespace {

TEST(Allocation, ThereIsNoneInAScanOnceTheBuffersHaveGrown) {
  sim::RecordPlan plan;
  plan.kicks.assign(3, tests::kick(8.39, 36.78));
  const auto record = sim::synthesize_record({}, plan, {}, 1);
  Analyzer analyzer({}, record.mount);
  int lobs = 0, seen = 0;
  for (const Scan& scan : record.scans) {
    const std::size_t before = allocations;
    const auto lob = analyzer.add(scan);
    EXPECT_TRUE(lobs == 0 || lob || allocations == before) << "at " << scan.t_ns;
    lobs += lob.has_value();
    seen += lobs > 0 && analyzer.view().track != nullptr;
  }
  EXPECT_EQ(lobs, 3);
  EXPECT_GT(seen, 60);
}

}  // namespace
}  // namespace trivela::kicking::lob
