// One axis's runs in the order of their numbers, from records that may come late, twice or never.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "clients/analysis/run.hpp"

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
    /// Tells what still waits. Call once, at the end of the log.
    void finish() { tell(0); }

private:
    void tell(std::size_t patience);

    OnRun on_run_;
    OnMissing on_missing_;
    std::optional<std::int64_t> incarnation_;
    std::int64_t expected_ = 0;
    std::map<std::int64_t, Run> waiting_;
};

}  // namespace lockstep::verification
