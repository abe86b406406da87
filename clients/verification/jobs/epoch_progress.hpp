// The epoch in progress: its runs and its events, and what its end leaves to the job.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clients/verification/events/event_check.hpp"
#include "clients/verification/findings.hpp"
#include "clients/verification/jobs/checked_job.hpp"
#include "clients/verification/jobs/epoch_check.hpp"
#include "clients/verification/jobs/newest_epochs.hpp"
#include "clients/verification/jobs/open_questions.hpp"
#include "clients/verification/jobs/planned_courses.hpp"
#include "clients/verification/jobs/planned_outputs.hpp"

namespace lockstep::verification {

class EpochProgress {
public:
    EpochProgress(Findings& findings, EventCheck& events, OpenQuestions& questions, NewestEpochs& epochs,
                  PlannedOutputs::OnOutputs on_outputs)
        : findings_(findings),
          events_(events),
          questions_(questions),
          epochs_(epochs),
          outputs_(std::move(on_outputs)) {}

    explicit operator bool() const { return epoch_.has_value(); }
    bool is(Epoch epoch) const { return epoch_ && epoch_->epoch() == epoch; }
    /// There must be an epoch for these.
    EpochCheck* operator->() { return &*epoch_; }
    const EpochCheck* operator->() const { return &*epoch_; }

    void begin(CheckedJob& job, EpochStart start, const RecordedJob& record);
    /// A run that is as planned. `commanded`: its job and its frame.
    void take_equal(const AxisRun& of, MotorIndex motor, const std::function<std::string()>& commanded);
    /// The further runs are not compared with the plan.
    void lose();
    /// Compares the epoch's end, and takes the state of the job after it. `goes_on`: the job does. `lacks_events`: the
    /// last events may not have been published.
    void close(CheckedJob& job, bool goes_on, bool lacks_events);

    /// The runs that the plan allows an axis after its newest run, from a step at that tick on. Empty if there are
    /// none.
    std::vector<Course> planned(const std::string& motor, Tick tick);

private:
    bool suspect(const Shortfall& shortfall, const std::string& job);
    void take_end(CheckedJob& job, bool lacks_events);
    void note_pulses();

    Findings& findings_;
    EventCheck& events_;
    OpenQuestions& questions_;
    NewestEpochs& epochs_;
    std::optional<EpochCheck> epoch_;
    PlannedOutputs outputs_;
    PlannedCourses courses_;
};

}  // namespace lockstep::verification
