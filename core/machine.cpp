#include "core/machine.hpp"

namespace lockstep {

std::vector<std::string> MachineConfig::axis_names() const {
    std::vector<std::string> names;
    for (const AxisConfig& axis : axes) { names.push_back(axis.name); }
    return names;
}

}  // namespace lockstep
