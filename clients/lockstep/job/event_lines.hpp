// Writes the lines that report the events of a job while it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

class EventLines {
public:
    explicit EventLines(std::uint64_t job) : job_(job) {}

    /// Returns a line for each event of the job, and a line where events were not received. `events`: the next
    /// received.
    std::vector<std::string> of(std::span<const PublishedEvent> events);

private:
    std::uint64_t job_;
    std::optional<PublishedEvent> last_;  // the last received, of any job
};

}  // namespace lockstep
