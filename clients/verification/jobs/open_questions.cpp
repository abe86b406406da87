#include "clients/verification/jobs/open_questions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep::verification {

void OpenQuestions::answer(std::optional<Difference>& question, bool is_explained) {
    if (!question) { return; }
    is_explained ? findings_.add_missing(question->text) : findings_.differ(std::move(*question));
    question.reset();
}

void OpenQuestions::ask_plan(Difference difference, const Run& run) {
    plan_ = std::move(difference);
    plan_at_ = {run.epoch, run.frame};
}

void OpenQuestions::ask_silence(const std::string& axis, Epoch epoch, Difference difference) {
    silent_.emplace_back(axis, epoch);
    if (silent_.size() > kEpochsKept) { silent_.pop_front(); }
    silences_.try_emplace(axis, incarnations_[axis], std::move(difference));
}

void OpenQuestions::ask_motion(Difference difference) {
    if (!motion_) { motion_ = std::move(difference); }
}

void OpenQuestions::ask_epoch(Difference difference) {
    if (!epoch_) { epoch_ = std::move(difference); }
}

/// Overrides are recorded before the frames with them run. One that comes after such a frame is late, and explains it.
void OpenQuestions::take(const RecordedJob& record, bool is_behind_gap) {
    const bool is_late = record.event == "override" && static_cast<Epoch>(record.epoch) == plan_at_.first &&
                         static_cast<FrameNumber>(record.behind_frame) < plan_at_.second;
    answer(plan_, is_behind_gap || is_late);
}

void OpenQuestions::take(const std::string& axis, const Run& run, bool is_behind_gap) {
    incarnations_[axis] = run.incarnation;
    auto found = silences_.extract(axis);
    if (!found) { return; }
    Silence& silence = found.mapped();
    if (!is_behind_gap && is_silent_in(axis, run.epoch)) {
        return findings_.add_unknown(
            fmt::format("{}: its runs from {} of epoch {} on come too late in this log to be compared with their "
                        "plan; lockstep log merge sorts them",
                        findings_.label_of(axis), name_of(run), run.epoch));
    }
    const bool is_known = !is_behind_gap && silence.incarnation == run.incarnation;
    is_known ? findings_.differ(std::move(silence.difference)) : findings_.add_missing(silence.difference.text);
}

bool OpenQuestions::is_silent_in(const std::string& axis, Epoch epoch) const {
    return std::ranges::find(silent_, std::pair{axis, epoch}) != silent_.end();
}

void OpenQuestions::finish(const LogEnd& end) {
    answer(plan_, end.lacks_records);
    answer(epoch_, end.lacks_records);
    answer(motion_, end.lacks_any_run);
    for (auto& [axis, silence] : silences_) {
        const bool is_known = end.at_rest && !end.has_ended(axis) && !end.lacks_runs(axis);
        is_known ? findings_.differ(silence.difference) : findings_.add_missing(silence.difference.text);
    }
    silences_.clear();
}

}  // namespace lockstep::verification
