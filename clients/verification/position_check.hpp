// Compares the positions that an axis reports with its steps. A position is read at some instant of a slot, so it may
// be any that the axis passes within a slot of its time. After a new zero both the old and the new count are allowed
// until the next step.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "clients/analysis/log/step_stream.hpp"
#include "core/units.hpp"

namespace lockstep::verification {

struct SeenPosition {
    Tick tick;  // machine time
    std::int64_t steps = 0;
    std::int64_t incarnation = 0;
    bool is_homed = false;
};

class PositionCheck {
public:
    /// The maximum number of positions that wait for the steps around them; more are not compared.
    static constexpr std::size_t kMaxWaiting = 4096;

    explicit PositionCheck(std::string axis) : axis_(std::move(axis)) {}

    void take(const SeenPosition& position);
    /// Steps in order. Returns why a position that waited is wrong; nullopt if all are right. `slot`: how far apart a
    /// position and its time may be.
    std::optional<std::string> take(const analysis::StepBatch& batch, Ticks slot);
    /// Nothing is known across a gap.
    void skip() { stretch_.reset(); }
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
    /// After the newest step.
    struct Stretch {
        Tick from;
        std::int64_t count = 0;
    };
    std::optional<std::string> compare(const SeenPosition& position, const Range& allowed) const;

    std::string axis_;
    std::deque<SeenPosition> waiting_;
    std::optional<Stretch> stretch_;
    std::optional<SeenPosition> newest_;
    std::optional<Tick> anew_;  // the newest time from which positions count from another zero
};

}  // namespace lockstep::verification
