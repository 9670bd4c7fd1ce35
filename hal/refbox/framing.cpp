#include "hal/refbox/framing.hpp"

#include <utility>

namespace trivela::hal::refbox {

void Framing::extend(std::string_view part) {
  if (overlong_) return;
  if (pending_.size() + part.size() > kLongestObject_B) {
    overlong_ = true;
    std::string{}.swap(pending_);
    return;
  }
  pending_ += part;
}

std::vector<Framed> Framing::add(std::string_view bytes) {
  std::vector<Framed> whole;
  for (auto end = bytes.find('\0'); end != std::string_view::npos; end = bytes.find('\0')) {
    extend(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
    std::string text = std::exchange(pending_, {});
    const bool overlong = std::exchange(overlong_, false);
    if (overlong || text.find_first_not_of(" \t\r\n") != std::string::npos)
      whole.push_back({std::move(text), overlong});
  }
  extend(bytes);
  return whole;
}

}  // namespace trivela::hal::refbox
