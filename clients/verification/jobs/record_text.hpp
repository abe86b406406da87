// The places and the names of the records of a job, for messages.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <lockstep/program_event_t.hpp>
#include <string>
#include <string_view>

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

/// An event: "output-on (index 3, value 0)"
inline std::string text_of(std::string_view kind, std::int32_t index, double value) {
    return fmt::format("{} (index {}, value {:f})", kind, index, value);
}
inline std::string text_of(const program_event_t& event) { return text_of(event.kind, event.index, event.value); }

inline std::string place_of(std::int32_t line, std::int64_t block) {
    return fmt::format("line {}, block {}", line, block);
}
inline std::string place_of(const program_event_t& event) { return place_of(event.line, event.block); }

inline std::string number_of(const analysis::RecordedJob& record) { return fmt::format("job {}", record.job); }

}  // namespace lockstep::verification
