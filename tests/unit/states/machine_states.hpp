// The states of a machine, each with the way into it.
#pragma once

#include <vector>

#include "tests/unit/states/walker.hpp"

namespace lockstep {

struct MachineSituation {
    std::string name;
    void (*enter)(Walker&);
    VirtualOptions (*options)();
};

const std::vector<MachineSituation>& situations();

/// The name of the parameter, for tests with a state as their parameter.
std::string situation_name(const testing::TestParamInfo<MachineSituation>& info);

}  // namespace lockstep
