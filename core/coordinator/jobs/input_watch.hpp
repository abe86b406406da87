// The wait of a program for an input, from the rest at its place on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/pause.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class InputWatch {
public:
    enum class Result : std::uint8_t { Waits, IsMet, TimedOut };

    /// Only states stamped in slot `since` or later count. The wait times out at `until`.
    InputWatch(InputMode mode, Slot since, Tick until) : mode_(mode), since_(since), until_(until) {}

    Slot since() const { return since_; }
    /// How long until it times out.
    Ticks left(Tick now) const { return std::max(until_ - now, Ticks{}); }
    /// Call it once a slot. `is_closed`: the input's newest level; nullopt: none is known yet.
    Result look(std::optional<bool> is_closed, Tick now) {
        const std::optional<bool> before = was_closed_;
        if (is_closed) { was_closed_ = is_closed; }
        if (is_closed && meets(*is_closed, before.value_or(*is_closed))) { return Result::IsMet; }
        return now < until_ ? Result::Waits : Result::TimedOut;
    }

private:
    bool meets(bool is_closed, bool was_closed) const {
        switch (mode_) {
            case InputMode::Closes: return is_closed && !was_closed;
            case InputMode::Opens: return !is_closed && was_closed;
            case InputMode::IsClosed: return is_closed;
            case InputMode::IsOpen: break;
        }
        return !is_closed;
    }

    InputMode mode_;
    Slot since_;
    Tick until_;
    std::optional<bool> was_closed_;  // at the last look
};

}  // namespace lockstep
