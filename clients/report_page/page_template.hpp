// The pages before their data are inserted: made of the files in web/ when the command is built.
#pragma once

#include <string_view>

namespace lockstep::analysis {

/// Places for data are named between at signs: @TITLE@ and so on.
extern const std::string_view kPageTemplate;      // of a log
extern const std::string_view kIncidentTemplate;  // of an incident

}  // namespace lockstep::analysis
