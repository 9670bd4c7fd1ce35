#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/counting/log_opportunities.hpp"

namespace trivela::evaluator {

/// How the groups of a dataset came about, by what its logs say. `rows` are the places in logged.rows of the dataset's
/// opportunities; `drawn`: chance chose the group of each.
void infer_design(KickDataset& dataset, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows,
                  const std::string& by, bool drawn);

/// Of a paired dataset, where halves have the same possessions: of situations that a group had in several halves the
/// first. `rows` as for infer_design(), which stay in step.
void keep_first_of_paired_halves(KickDataset& dataset, const LoggedOpportunities& logged,
                                 std::vector<std::size_t>& rows);

/// Of a paired dataset the opportunities whose setting all groups played: what else differs is then the same for all.
/// Throws std::runtime_error where there is no such setting, or a group has an opportunity twice.
void keep_common_settings(KickDataset& dataset, const std::string& by);

}  // namespace trivela::evaluator
