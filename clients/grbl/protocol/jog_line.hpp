// Converts a jog line of grbl, $J=..., to axes, speeds and distances.
#pragma once

#include <expected>
#include <string_view>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "clients/grbl/protocol/machine_view.hpp"
#include "core/machine.hpp"

namespace lockstep::grbl {

/// The sender's modes. Words of the line take precedence over them.
struct JogModes {
    bool inches = false;
    bool relative = false;
    std::vector<double> offset_mm;  // offset of the work's zero, by axis
};

/// `text`: the part after "$J=". The axes move at the feed along the line, or slower if an axis's maximum velocity
/// requires it. They arrive together, except for differences of their ramps. Empty if they are already there.
std::expected<std::vector<JogAxis>, Refused> read_jog(std::string_view text, const MachineConfig& machine,
                                                      const std::vector<AxisPlace>& places, const JogModes& modes);

}  // namespace lockstep::grbl
