// Checks that the zero of a motor moves between its runs only where the record tells why. Machine coordinates are the
// device's count minus the zero of the run.
//
// | why the zero moves | what the record has |
// |---|---|
// | homing by switches or by touch, a process that does not know its position | positions that are not homed |
// | homing in place | a job of homing; the positions are homed before and after it |
// | lost steps are made up | a following error, by which the zero moves back, and then another one |
//
// An encoder may show other lost steps between two positions. Then it is unknown whether a correction is the right one.
//
// Nothing else moves it: a kept position, a takeover, a hold, a jog and a touch of a probe leave it where it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/positions/homing_jobs.hpp"
#include "clients/verification/positions/seen_position.hpp"
#include "clients/verification/process_order.hpp"
#include "core/machine.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

class ZeroCheck {
public:
    /// How many positions wait for a missing one before it is given up: datagrams may overtake each other.
    static constexpr std::size_t kPatience = 16;
    /// The maximum number of reasons that wait for the runs around them. The oldest are forgotten first.
    static constexpr std::size_t kMaxReasons = 4096;

    /// Ticks of machine time.
    struct Span {
        Tick from;
        Tick to;
        bool meets(const Span& other) const { return from <= other.to && other.from <= to; }
    };
    /// The zero moves between two runs.
    struct Change {
        Span span;
        std::int64_t change = 0;
        std::string text;
        std::string commanded;    // in the second run
        std::string why_unknown;  // empty if the log has all that could tell a reason
    };

    /// The machine is known from its first job on.
    void set_machine(const MachineConfig& machine, const std::string& motor);
    void take(const SeenPosition& position);
    /// Two runs of which the second is the next one of the axis. `commanded`: in the second one.
    void take(const analysis::Run& before, const analysis::Run& run, const std::function<std::string()>& commanded);
    /// Call once, at the end of the log. Returns the changes for which it tells no reason. `lacks_jobs`: the log lacks
    /// records of jobs.
    std::vector<Change> finish(const HomingJobs& homings, bool lacks_jobs);

private:
    /// What positions tell about the zero in a span.
    struct Reason {
        enum class Kind : std::uint8_t {
            NotHomed,   // it may move anywhere
            Corrected,  // it may move by `change`
            Missing,    // positions are not in the log
        };
        Kind kind = Kind::Missing;
        Span span;
        std::int64_t change = 0;
    };

    void deliver(std::size_t patience);
    void pass(const SeenPosition& position);
    void add(Reason::Kind kind, Span span, std::int64_t change = 0);
    void settle(bool log_ended);
    bool is_told(Change& change) const;

    std::optional<std::int64_t> tick_ns_;  // of the machine
    bool homes_in_place_ = false;
    ProcessOrder processes_;
    std::optional<std::int64_t> incarnation_;       // of the newest process
    std::map<std::int64_t, SeenPosition> waiting_;  // its positions, by number
    std::int64_t expected_ = 0;                     // the number of its next position
    std::optional<SeenPosition> last_;
    std::deque<Reason> reasons_;      // in order
    std::optional<Tick> known_from_;  // earlier reasons are forgotten, or before the log
    std::deque<Change> changes_;      // for which later positions are needed
    std::vector<Change> untold_;      // for which the positions tell no reason
};

}  // namespace lockstep::verification
