#include "services/wire/bus/bus.hpp"

namespace lockstep {

void Arrivals::notify() {
    {
        const std::lock_guard lock(mutex_);
        arrived_ = true;
    }
    condition_.notify_one();
}

bool Arrivals::wait_for(std::chrono::nanoseconds time) {
    std::unique_lock lock(mutex_);
    const bool arrived = condition_.wait_for(lock, time, [this] { return arrived_; });
    arrived_ = false;
    return arrived;
}

}  // namespace lockstep
