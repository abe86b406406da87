// The parameters that programs can read but not write: of the tool, the axes' place, the modes and the last call.
#pragma once

#include "core/gcode/flow/call_stack.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

class SystemParameters : public SystemValues {
public:
    /// All must outlive this.
    SystemParameters(const State& state, const CallStack& stack, const Line& line)
        : state_(state), stack_(stack), line_(line) {}

    std::optional<double> numbered(int number) const override;
    std::optional<double> named(std::string_view name) const override;

private:
    const State& state_;
    const CallStack& stack_;
    const Line& line_;
};

}  // namespace lockstep::gcode
