#include "clients/verification/steps/axis_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lockstep::verification {

std::string at_tick(const std::optional<Tick>& tick, const char* otherwise) {
    return tick ? fmt::format("tick {}", tick->value) : otherwise;
}

void AxisFindings::report(const std::string& text, bool lacks_steps) {
    all_.lacks_steps = all_.lacks_steps || lacks_steps;
    lacks_steps ? add_unknown(text) : note(text);
}

void AxisFindings::differ(const std::string& text, const analysis::Run* run, std::optional<Tick> expected,
                          std::optional<Tick> seen) {
    differ(text, expected, seen, run != nullptr ? commanded_(*run, expected.value_or(run->start)) : "");
}

void AxisFindings::differ(const std::string& text, std::optional<Tick> expected, std::optional<Tick> seen,
                          std::string commanded) {
    all_.differ({.text = labelled(text),
                 .axis = axis_,
                 .tick_expected = expected,
                 .tick_seen = seen,
                 .commanded = std::move(commanded)});
}

void AxisFindings::add_equal(std::size_t steps, Tick last) {
    steps_ += static_cast<std::int64_t>(steps);
    last_tick_ = last;
    all_.last_tick = std::max(all_.last_tick, last_tick_);
}

}  // namespace lockstep::verification
