#include "tests/bench/chain/tuning.hpp"

#include <dds/dds.h>
#include <dds/ddsc/dds_loan_api.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "bus/domain/process.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bench/chain/domains.hpp"

namespace trivela::bench {
namespace {

constexpr int kPriority = 50;
constexpr std::size_t kHugePage = 2 << 20;

void refused(const char* what) { fmt::print(stderr, "chain_bench: {} is not permitted here\n", what); }

bool keep_awake() {
  const int file = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);  // held until the process ends
  const std::int32_t longest_us = 0;
  return file >= 0 && write(file, &longest_us, sizeof longest_us) == sizeof longest_us;
}

/// The writable private mappings of this process of a huge page or more, and its heap, grown to some of them.
bool ask_for_huge_pages() {
  mallopt(M_TOP_PAD, 4 * kHugePage);
  free(malloc(kHugePage));
  std::ifstream maps("/proc/self/maps");
  bool asked = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::string rights;
    words >> std::hex >> begin >> dash >> end >> rights;
    const std::uintptr_t from = (begin + kHugePage - 1) / kHugePage * kHugePage, to = end / kHugePage * kHugePage;
    if (rights != "rw-p" || from >= to) continue;
    asked = madvise(std::bit_cast<void*>(from), to - from, MADV_HUGEPAGE) == 0 || asked;
  }
  return asked;
}

void tune(const Tuning& tuning) {
  if (tuning.awake && !keep_awake()) refused("/dev/cpu_dma_latency");
  const sched_param parameters{kPriority};
  if (tuning.scheduled && sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) refused("SCHED_FIFO");
  if (tuning.pinned) bus::stay_on(bus::processors_allowed().back());
  if (tuning.huge && !ask_for_huge_pages()) refused("memory in huge pages");
  if (!tuning.locked) return;
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) refused("locked memory");
}

}  // namespace

std::vector<Contender::Process> tuned(const Tuning& tuning, const std::vector<Contender::Process>& processes) {
  std::vector<Contender::Process> made;
  for (const Contender::Process& process : processes) {
    made.push_back([=](Track& track) {
      tune(tuning);
      process(track);
    });
  }
  return made;
}

std::string about_loans() {
  std::string answer;
  const bus::Writer<msg::Odometry> writer{bus::Participant(own_domain(60))};
  void* sample = nullptr;
  const dds_return_t result = dds_loan_sample(writer.handle(), &sample);
  if (result == DDS_RETCODE_OK) dds_return_loan(writer.handle(), &sample, 1);
  return fmt::format("Loans for what is written, which would spare an allocation a sample: {}",
                     result == DDS_RETCODE_OK ? "given" : dds_strretcode(-result));
}

}  // namespace trivela::bench
