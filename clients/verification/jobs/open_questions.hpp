// Differences that missing messages may explain. A later message, or the end of the log, shows whether any are missing:
// then the result is unknown, otherwise the log contradicts itself.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "clients/verification/findings.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

using analysis::RecordedJob;
using analysis::Run;

/// The parts of a record that the log may lack at its end.
struct LogEnd {
    bool at_rest = false;        // it continues long enough after the last motion on record
    bool lacks_records = false;  // by the marks, records of jobs after the last one are missing
    bool lacks_any_run = false;  // by the marks, runs of any axis after its last one are missing
    /// Whether an axis's process had ended, and whether by the marks runs of the axis after its last are missing.
    std::function<bool(const std::string& axis)> has_ended;
    std::function<bool(const std::string& axis)> lacks_runs;
};

class OpenQuestions {
public:
    explicit OpenQuestions(Findings& findings) : findings_(findings) {}

    /// A run differs from its plan. A record of its job before it may be missing.
    void ask_plan(Difference difference, const Run& run);
    /// An axis has nothing in the log after a frame of an epoch in which others ran on. Its runs may be missing.
    void ask_silence(const std::string& axis, Epoch epoch, Difference difference);
    /// A job is done, but the log has no run of its last motion.
    void ask_motion(Difference difference);
    /// A run has no record of its epoch.
    void ask_epoch(Difference difference);

    /// A record of a job. `is_behind_gap`: records before it are missing.
    void take(const RecordedJob& record, bool is_behind_gap);
    /// A run of an axis. `is_behind_gap`: runs before it are missing.
    void take(const std::string& axis, const Run& run, bool is_behind_gap);
    /// Whether the axis was taken for complete in an epoch, so that its further runs there are not compared.
    bool is_silent_in(const std::string& axis, Epoch epoch) const;
    /// Call once, at the end of the log.
    void finish(const LogEnd& end);

private:
    static constexpr std::size_t kEpochsKept = 256;

    struct Silence {
        std::int64_t incarnation = 0;
        Difference difference;
    };
    void answer(std::optional<Difference>& question, bool is_explained);

    Findings& findings_;
    std::optional<Difference> plan_;
    std::pair<Epoch, FrameNumber> plan_at_{0, 0};
    std::optional<Difference> motion_;
    std::optional<Difference> epoch_;
    std::map<std::string, Silence> silences_;           // by axis
    std::deque<std::pair<std::string, Epoch>> silent_;  // the newest axes and epochs
    std::map<std::string, std::int64_t> incarnations_;  // of each axis's newest run
};

}  // namespace lockstep::verification
