// The place and the name of a record of a job, for messages.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "core/path_place.hpp"
#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

/// Where the epoch of a record begins.
inline PathPlace place_in(const analysis::RecordedJob& record) {
    const Int128 along = Int128{record.resume_high} * kOneStep + Int128{static_cast<std::uint64_t>(record.resume_low)};
    return {static_cast<std::uint32_t>(record.resume_block), {along}};
}

inline std::string text_of(const PathPlace& place) {
    return fmt::format("block {}, {:f} mm along it", place.block, place.along.as_steps());
}

inline std::string number_of(const analysis::RecordedJob& record) { return fmt::format("job {}", record.job); }

}  // namespace lockstep::verification
