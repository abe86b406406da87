// Delivers one axis's runs in the order of their numbers, from records that may come late, twice or never.
//
// A log may begin later than its first process. Then that process's first run in the log counts as the first. Earlier
// runs are missing only if a preceding mark of that process shows that it had recorded fewer.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "services/record/reading/content_memory.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::Run;

class RunStream {
public:
    /// How many records wait for a missing one before it is given up: datagrams may overtake each other.
    static constexpr std::size_t kPatience = 16;
    /// If the first record in the log has a number up to this, records of lower numbers may still follow.
    static constexpr std::int64_t kShuffled = 8;

    /// Records with the numbers [from, end) are missing.
    using OnMissing = std::function<void(std::int64_t from, std::int64_t end)>;
    using OnRun = std::function<void(Run)>;
    /// An earlier record has the number of this one, but other content.
    using OnOther = std::function<void(const Run&)>;

    RunStream(OnRun on_run, OnMissing on_missing, OnOther on_other)
        : on_run_(std::move(on_run)), on_missing_(std::move(on_missing)), on_other_(std::move(on_other)) {}

    void take(Run run);
    /// True if no run was received yet.
    bool is_empty() const { return !incarnation_; }
    /// Requires all runs of that process from this number on to be in the log.
    void expect_from(std::int64_t incarnation, std::int64_t number);
    /// Delivers the waiting runs. Call once, at the end of the log.
    void finish() { deliver(0); }

private:
    void deliver(std::size_t patience);
    bool is_repeat(const Run& run);

    OnRun on_run_;
    OnMissing on_missing_;
    OnOther on_other_;
    analysis::ContentMemory contents_;
    std::optional<std::int64_t> incarnation_;
    std::int64_t expected_ = 0;
    bool accepts_any_ = false;                     // the first run may have any number
    std::map<std::int64_t, std::int64_t> marked_;  // by process: the expected number, before its first run
    std::map<std::int64_t, Run> waiting_;
};

}  // namespace lockstep::verification
