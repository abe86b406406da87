// Executes the steps of a scenario on a machine that is up: begins each, injects the scripted events, waits for its end
// and notes what it observes for the evaluation.
#pragma once

#include "clients/scenario/model/event_schedule.hpp"
#include "clients/scenario/model/facts.hpp"
#include "clients/scenario/runner/act_executor.hpp"
#include "clients/scenario/runner/run_notes.hpp"
#include "clients/session/job_result.hpp"

namespace lockstep::scenario {

class ScenarioExecutor {
public:
    ScenarioExecutor(const Scenario& scenario, Session& session, ProcessSet& processes, ActExecutor& acts);

    /// Waits until the machine is in this phase and states of all axes with active processes are received. Returns
    /// false if that takes too long.
    bool wait_for(Asked::Phase phase);
    /// Executes the steps in order. Ends early at a step that cannot be executed.
    void execute();
    const Observations& observations() const { return notes_.observed(); }

private:
    struct WatchedJob {
        std::uint64_t job = 0;
        Term asked;    // of the coordinator that began it
        Term runs_it;  // of the last coordinator that was received as running it
    };
    struct Ended {
        Asked::Step::Ending ending;
        std::string fault;  // its name; empty if none
    };

    void execute_step(const Asked::Step& step);
    void execute_job(const Asked::Step& step);
    void execute_wait(const Asked::Step& step);
    void check_found(const Asked::Step& step);
    std::expected<Ended, std::string> run_to_end(const Asked::Step& step, EventSchedule& schedule);
    std::optional<Ended> watch(WatchedJob watched, std::chrono::nanoseconds begun, EventSchedule& schedule);
    std::optional<Ended> ended(WatchedJob& watched);
    void inject_due(EventSchedule& schedule, std::chrono::nanoseconds begun);
    void undo_due();
    void poll_session();
    void check_ending(const Asked::Step& step, const Ended& found);
    void check_left(const Asked::Step& step, const EventSchedule& schedule, const std::string& because);
    void settle();
    std::string title(const Asked::Step& step) const;

    const Scenario& scenario_;
    Session& session_;
    ProcessSet& processes_;
    ActExecutor& acts_;
    RunNotes notes_;
    int step_ = 0;  // counted from 1
};

}  // namespace lockstep::scenario
