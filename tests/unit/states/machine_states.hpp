// The states that a machine can be in, each as the way into it.
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

/// For tests that have one as their parameter.
std::string situation_name(const testing::TestParamInfo<MachineSituation>& info);

}  // namespace lockstep
