// The difference of two JSON documents as a merge patch (RFC 7396). Pure.
#pragma once

#include <nlohmann/json.hpp>

namespace lockstep::web {

/// Returns the patch that makes `to` from `from`; members that are null count as absent. Both are objects. The patch is
/// empty if they are equal.
nlohmann::json merge_patch(const nlohmann::json& from, const nlohmann::json& to);

}  // namespace lockstep::web
