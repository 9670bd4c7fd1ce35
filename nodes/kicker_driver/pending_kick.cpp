#include "nodes/kicker_driver/pending_kick.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace trivela::nodes {

std::string PendingKick::name_of(const config::Domain& domain, std::uint8_t robot_id) {
  constexpr std::size_t kLongest = 200;
  std::string name = fmt::format("trivela-kick-{}-{}-{}", domain.domain_id, robot_id, domain.tag);
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return name.substr(0, kLongest);
}

PendingKick::PendingKick(const std::string& name) : name_("/" + name) {
  const int file = ::shm_open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  void* place = MAP_FAILED;
  if (file >= 0 && ::ftruncate(file, sizeof(Record)) == 0)
    place = ::mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (place == MAP_FAILED) why_ = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (place == MAP_FAILED) return;
  record_ = static_cast<Record*>(place);  // zeros where it is new
  const State state = record_->state;
  // Of another program, or of another version of this one, it may hold anything.
  const bool known = state == State::kAccepted || state == State::kBeingTold;
  if (known && record_->receipt.kick_id > 0) left_ = Left{record_->receipt, state == State::kBeingTold};
}

PendingKick::~PendingKick() {
  if (record_ == nullptr) return;
  if (record_->state == State::kNone) ::shm_unlink(name_.c_str());
  ::munmap(record_, sizeof(Record));
}

void PendingKick::accepted(const msg::KickReceipt& receipt) {
  left_.reset();
  if (record_ == nullptr) return;
  record_->state = State::kNone;
  record_->receipt = receipt;
  record_->state = State::kAccepted;
}

void PendingKick::being_told() noexcept {
  if (record_ != nullptr) record_->state = State::kBeingTold;
}

void PendingKick::settled() noexcept {
  if (record_ != nullptr) record_->state = State::kNone;
}

}  // namespace trivela::nodes
