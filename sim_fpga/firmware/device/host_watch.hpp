// Whether the host still beats. A device whose host is silent brings its outputs to a safe state by itself.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/due.hpp"

namespace lockstep::firmware {

class HostWatch {
public:
    /// patience: in ticks. 0: the host is never silent.
    void begin(std::int64_t patience, std::int64_t now) {
        patience_ = patience;
        heard_ = now;
        is_silent_ = false;
    }
    /// Takes the present beat.
    void look(std::uint64_t beat, std::int64_t now) {
        if (beat == beat_) { return; }
        beat_ = beat;
        heard_ = now;
        is_silent_ = false;
    }
    /// The tick at which the host falls silent, unless it beats.
    Due next() const { return patience_ == 0 || is_silent_ ? Due{} : Due::at(heard_ + patience_); }
    /// Returns true when the host falls silent.
    bool falls_silent(std::int64_t now) {
        if (!next().is_past(now)) { return false; }
        is_silent_ = true;
        return true;
    }
    bool is_silent() const { return is_silent_; }

private:
    std::int64_t patience_ = 0;
    std::int64_t heard_ = 0;
    std::uint64_t beat_ = 0;
    bool is_silent_ = false;
};

}  // namespace lockstep::firmware
