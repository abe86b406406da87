// The device as the axis saw it last, and the runs that the axis has ordered.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/axis/device/device.hpp"

namespace lockstep {

class DeviceView {
public:
    bool is_present() const { return is_present_; }
    const DeviceStatus& status() const { return status_; }

    /// Call it in each loop in which the device answers. Returns true if it did not answer in the loop before.
    bool appear() { return !std::exchange(is_present_, true); }

    /// `is_resting`: this axis runs nothing. Another process may then have ordered a newer run.
    void see(const DeviceStatus& status, bool is_resting) {
        status_ = status;
        free_segments_ = status.free_segments;
        if (is_resting) { newest_run_ = std::max({newest_run_, status.run, status.run_asked}); }
    }

    /// From now on the device is assumed to make no pulses.
    void lose() {
        is_present_ = false;
        status_.moving = false;
        status_.velocity = {};
    }

    /// Returns the number of a new run.
    std::uint64_t begin_run() { return ++newest_run_; }
    std::uint64_t newest_run() const { return newest_run_; }
    bool is_in_newest_run() const { return status_.run == newest_run_; }
    /// The newest run has ended, and no other is asked for.
    bool has_ended() const { return status_.finished && is_in_newest_run() && status_.run_asked == newest_run_; }

    /// Room in the segment ring that is not reserved.
    std::size_t free_segments() const { return free_segments_; }
    /// Reserves room in the segment ring until the next look. Returns false if there is not enough.
    bool reserve(std::size_t segments) {
        if (segments > free_segments_) { return false; }
        free_segments_ -= segments;
        return true;
    }

private:
    bool is_present_ = false;
    DeviceStatus status_;
    std::uint64_t newest_run_ = 0;
    std::size_t free_segments_ = 0;
};

}  // namespace lockstep
