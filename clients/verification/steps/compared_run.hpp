// The run whose steps are being compared, if there is one, and the run before it. The follower gets both and their
// steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "clients/verification/steps/run_follower.hpp"
#include "clients/verification/steps/seen_step.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::Run;
using analysis::StepMaker;

class ComparedRun {
public:
    /// `follower` must outlive this object.
    void set_follower(RunFollower& follower) { follower_ = &follower; }
    bool has_follower() const { return follower_ != nullptr; }

    /// `is_behind_gap`: runs before it are missing.
    void begin(Run run, bool is_behind_gap);
    /// The run agrees with the one before it, so the follower gets it.
    void accept();
    void end();
    /// The end of the log.
    void finish();

    explicit operator bool() const { return maker_.has_value(); }
    /// There must be a run for these.
    StepMaker* operator->() { return &*maker_; }
    const Run& run() const { return maker_->run(); }

    /// The run before it; nullopt if there was none.
    const std::optional<Run>& before() const { return before_; }
    /// The run, otherwise the one before; null if there was none.
    const Run* newest() const { return maker_ ? &maker_->run() : before_ ? &*before_ : nullptr; }

    /// Whether the run was cut at the next of its steps: at its stop count, unless the log goes on with its pieces.
    /// `seen`: the next step in the log; null if there is none.
    bool is_cut_here(const SeenStep* seen);
    void pass_step(bool is_recorded);
    /// Passes the steps that the log lacks, up to the run's end or cut. Returns how many.
    std::int64_t pass_unrecorded();

private:
    RunFollower* follower_ = nullptr;
    std::optional<StepMaker> maker_;
    std::optional<Run> before_;
};

}  // namespace lockstep::verification
