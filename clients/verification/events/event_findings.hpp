// The findings about the events of the job in progress: a difference says in which job, line and epoch.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "clients/verification/findings.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::verification {

struct EventFindings {
    Findings& all;
    std::string job;  // its label
    Epoch epoch = 0;  // the newest

    /// Always returns false. `line`: 0 if there is none.
    bool differ(const std::string& text, std::int32_t line, std::optional<Tick> expected = {},
                std::optional<Tick> seen = {}) {
        std::string commanded = job;
        if (line != 0) { commanded += fmt::format(", line {}", line); }
        if (epoch != 0) { commanded += fmt::format(", epoch {}", epoch); }
        all.differ({.text = text,
                    .axis = {},
                    .tick_expected = expected,
                    .tick_seen = seen,
                    .commanded = std::move(commanded)});
        return false;
    }
};

}  // namespace lockstep::verification
