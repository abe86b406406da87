// A hash of everything that the axes and coordinators of a run publish and order: states, frames, orders, replies,
// jobs, events, notices and tracks. Left out are counts of the process itself, and the times at which it was started.
#pragma once

#include <cstdint>

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::simtest {

class PublicationHash : public VirtualObserver {
public:
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;

    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace lockstep::simtest
