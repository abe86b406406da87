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
    struct Edge {
        VirtualFault fault;
        bool begins = true;
    };

    /// A fault with a beginning in the past begins at once.
    void add(const VirtualFault& fault, Tick now) {
        edges_.emplace(std::max(fault.at, now), Edge{fault, true});
        add_end(std::max(fault.end(), now), fault);
    }
    /// Adds the end of a fault that has begun.
    void add_end(Tick at, const VirtualFault& fault) { edges_.emplace(at, Edge{fault, false}); }
    /// Removes the faults that have not begun.
    void withdraw(Tick now) {
        std::erase_if(edges_, [now](const auto& edge) { return edge.second.fault.at > now; });
    }

    bool empty() const { return edges_.empty(); }
    /// When the next fault begins or ends.
    std::optional<Tick> next() const { return empty() ? std::nullopt : std::optional(edges_.begin()->first); }
    Edge take() { return edges_.extract(edges_.begin()).mapped(); }

private:
    std::multimap<Tick, Edge> edges_;
};

}  // namespace lockstep
