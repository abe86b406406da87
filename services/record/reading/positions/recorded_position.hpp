// A position that an axis has published.
#pragma once

#include <cstdint>
#include <lockstep/axis_position_t.hpp>
#include <optional>

#include "core/units.hpp"

namespace lockstep::analysis {

struct RecordedPosition {
    Tick tick;  // machine time
    std::int64_t steps = 0;
    double mm = 0;
    double velocity_mm_per_s = 0;
    std::int64_t incarnation = 0;  // of the axis's process
    std::int64_t sequence = 0;     // each process numbers its positions without gaps
    bool is_homed = false;
    bool has_fault = false;
    std::int64_t following_error = 0;  // encoder minus count, in steps

    bool is_at_rest() const { return velocity_mm_per_s == 0; }
    /// No position is between them.
    bool is_next_after(const RecordedPosition& before) const {
        return incarnation == before.incarnation && sequence == before.sequence + 1;
    }
};

/// Returns nullopt if a number in the message is impossible.
std::optional<RecordedPosition> to_position(const axis_position_t& message);

}  // namespace lockstep::analysis
