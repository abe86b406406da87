// The logs that a user names, singly or by their directory.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/merge/sessions.hpp"

namespace lockstep::merge {

/// A directory stands for all *.lcm files in it, in the order of their names. Fails if it contains none.
std::expected<std::vector<GivenLog>, std::string> named_logs(const std::vector<std::filesystem::path>& names);

}  // namespace lockstep::merge
