// Compares the recorded changes of a device's outputs with those of the frames that it ran. Each must be at its tick,
// with its level, or its value and slope, and there must be no other while a frame runs. Pulses at places must be those
// that the steps make. Changes at rest are not compared.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/findings.hpp"
#include "core/hardware/output_change.hpp"
#include "services/record/reading/channel_stream.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

class OutputCheck {
public:
    OutputCheck(std::string axis, Findings& findings) : axis_(std::move(axis)), findings_(findings) {}

    /// A change of an output on record.
    struct Seen {
        std::int64_t incarnation = 0;  // of the axis's process
        std::int64_t sequence = 0;
        std::int64_t lost = 0;  // by the device, so far
        ChannelEvent event;
    };
    void take(const Seen& seen);

    /// The changes of a body or a tail that was run whole.
    struct Planned {
        std::int64_t incarnation = 0;
        Tick begin;  // by the device's clock, as the next
        Tick end;
        std::vector<OutputChange> changes;  // ticks are those of the plan
        Ticks ticks;                        // of the plan
        bool is_retimed = false;            // the device has a clock of its own
        Ticks clock_error;
        /// When the device made a change.
        Tick tick_of(const OutputChange& change) const;
        std::string commanded;                            // the job and its frame
        std::optional<std::vector<ChannelEvent>> pulses;  // as its steps make them; nullopt: not known
    };
    void take(Planned planned);

    /// Requires all changes of that process from this number on to be in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number) { expected_.try_emplace(incarnation, number); }
    /// Whether changes of inputs or outputs between those of the log are known to be missing.
    bool lacks_changes() const { return lacks_changes_; }
    /// Call once, at the end of the log. `is_whole`: the log lacks no messages.
    void finish(bool is_whole);

private:
    using Before = analysis::ChannelStream<Seen>::Before;
    static constexpr std::size_t kMostWaiting = 65'536;

    /// What is compared: the outputs after a change.
    struct Expected {
        Tick tick;
        ChannelEvent event;
    };
    std::vector<Expected> expected_of(const Planned& planned) const;
    void follow(const Seen& seen, Before before);
    void compare_passed();
    void compare(const Planned& planned);
    void differ(const Planned& planned, const std::string& text, std::optional<Tick> expected,
                std::optional<Tick> seen);
    bool compare_pulses(const Planned& planned);
    bool is_same(const Expected& expected, const ChannelEvent& seen, const Planned& planned) const;
    void note_gap(const Seen& seen, Before before);
    void check_beginnings();
    void lose();
    void pass(const Planned& planned);

    std::string axis_;
    Findings& findings_;
    analysis::ChannelStream<Seen> stream_;
    std::deque<Seen> seen_;        // not compared yet
    std::deque<Planned> planned_;  // not compared yet
    std::optional<Seen> last_;
    std::map<std::int64_t, std::int64_t> expected_;  // by process: the first number that must be in the log
    std::map<std::int64_t, Seen> first_;             // of each process, if it is not its number 0
    bool lacks_changes_ = false;
    std::optional<Tick> unknown_until_;    // changes before it are missing
    std::optional<std::uint16_t> levels_;  // after the events compared; nullopt: not known
};

}  // namespace lockstep::verification
