// Compares the positions that an axis reports with its steps. A position is read at some instant of a slot, so it may
// be any that the axis passes within a slot of its time. After a new zero both the old and the new count are allowed
// until the next step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/units.hpp"
#include "services/record/reading/positions/motor_zero.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::verification {

class PositionCheck {
public:
    /// The maximum number of positions that wait for the steps around them; more are not compared.
    static constexpr std::size_t kMaxWaiting = 4096;

    /// `zero` must outlive this object.
    explicit PositionCheck(const analysis::MotorZero& zero) : zero_(zero) {}

    void take(const analysis::RecordedPosition& position);
    /// Steps in order. Returns why a position that waited is wrong; nullopt if all are right. `slot`: how far apart a
    /// position and its time may be.
    std::optional<std::string> take(const analysis::StepBatch& batch, Ticks slot);
    /// Nothing is known across a gap.
    void skip();
    /// Call once, at the end of the log.
    std::optional<std::string> finish();

private:
    struct Range {
        std::int64_t low = 0;
        std::int64_t high = 0;
        void add(std::int64_t count) {
            low = std::min(low, count);
            high = std::max(high, count);
        }
    };
    /// A recent batch, and the steps of it that are too old for the next position.
    struct Recent {
        analysis::StepBatch batch;
        ClockStretch time;
        std::size_t passed = 0;
        std::int64_t count = 0;  // after them

        bool is_passed() const { return passed == batch.steps.size(); }
        /// Passes the steps before a time. Returns false if there is none.
        bool pass_before(Tick tick);
        /// The newest step passed.
        Tick last() const { return time.at(batch.steps[passed - 1].tick); }
    };
    /// The axis stands at `count` from a time on, until the first recent step.
    struct Stand {
        Tick from;
        std::int64_t count = 0;
    };
    void wait(const analysis::RecordedPosition& position);
    void pass_before(Tick tick);
    std::optional<std::string> compare(const analysis::RecordedPosition& position, Ticks reach) const;
    static std::string text(const analysis::RecordedPosition& position, const Range& allowed);

    const analysis::MotorZero& zero_;
    std::deque<analysis::RecordedPosition> waiting_;  // by time
    std::optional<Tick> compared_;                    // the time of the newest one compared
    std::deque<Recent> recent_;
    std::optional<Stand> stand_;   // before the recent steps
    std::optional<Stand> newest_;  // after all steps
    std::optional<analysis::RecordedPosition> last_;
    std::optional<Tick> zero_since_;  // the newest time from which positions count from another zero
};

}  // namespace lockstep::verification
