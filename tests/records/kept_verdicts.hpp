// The verdicts of the tests, kept for records_table, which then need not judge the same records again: a file for each
// record, in the folder that the environment variable LOCKSTEP_VERDICTS names. Without it nothing is kept.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "tests/records/verdicts.hpp"

namespace lockstep::records {

using ToolVerdicts = std::array<Verdict, kTools>;  // in the order of Tool

/// `record`: a name that no other record has, such as "valid homing".
void keep_verdicts(const std::string& record, const Judgement& judgement);
/// Those that were kept, or else those of `judge`.
ToolVerdicts verdicts_about(const std::string& record, const std::function<Judgement()>& judge);

}  // namespace lockstep::records
