// One axis's runs in the order of their numbers, from records that may come late, twice or never.
//
// Of the first process a log may begin later than the process: then the first run there is the first. It is a later one
// that is missing where a mark of that process came before and says that it had recorded fewer.
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
    /// How many records wait for one that is missing before it is given up: datagrams may overtake each other.
    static constexpr std::size_t kPatience = 4;

    /// Records with the numbers [from, end) are missing.
    using OnMissing = std::function<void(std::int64_t from, std::int64_t end)>;
    using OnRun = std::function<void(Run)>;

    RunStream(OnRun on_run, OnMissing on_missing) : on_run_(std::move(on_run)), on_missing_(std::move(on_missing)) {}

    void take(Run run);
    /// No run has come yet.
    bool is_empty() const { return !incarnation_; }
    /// From now on all runs of that process from this number on are in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number);
    /// Tells what still waits. Call once, at the end of the log.
    void finish() { tell(0); }

private:
    void tell(std::size_t patience);

    OnRun on_run_;
    OnMissing on_missing_;
    std::optional<std::int64_t> incarnation_;
    std::optional<std::int64_t> expected_;         // none: the first that comes
    std::map<std::int64_t, std::int64_t> marked_;  // what is expected of processes, before their first run
    std::map<std::int64_t, Run> waiting_;
};

}  // namespace lockstep::verification
