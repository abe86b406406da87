// Delivers one axis's runs in the order of their numbers, from records that may come late, twice or never.
//
// A log may begin later than its first process. Then that process's first run in the log counts as the first. Earlier
// runs are missing only if a preceding mark of that process shows that it had recorded fewer.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "clients/analysis/log/run.hpp"

namespace lockstep::verification {

using analysis::Run;

class RunStream {
public:
    /// How many records wait for a missing one before it is given up: datagrams may overtake each other.
    static constexpr std::size_t kPatience = 4;

    /// Records with the numbers [from, end) are missing.
    using OnMissing = std::function<void(std::int64_t from, std::int64_t end)>;
    using OnRun = std::function<void(Run)>;

    RunStream(OnRun on_run, OnMissing on_missing) : on_run_(std::move(on_run)), on_missing_(std::move(on_missing)) {}

    void take(Run run);
    /// True if no run was received yet.
    bool is_empty() const { return !incarnation_; }
    /// Requires all runs of that process from this number on to be in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number);
    /// Delivers the waiting runs. Call once, at the end of the log.
    void finish() { deliver(0); }

private:
    void deliver(std::size_t patience);

    OnRun on_run_;
    OnMissing on_missing_;
    std::optional<std::int64_t> incarnation_;
    std::optional<std::int64_t> expected_;         // nullopt: accepts the first one
    std::map<std::int64_t, std::int64_t> marked_;  // by process: the expected number, before its first run
    std::map<std::int64_t, Run> waiting_;
};

}  // namespace lockstep::verification
