// Counts messages that a process received and refused, with the last reason.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

struct Refusals {
    std::uint64_t count = 0;
    std::string last;  // the reason for the last refusal

    void add(std::string why) {
        ++count;
        last = std::move(why);
    }
};

}  // namespace lockstep
