// The templates of the pages. The build generates them from the files in web/.
#pragma once

#include <string_view>

namespace lockstep::analysis {

/// Placeholders for data are names between at signs, such as @TITLE@.
extern const std::string_view kPageTemplate;      // of a log
extern const std::string_view kIncidentTemplate;  // of an incident

}  // namespace lockstep::analysis
