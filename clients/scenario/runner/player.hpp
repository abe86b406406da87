// Plays a scenario's steps on a machine that is up: begins what is asked, lets befall it what is to befall it, and
// waits for its end. What it sees is judged later.
#pragma once

#include <functional>

#include "clients/scenario/model/course.hpp"
#include "clients/scenario/model/facts.hpp"
#include "clients/scenario/runner/acts.hpp"
#include "clients/session/job_verdict.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {

class Player {
public:
    Player(const Scenario& scenario, Session& session, Cast& cast, Acts& acts);

    /// Waits until the machine is in this phase and hears all axes whose processes act. False: it is not, in the time.
    bool wait_for(Asked::Phase phase);
    /// From the first step to the last, or to one that cannot be played.
    void play();
    const Seen& seen() const { return seen_; }

private:
    struct Watched {
        std::uint64_t job = 0;
        Term asked;    // whose coordinator began it
        Term runs_it;  // whose was last heard to run it
    };
    struct Ended {
        Asked::Step::Ending ending;
        std::string fault;  // by name; empty: none
    };

    void play_step(const Asked::Step& step);
    void play_job(const Asked::Step& step);
    void play_wait(const Asked::Step& step);
    void check_found(const Asked::Step& step);
    std::expected<Reply, std::string> begin(const Asked::Step& step);
    std::expected<std::uint64_t, std::string> send(const Asked::Step& step);
    std::expected<Program, std::string> program_of_step(const Asked::Step& step, const std::vector<double>& start_mm);
    std::optional<Ended> watch(Watched watched, Course& course);
    std::optional<Ended> ended(Watched& watched);
    void befall(Course& course, std::chrono::nanoseconds begun);
    void undo_due();
    void glance();
    void check_ending(const Asked::Step& step, const Ended& found);
    void check_left(const Asked::Step& step, const Course& course, const std::string& because);
    void settle();

    Moment moment(std::chrono::nanoseconds begun) const;
    bool hears_all(std::chrono::nanoseconds since);
    bool all_heard_rest() const;
    std::string title(const Asked::Step& step) const;
    double at_s(Tick tick) const;
    void tell(const std::string& what) { tell(what, clock_.now()); }
    void tell(const std::string& what, Tick at);
    void add_check(const std::string& asked, const std::string& found, bool held);

    const Scenario& scenario_;
    Session& session_;
    Cast& cast_;
    Acts& acts_;
    MachineClock clock_;
    Tick start_;
    int step_ = 0;  // counted from 1
    Seen seen_;
};

}  // namespace lockstep::scenario
