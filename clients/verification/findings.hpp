// The results of a verification so far, in the order of the log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "services/record/reading/record_end.hpp"

namespace lockstep::verification {

/// A difference between the log and its required content.
struct Difference {
    std::string text;                   // the difference, with the values on both sides
    std::string axis;                   // empty if it is not of a single axis
    std::optional<Tick> tick_expected;  // nullopt if no such step was expected
    std::optional<Tick> tick_seen;      // nullopt if the step was not made, or is not in the log
    std::string commanded;              // the job, its line, epoch and frame there
};

enum class Verdict : std::uint8_t {
    Exact,     // the log contains what it must, and nothing else
    Unknown,   // messages are missing; all others agree
    NotExact,  // the log contradicts its programs or itself
};

/// "exact", "unknown", "not exact"
std::string_view name_of(Verdict verdict);

struct Findings {
    std::int64_t steps = 0;                 // compared and equal
    std::int64_t runs = 0;                  // of jobs, equal to their plan
    std::int64_t local_runs = 0;            // of axes on their own: homing, own moves
    std::int64_t jobs = 0;                  // moves and programs, from begin to end
    std::int64_t events = 0;                // of programs, each at its place
    std::int64_t outputs = 0;               // changes of outputs by frames, each at its tick
    std::optional<Tick> last_tick;          // of the steps compared
    Ticks latest;                           // the largest time error of a step of a frame, in machine time
    Ticks clock_error;                      // uncertainty of machine time; 0 if one clock drives all devices
    std::optional<Difference> difference;   // the first
    std::optional<std::string> unreadable;  // the documents of the log that cannot be decoded
    std::vector<std::string> unknown;       // results that are unknown, since the log lacks data; the first kUnknown
    std::uint64_t more_unknown = 0;         // beyond these
    std::vector<std::string> notes;
    analysis::MotorLabels labels;
    bool lacks_messages = false;  // between others
    bool lacks_steps = false;     // steps of runs on record, or of runs that the plan demands, are not in the log
    analysis::RecordEnd end;

    static constexpr std::size_t kUnknown = 100;

    /// The log suffices for a result and contains no difference.
    bool is_exact() const { return verdict() == Verdict::Exact; }
    Verdict verdict() const {
        if (difference) { return Verdict::NotExact; }
        return unknown.empty() && end.missing.empty() ? Verdict::Exact : Verdict::Unknown;
    }
    /// "axis X", or "motor Y2" once the machine is known.
    std::string label_of(const std::string& motor) const { return labels.of(motor); }
    /// Nothing more is compared after the first difference or an unreadable document.
    bool going() const { return !difference && !unreadable; }
    void add_unknown(std::string what) {
        if (!going()) { return; }
        unknown.size() < kUnknown ? unknown.push_back(std::move(what)) : void(++more_unknown);
    }
    /// Messages are missing between others.
    void add_missing(std::string what) {
        add_unknown(std::move(what));
        lacks_messages = true;
    }
    void differ(Difference found) {
        if (going()) { difference = std::move(found); }
    }
};

}  // namespace lockstep::verification
