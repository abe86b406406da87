// The changes of one analog output of a device, in the order in which they happened, and where others may be missing.
//
// Messages of a log may be shuffled within a short time. So changes wait until the reader asks for those before a tick:
// a change with the next number that has not come by then is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/channel_event_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "clients/analysis/channels/channel_course.hpp"

namespace lockstep::analysis {

struct PowerChange {
    Tick at;                        // machine time
    std::optional<ValueRamp> ramp;  // nullopt: of another channel of the device
    bool follows_gap = false;       // changes before it may be missing
};

class PowerTrack {
public:
    static constexpr std::size_t kMostWaiting = 65'536;

    PowerTrack(std::string motor, int channel) : motor_(std::move(motor)), channel_(channel) {}

    /// Leaves out messages of other devices and those that come too late or again.
    void take(const channel_event_t& message);
    /// The next change until this tick, if there is one. Passes it.
    std::optional<PowerChange> next_until(Tick tick);
    /// More changes wait than may.
    bool is_full() const { return waiting_.size() > kMostWaiting; }

private:
    struct Number {
        std::int64_t process = 0;  // in the order in which they came
        std::int64_t sequence = 0;
        auto operator<=>(const Number&) const = default;
    };
    struct Waiting {
        Tick at;
        std::optional<ValueRamp> ramp;
        std::int64_t lost = 0;
    };

    std::string motor_;
    int channel_;
    std::optional<std::int64_t> incarnation_;
    std::int64_t process_ = 0;
    std::map<Number, Waiting> waiting_;
    std::optional<std::pair<Number, std::int64_t>> passed_;  // the number of the last one, and its count of lost ones
};

}  // namespace lockstep::analysis
