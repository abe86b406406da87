// The changes of inputs and outputs in a log. Pulses at places (compare) are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/channel_event_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hardware/output_change.hpp"
#include "core/machine.hpp"
#include "services/record/reading/channel_stream.hpp"

namespace lockstep::analysis {

struct ChannelChange {
    Tick at;            // machine time
    std::string motor;  // whose device has the channel
    ChannelEvent::Kind kind = ChannelEvent::Kind::Input;
    int channel = 0;
    double value = 0;  // Input: 1 closed; Digital: 1 on; Analog: share of full scale
    bool operator==(const ChannelChange&) const = default;
};

class ChannelLog {
public:
    static constexpr std::size_t kChangesKept = 1000;

    /// Leaves out messages with impossible numbers.
    void take(const channel_event_t& message);
    /// The first kChangesKept of the log, in the order of time.
    std::vector<ChannelChange> finish();
    std::uint64_t not_kept() const { return not_kept_; }

private:
    using Stream = ChannelStream<channel_event_t>;
    using Before = Stream::Before;

    void follow(const channel_event_t& message);
    void note(ChannelChange change);

    std::map<std::string, Stream> streams_;        // by motor
    std::map<std::string, std::uint16_t> levels_;  // of each device's digital outputs
    std::vector<ChannelChange> changes_;
    std::uint64_t not_kept_ = 0;
};

/// The name of its input or output in the machine's file; nullopt if the file does not name it.
std::optional<std::string> name_of(const ChannelChange& change, const MachineConfig& machine);

/// "door closed", "air on", "laser 30 %", "input 2 open"; `machine`: nullptr if it is not known.
std::string change_text(const ChannelChange& change, const MachineConfig* machine);

}  // namespace lockstep::analysis
