// The result of a merge, as text and as the report of `lockstep log merge --json`.
#pragma once

#include <string>

#include "clients/merge/log_merge.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::merge {

/// A table of logs, a table of axes, and a line for everything that is missing or could not be read.
std::string to_text(const Merged& merged, const std::filesystem::path& written);
proto::MergeReport to_report(const Merged& merged, const std::filesystem::path& written);

}  // namespace lockstep::merge
