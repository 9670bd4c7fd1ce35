#include "bus/waitset.hpp"

#include <dds/dds.h>

namespace trivela::bus {

Waitset::Waitset(const Participant& participant)
    : participant_(participant),
      entity_(checked(dds_create_waitset(participant.handle()), "dds_create_waitset", "participant")) {}

void Waitset::attach(std::int32_t condition, std::intptr_t id) {
  checked(dds_waitset_attach(entity_.handle(), condition, id), "dds_waitset_attach", "condition");
  buffer_.resize(buffer_.size() + 1);
  triggered_.reserve(buffer_.size());
}

const std::vector<std::intptr_t>& Waitset::wait(std::chrono::nanoseconds timeout) {
  const dds_duration_t span = timeout == std::chrono::nanoseconds::max() ? DDS_INFINITY : timeout.count();
  const auto count = static_cast<std::size_t>(
      checked(dds_waitset_wait(entity_.handle(), buffer_.data(), buffer_.size(), span), "dds_waitset_wait", "waitset"));
  triggered_.assign(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(std::min(count, buffer_.size())));
  return triggered_;
}

Guard::Guard(const Participant& participant)
    : participant_(participant),
      entity_(checked(dds_create_guardcondition(participant.handle()), "dds_create_guardcondition", "participant")) {}

void Guard::set() { checked(dds_set_guardcondition(entity_.handle(), true), "dds_set_guardcondition", "guard"); }

bool Guard::is_set() const {
  bool set = false;
  checked(dds_read_guardcondition(entity_.handle(), &set), "dds_read_guardcondition", "guard");
  return set;
}

}  // namespace trivela::bus
