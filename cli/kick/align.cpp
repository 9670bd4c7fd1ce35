#include "cli/kick/row_verbs.hpp"
#include "kicking/alignment/alignment.hpp"

namespace trivela::cli {
namespace {

kicking::Extension extension(const Row& row) {
  const std::string rule = row.word("rule").value_or("max");
  if (rule == "max") return kicking::Extension::kMax;
  if (rule == "add") return kicking::Extension::kAdd;
  throw CellError("rule", rule, "is neither max nor add");
}

int run_align(const RowArguments& arguments) { return run_row_verb(align_verb(), arguments); }

}  // namespace

RowVerb align_verb() {
  RowVerb verb;
  verb.inputs = {{"px", "Robot in the field frame, x [m]", true, "--px-m"},
                 {"py", "Robot in the field frame, y [m]", true, "--py-m"},
                 {"orientation_deg", "Heading, counter-clockwise, 0 faces +y [deg]"},
                 {"alpha_deg", "Deflection by the lateral velocity, right positive [deg]"},
                 {"tx", "Target in the field frame, x [m]", true, "--tx-m"},
                 {"ty", "Target in the field frame, y [m]", true, "--ty-m"},
                 {"beta_deg", "Lead angle of the rotation [deg]"},
                 {"omega_rad_s", "Turn rate, counter-clockwise positive [rad/s]", true, "--omega-radps"},
                 {"rule", "Extension of the target's segment: max (default) or add", false}};
  verb.results = [](const auto&) {
    return std::vector<std::string>{"distance_m", "offset_right_m", "left_m", "right_m", "aligned"};
  };
  verb.compute = [](const Row& row) {
    const kicking::Pose robot{row.number("px"), row.number("py"), kicking::radians(row.number("orientation_deg"))};
    const Eigen::Vector2d target(row.number("tx"), row.number("ty"));
    kicking::AlignmentRule rule;
    rule.extension = extension(row);
    const auto result = kicking::align(robot, kicking::radians(row.number_in("alpha_deg", -180.0, 180.0)),
                                       kicking::radians(row.number_in("beta_deg", -360.0, 360.0)),
                                       row.number("omega_rad_s"), target, rule);
    return std::vector<Value>{result.centre_distance_m, value_or_none(result.offset_right_m), result.left_m,
                              result.right_m, result.aligned};
  };
  return verb;
}

void add_align(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] = add_verb(app, exit_code, "align", "Is the robot aligned with the target?", run_align);
  verb->footer(
      R"(Appends distance_m, offset_right_m (empty: the line of the kick does not meet that of the target), left_m,
right_m and aligned. Columns px, py, tx, ty are in m.)");
  add_row_flags(*verb, align_verb(), *arguments);
}

}  // namespace trivela::cli
