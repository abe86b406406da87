// The events of programs that have happened: published once each, in order, and what they have switched.
#pragma once

#include <cstdint>

#include "core/coordinator/path/event_queue.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"
#include "core/program_devices.hpp"

namespace lockstep {

class ProgramEvents {
public:
    struct Of {
        std::uint64_t job = 0;
        Epoch epoch = 0;
    };

    /// A program begins. The devices stay as they are.
    void begin(std::uint32_t first = 0) { from_ = first; }
    /// The motion came to its place at `tick`.
    void happen(const PathEvent& event, Tick tick, const Of& of, CoordinatorLoop& loop);
    /// The axes rest behind its place. An event that was published before is left out.
    void pass(const PathEvent& event, const Of& of, CoordinatorLoop& loop);
    /// The job ended before its end: spindle and coolant, where they are on, are switched off. Outputs stay.
    void switch_off(std::uint64_t job, CoordinatorLoop& loop);
    /// From the owner before.
    void inherit(const ProgramDevices& devices) { devices_ = devices; }

    const ProgramDevices& devices() const { return devices_; }
    /// Events before this block of the program have been published.
    std::uint32_t from() const { return from_; }

private:
    void publish(PublishedEvent event, CoordinatorLoop& loop);
    void publish(const PathEvent& event, PublishedEvent place, CoordinatorLoop& loop);

    ProgramDevices devices_;
    std::uint32_t from_ = 0;
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep
