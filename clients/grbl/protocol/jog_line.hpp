// $J=...: a jog as grbl writes it, in axes, speeds and distances.
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
    std::vector<double> offset_mm;  // of the work's zero, by axis
};

/// `text`: behind "$J=". The axes go as fast as the feed asks along the line, as long as each may, and arrive together
/// but for their ramps. Empty: they stand there already.
std::expected<std::vector<JogAxis>, Refused> read_jog(std::string_view text, const MachineConfig& machine,
                                                      const std::vector<AxisPlace>& places, const JogModes& modes);

}  // namespace lockstep::grbl
