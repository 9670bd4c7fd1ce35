#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

const char* name(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kTooFewPoints:
      return "too_few_points";
    case Refusal::kOneSideOfApex:
      return "one_side_of_apex";
    case Refusal::kPlaneMisaligned:
      return "plane_misaligned";
    case Refusal::kBadFit:
      return "bad_fit";
    case Refusal::kOperator:
      break;
  }
  return "operator";
}

}  // namespace trivela::kicking::lob
