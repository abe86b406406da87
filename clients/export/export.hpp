// A log's positions, health and jobs in a format for other tools. The log is read in one pass (CSV: two), in memory
// that does not grow with it.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <string>

#include "clients/analysis/record_state.hpp"

namespace lockstep::exporting {

enum class Format : std::uint8_t { Csv, Mcap };

struct Exported {
    std::int64_t samples = 0;
    std::int64_t left_out = 0;  // too late for their row, of too many topics, or of no time
    std::int64_t damages = 0;   // places in the log that could not be read
    analysis::RecordState record;
};

/// `to` is created or replaced, and gets its name when it is complete. `progress` is called with 0 ... 1 now and then.
/// Error: the log cannot be read or has no data to export, or the file cannot be written.
std::expected<Exported, std::string> export_log(const std::filesystem::path& log, const std::filesystem::path& to,
                                                Format format, const std::function<void(double)>& progress = {});

}  // namespace lockstep::exporting
