// A tick at which something is due, if anything is.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

struct Due {
    bool is_set = false;
    std::int64_t tick = 0;  // if it is set

    static constexpr Due at(std::int64_t tick) { return {true, tick}; }
    constexpr bool is_past(std::int64_t now) const { return is_set && tick <= now; }
};

constexpr Due earlier(Due one, Due other) {
    if (!one.is_set || !other.is_set) { return one.is_set ? one : other; }
    return one.tick < other.tick ? one : other;
}

}  // namespace lockstep::firmware
