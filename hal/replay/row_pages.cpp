#include "hal/replay/row_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "evaluator/log/row.hpp"

namespace trivela::hal {

constexpr int kPageRows = 1024;

std::string page_sql(const ReplayLog& log, std::string_view message, const std::vector<std::string>& columns,
                     std::int64_t after_seq) {
  return fmt::format("SELECT {} FROM {} WHERE session_id = {} AND robot_id = {} AND seq > {} ORDER BY seq LIMIT {}",
                     fmt::join(columns, ", "), evaluator::log::table_of_message(message).value(), log.session_id,
                     log.robot_id, after_seq, kPageRows);
}

}  // namespace trivela::hal
