// A schedule of the beginnings and ends of faults.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "services/virtual/virtual_fault.hpp"

namespace lockstep {

class FaultSchedule {
public:
    /// The beginning or end of a fault.
    struct Turn {
        VirtualFault fault;
        bool begins = true;
    };

    /// A fault with a beginning in the past begins at once.
    void add(const VirtualFault& fault, Tick now) {
        turns_.emplace(std::max(fault.at, now), Turn{fault, true});
        add_end(std::max(fault.end(), now), fault);
    }
    /// Adds the end of a fault that has begun.
    void add_end(Tick at, const VirtualFault& fault) { turns_.emplace(at, Turn{fault, false}); }
    /// Removes the faults that have not begun.
    void withdraw(Tick now) {
        std::erase_if(turns_, [now](const auto& turn) { return turn.second.fault.at > now; });
    }

    bool empty() const { return turns_.empty(); }
    /// When the next fault begins or ends.
    std::optional<Tick> next() const { return empty() ? std::nullopt : std::optional(turns_.begin()->first); }
    Turn take() { return turns_.extract(turns_.begin()).mapped(); }

private:
    std::multimap<Tick, Turn> turns_;
};

}  // namespace lockstep
