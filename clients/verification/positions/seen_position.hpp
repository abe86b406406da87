// A position that an axis has published.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace lockstep::verification {

struct SeenPosition {
    Tick tick;  // machine time
    std::int64_t steps = 0;
    std::int64_t incarnation = 0;
    std::int64_t sequence = 0;
    bool is_homed = false;
    bool has_fault = false;
    std::int64_t following_error = 0;  // encoder minus count, in steps
};

}  // namespace lockstep::verification
