#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluator/report/page/sections.hpp"

namespace trivela::evaluator::page {

/// The page as one HTML file that asks for nothing from anywhere: its content-security policy allows its own script and
/// style by their hashes and no request. The same text for the same data.
std::string to_html(const Report& report, const PageData& data);

/// The same of logs that `report` was made of. Throws std::runtime_error where one cannot be read at all.
std::string report_page(const Report& report, const std::vector<std::filesystem::path>& logs,
                        const PageProgress& progress = {});

}  // namespace trivela::evaluator::page
