// What a verification has found so far, in the order of the log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/log/record_end.hpp"
#include "core/units.hpp"

namespace lockstep::verification {

/// Where the log is not what it must be.
struct Difference {
    std::string text;                   // what, with the values on both sides
    std::string axis;                   // empty: no single one
    std::optional<Tick> tick_expected;  // none: no such step was expected
    std::optional<Tick> tick_seen;      // none: the step was not made, or is not in the log
    std::string commanded;              // the job, its line, epoch and frame there
};

struct Findings {
    std::int64_t steps = 0;                 // compared and equal
    std::int64_t runs = 0;                  // of jobs, equal to what is planned for them
    std::int64_t local_runs = 0;            // of axes on their own: homing, own moves
    std::int64_t jobs = 0;                  // moves and programs, from begin to end
    std::optional<Tick> last_tick;          // of the steps compared
    Ticks latest;                           // a step of a frame was made so far from its time at most: machine time...
    Ticks clock_error;                      // ...which was known within; 0: one clock drives all devices
    std::optional<Difference> difference;   // the first
    std::optional<std::string> unreadable;  // what of the log's documents cannot be understood
    std::vector<std::string> unknown;       // what cannot be told, since the log does not have it
    std::vector<std::string> notes;
    analysis::RecordEnd end;

    /// Of what the log has, and so much of it that there is something to tell.
    bool is_exact() const { return !difference && unknown.empty() && end.missing.empty(); }
    /// Nothing is compared behind the first difference.
    bool going() const { return !difference && !unreadable; }
    void cannot_tell(std::string what) {
        if (going()) { unknown.push_back(std::move(what)); }
    }
    void differ(Difference found) {
        if (going()) { difference = std::move(found); }
    }
};

}  // namespace lockstep::verification
