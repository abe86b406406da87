// The subroutines of deploy/subroutines, which every program can call.
#pragma once

#include <optional>
#include <string_view>

namespace lockstep {

/// The text of the file NAME.ngc; nullopt if there is none.
std::optional<std::string_view> builtin_subroutine(std::string_view name);

}  // namespace lockstep
