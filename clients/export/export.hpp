// Exports a log's positions, health and jobs in a format for other tools. Reads the log in one pass (two for CSV), in
// memory that does not grow with it.
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
    std::int64_t left_out = 0;  // too late for their row, of a topic beyond the maximum number, or without a valid time
    std::int64_t damages = 0;   // places in the log that could not be read
    analysis::RecordState record;
};

/// Creates or replaces `to`, which gets its name when it is complete. Calls `progress` with 0 ... 1 from time to time.
/// Fails if the log cannot be read or has no data to export, or if the file cannot be written.
std::expected<Exported, std::string> export_log(const std::filesystem::path& log, const std::filesystem::path& to,
                                                Format format, const std::function<void(double)>& progress = {});

}  // namespace lockstep::exporting
