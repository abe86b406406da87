// The program events that have happened. Each is published once, in order. Keeps the state of what they have switched.
#pragma once

#include <algorithm>
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
    /// The motion reached the event's place at `tick`.
    void happen(const PathEvent& event, Tick tick, const Of& of, const LoopView& loop,
                std::vector<PublishedEvent>& out);
    /// The axes rest beyond the event's place. An event that was published before is left out.
    void pass(const PathEvent& event, const Of& of, const LoopView& loop, std::vector<PublishedEvent>& out);
    /// The job ended early. Switches off spindle and coolant if they are on, and outputs that do not keep their levels.
    void switch_off(std::uint64_t job, JobOutcome outcome, const LoopView& loop, std::vector<PublishedEvent>& out);
    /// A fault without a job. Switches off what its outputs have switched off.
    void switch_off_outputs(std::uint64_t job, JobOutcome outcome, const LoopView& loop,
                            std::vector<PublishedEvent>& out);
    /// Takes the devices' state from the last owner.
    void inherit(const ProgramDevices& devices) { devices_ = devices; }

    /// The machine rests, and its device has not made so many of the pulses.
    void note_pulses(std::uint32_t left) { devices_.pulses.left = std::min(left, devices_.pulses.count); }

    const ProgramDevices& devices() const { return devices_; }
    /// Events before this block of the program have been published.
    std::uint32_t from() const { return from_; }

private:
    void end_by(const ProgramEvent& end, std::uint64_t job, const LoopView& loop, std::vector<PublishedEvent>& out);
    void publish(PublishedEvent event, const LoopView& loop, std::vector<PublishedEvent>& out);
    void publish(const PathEvent& event, PublishedEvent place, const LoopView& loop, std::vector<PublishedEvent>& out);

    ProgramDevices devices_;
    std::uint32_t from_ = 0;
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep
