// The report page before its data are put in: made of the files in web/ when the command is built.
#pragma once

#include <string_view>

namespace lockstep::analysis {

/// Places for data are named between at signs: @TITLE@ and so on.
extern const std::string_view kPageTemplate;

}  // namespace lockstep::analysis
