// Decodes a log's events and passes them to a listener one by one. Nothing is kept.
//
// Unreadable parts are reported too, with their place in the file, and reading continues after them.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <lockstep/axis_health_t.hpp>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <lockstep/program_part_t.hpp>
#include <lockstep/run_t.hpp>
#include <lockstep/step_batch_t.hpp>
#include <string>
#include <string_view>

#include "services/record/reading/damage.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/recorded_mark.hpp"

namespace lockstep::analysis {

/// `place` is the event's place in the file.
class LogListener {
public:
    virtual ~LogListener() = default;
    virtual void on_steps(const step_batch_t& message, LogPlace place) = 0;
    virtual void on_position(const axis_position_t& message, LogPlace place) = 0;
    virtual void on_run(const run_t& message, LogPlace place) = 0;
    virtual void on_job(const RecordedJob& message, LogPlace place) = 0;
    virtual void on_health(const axis_health_t& /*message*/, LogPlace /*place*/) {}
    /// A change of an input or output of a device.
    virtual void on_channel(const channel_event_t& /*message*/, LogPlace /*place*/) {}
    /// Events share one sequence of numbers with the jobs.
    virtual void on_event(const program_event_t& /*message*/, LogPlace /*place*/) {}
    /// For listeners that count messages. Jobs already have their programs (program_parts.hpp).
    virtual void on_program_part(const program_part_t& /*message*/, LogPlace /*place*/) {}
    virtual void on_mark(const RecordedMark& /*mark*/, LogPlace /*place*/) {}
    /// An event on a channel that is not Lockstep's.
    virtual void on_foreign(std::string_view channel) = 0;
    /// The content cannot be read or decoded.
    virtual void on_damage(LogPlace place, std::string what) = 0;
};

/// Returns the number of events read. Calls `progress` with 0 ... 1 from time to time. The error is a sentence for the
/// user: the file is missing, a directory, empty, or not a log.
std::expected<std::uint64_t, std::string> read_log(const std::filesystem::path& path, LogListener& listener,
                                                   const std::function<void(double)>& progress = {});

}  // namespace lockstep::analysis
