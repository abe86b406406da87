// The changes of inputs and outputs in a log. Pulses at places (compare) are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/channel_event_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/analysis/channels/channel_course.hpp"
#include "core/hardware/output_change.hpp"
#include "core/machine.hpp"
#include "services/record/reading/channel_stream.hpp"

namespace lockstep::analysis {

struct ChannelChange {
    Tick at;            // machine time
    std::string motor;  // whose device has the channel
    ChannelEvent::Kind kind = ChannelEvent::Kind::Input;
    int channel = 0;
    double value = 0;  // Input: 1 closed; Digital: 1 on; Analog: share of full scale; Compare: pulses to make, not made
    bool operator==(const ChannelChange&) const = default;
};

class ChannelLog {
public:
    static constexpr std::size_t kChangesKept = 1000;

    /// Leaves out messages with impossible numbers.
    void take(const channel_event_t& message);
    /// Call once, at the end of the log: the machine time that it has reached.
    void finish(Tick end);
    /// The first kChangesKept of the log, in the order of time.
    std::vector<ChannelChange>& changes() { return changes_; }
    std::uint64_t not_kept() const { return not_kept_; }
    /// Of each channel that changed, by motors and channels.
    std::vector<ChannelCourse> courses();

private:
    using Stream = ChannelStream<channel_event_t>;
    using Before = Stream::Before;

    using Channel = std::pair<ChannelEvent::Kind, int>;
    struct Device {
        Stream stream;
        std::uint16_t levels = 0;         // of its digital outputs
        std::optional<Tick> levels_from;  // since when they are known
        std::optional<std::int64_t> lost;
        Tick newest;  // of its changes
        std::map<Channel, ChannelCourse> courses;
    };

    void follow(const channel_event_t& message, Before before);
    void follow_levels(Device& device, const ChannelChange& change, std::uint16_t levels);
    static void lose(Device& device);
    static ChannelCourse& course_of(Device& device, const ChannelChange& change);
    void note(ChannelChange change);

    std::map<std::string, Device> devices_;  // by motor
    std::vector<ChannelChange> changes_;
    std::uint64_t not_kept_ = 0;
};

/// The output in the machine's file; null for an input, or if the file does not name it.
const OutputConfig* output_of(const ChannelChange& change, const MachineConfig& machine);

/// The name of its input or output in the machine's file; nullopt if the file does not name it.
std::optional<std::string> name_of(const ChannelChange& change, const MachineConfig& machine);

/// "door closed", "air on", "laser 30 %", "input 2 open"; `machine`: nullptr if it is not known.
std::string change_text(const ChannelChange& change, const MachineConfig* machine);

/// "laser", "home switch", "digital output 2"
std::string channel_text(const ChannelChange& change, const MachineConfig* machine);

}  // namespace lockstep::analysis
