#include "clients/text/notes.hpp"

#include <fmt/format.h>

namespace lockstep {

void warn_of(const std::vector<GcodeNote>& notes, Output& output) {
    for (const GcodeNote& note : notes) { output.warn(fmt::format("line {}: {}", note.line, note.text)); }
}

}  // namespace lockstep
