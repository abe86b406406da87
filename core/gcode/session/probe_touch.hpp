// How a probing move ended, for the reader of the lines behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// A result from the network that is of a machine with another number of axes.
struct ForeignProbeResult {
    std::uint64_t job = 0;
    std::size_t places = 0;
    std::size_t axes = 0;
    std::string text() const;
};

/// `rest_mm`: where each axis of the machine came to rest.
std::expected<ProbeTouch, ForeignProbeResult> touch_from(const ProbeResult& result, std::vector<double> rest_mm);

}  // namespace lockstep
