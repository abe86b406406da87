// Events that interrupted or changed motion (faults, stops, tails, overrides), with the positions of the axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/axis_position_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::analysis {

struct Event {
    Tick at;  // machine time
    std::string what;
    std::string axis;    // empty: an event of the machine
    std::string remedy;  // empty if none is known
    bool is_fault = false;
    std::optional<std::uint64_t> job;              // in motion at that time
    std::optional<std::int32_t> line;              // of its program
    std::map<std::string, std::int64_t> at_steps;  // of each axis, as last received
};

class EventLog {
public:
    static constexpr std::size_t kEventsKept = 1000;

    void take(const axis_position_t& message);
    void take(const std::string& axis, const Run& run);
    void note(Event event);

    std::vector<Event>& events() { return events_; }  // the first kEventsKept, in the order of the log
    std::uint64_t not_kept() const { return not_kept_; }

private:
    std::map<std::string, std::int64_t> at_steps_;
    std::map<std::string, std::int32_t> faults_;  // of each axis, as last received
    std::optional<std::pair<Epoch, FrameNumber>> latest_tail_;
    std::vector<Event> events_;
    std::uint64_t not_kept_ = 0;
};

}  // namespace lockstep::analysis
