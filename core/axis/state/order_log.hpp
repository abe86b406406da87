// The owner's orders to this axis: the newest one taken, and how it ended.
#pragma once

#include <cstdint>

#include "core/faults.hpp"

namespace lockstep {

/// Orders are numbered upwards within an owner's term and repeated until they are done. One is open at a time.
class OrderLog {
public:
    bool is_new(std::uint64_t sequence) const { return sequence > taken_; }
    void begin(std::uint64_t sequence) {
        taken_ = sequence;
        fault_ = FaultCode::None;
        is_open_ = true;
    }
    /// The open order is done or was refused. Changes nothing if no order is open.
    void end(FaultCode fault) {
        if (!is_open_) { return; }
        is_open_ = false;
        done_ = taken_;
        fault_ = fault;
    }
    /// A new owner numbers its orders from the beginning. The orders of the last owner are void.
    void restart() { *this = {}; }

    /// The newest order taken.
    std::uint64_t taken() const { return taken_; }
    /// The newest order that has ended.
    std::uint64_t done() const { return done_; }
    /// Why the newest order was refused or failed; None if it was not.
    FaultCode fault() const { return fault_; }

private:
    std::uint64_t taken_ = 0;
    std::uint64_t done_ = 0;
    FaultCode fault_ = FaultCode::None;
    bool is_open_ = false;
};

}  // namespace lockstep
