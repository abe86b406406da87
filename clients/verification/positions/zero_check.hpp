// Checks that the zero of a motor moves between its runs only where the record tells why: its positions
// (services/record/reading/positions/motor_zero.hpp), and a job of homing for a homing in place.
//
// An encoder may show other lost steps between two positions. Then it is unknown whether a correction is the right one.
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
#include "clients/verification/process_order.hpp"
#include "core/machine.hpp"
#include "services/record/reading/positions/motor_zero.hpp"
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
        std::string commanded;               // in the second run
        std::string why_unknown;             // empty if the log has all that could tell a reason
        std::optional<Span> homed_in_place;  // then, if there was a job of homing
    };

    /// `zero` must outlive this object.
    explicit ZeroCheck(const analysis::MotorZero& zero) : zero_(zero) {}

    /// The machine is known from its first job on.
    void set_machine(const MachineConfig& machine) { tick_ns_ = machine.tick_ns; }
    void take(const analysis::RecordedPosition& position);
    /// Two runs of which the second is the next one of the axis. `commanded`: in the second one.
    void take(const analysis::Run& before, const analysis::Run& run, const std::function<std::string()>& commanded);
    /// Call once, at the end of the log. Returns the changes for which it tells no reason. `lacks_jobs`: the log lacks
    /// records of jobs.
    std::vector<Change> finish(const HomingJobs& homings, bool lacks_jobs);

private:
    /// What two positions tell about the zero.
    struct Reason {
        std::optional<analysis::ZeroMove> move;  // nullopt: positions between them are not in the log
        Span span;
    };

    void deliver(std::size_t patience);
    void pass(const analysis::RecordedPosition& position);
    void add(std::optional<analysis::ZeroMove> move, Span span);
    void settle(bool log_ended);
    bool is_told(Change& change) const;

    const analysis::MotorZero& zero_;
    std::optional<std::int64_t> tick_ns_;  // of the machine
    ProcessOrder processes_;
    std::optional<std::int64_t> incarnation_;                     // of the newest process
    std::map<std::int64_t, analysis::RecordedPosition> waiting_;  // its positions, by number
    std::int64_t expected_ = 0;                                   // the number of its next position
    std::optional<analysis::RecordedPosition> last_;
    std::deque<Reason> reasons_;      // in order
    std::optional<Tick> known_from_;  // earlier reasons are forgotten, or before the log
    std::deque<Change> changes_;      // for which later positions are needed
    std::vector<Change> untold_;      // for which the positions tell no reason
};

}  // namespace lockstep::verification
