// The findings about one axis: each text begins with the axis, and a difference has what was commanded there. Counts
// the steps that are equal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "clients/verification/findings.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

/// "tick 12"; nullopt: `otherwise`
std::string at_tick(const std::optional<Tick>& tick, const char* otherwise);

class AxisFindings {
public:
    /// The motion at a tick of a run, as text.
    using Commanded = std::function<std::string(const analysis::Run&, Tick)>;

    AxisFindings(std::string axis, Findings& all, Commanded commanded)
        : axis_(std::move(axis)), all_(all), commanded_(std::move(commanded)) {}

    const std::string& axis() const { return axis_; }
    std::string commanded(const analysis::Run& run, Tick tick) const { return commanded_(run, tick); }
    Findings& all() { return all_; }
    bool going() const { return all_.going(); }

    void note(const std::string& text) { all_.notes.push_back(labelled(text)); }
    void add_unknown(const std::string& text) { all_.add_unknown(labelled(text)); }
    void add_missing(const std::string& text) { all_.add_missing(labelled(text)); }
    /// `lacks_steps`: the log lacks steps there, so that something remains unknown.
    void report(const std::string& text, bool lacks_steps);
    /// `run`: to which it belongs; null if there is none.
    void differ(const std::string& text, const analysis::Run* run, std::optional<Tick> expected,
                std::optional<Tick> seen);
    void differ(const std::string& text, std::optional<Tick> expected, std::optional<Tick> seen, std::string commanded);

    /// So many more steps are equal; the last of them is at this tick.
    void add_equal(std::size_t steps, Tick last);
    std::int64_t steps() const { return steps_; }
    const std::optional<Tick>& last_tick() const { return last_tick_; }
    /// "tick 12", of the last equal step, or "the log's beginning"
    std::string last_place() const { return at_tick(last_tick_, "the log's beginning"); }

private:
    std::string labelled(const std::string& text) const { return all_.label_of(axis_) + ": " + text; }

    std::string axis_;
    Findings& all_;
    Commanded commanded_;
    std::int64_t steps_ = 0;
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::verification
