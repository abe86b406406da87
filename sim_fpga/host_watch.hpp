// Whether the host still beats. A device whose host is silent brings its outputs to a safe state by itself.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/units.hpp"

namespace lockstep {

class HostWatch {
public:
    /// patience: 0: the host is never silent.
    void begin(Ticks patience, Tick now) {
        patience_ = patience;
        heard_ = now;
        is_silent_ = false;
    }
    /// Takes the present beat.
    void look(std::uint64_t beat, Tick now) {
        if (std::exchange(beat_, beat) == beat) { return; }
        heard_ = now;
        is_silent_ = false;
    }
    /// The tick at which the host falls silent, unless it beats.
    std::optional<Tick> next() const {
        return patience_ == Ticks{} || is_silent_ ? std::nullopt : std::optional(heard_ + patience_);
    }
    /// Returns true when the host falls silent.
    bool falls_silent(Tick now) {
        const auto due = next();
        if (!due || *due > now) { return false; }
        is_silent_ = true;
        return true;
    }
    bool is_silent() const { return is_silent_; }

private:
    Ticks patience_;
    std::uint64_t beat_ = 0;
    Tick heard_;
    bool is_silent_ = false;
};

}  // namespace lockstep
