#include "log/file/ask_to_stop.hpp"

#include <utility>

namespace trivela::log {
namespace {

thread_local const std::function<bool()>* t_stop = nullptr;

}  // namespace

AskToStop::AskToStop(std::function<bool()> stop) : stop_(std::move(stop)) { t_stop = &stop_; }

AskToStop::~AskToStop() { t_stop = nullptr; }

bool AskToStop::says_stop() { return t_stop != nullptr && (*t_stop)(); }

}  // namespace trivela::log
