// The machine's thread, beside the server's. It has the session, carries out the orders of the server's thread, renews
// jogs and the lease, and publishes the state.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "clients/web/machine/action_queue.hpp"
#include "clients/web/machine/jog_turn.hpp"
#include "clients/web/machine/measuring.hpp"
#include "clients/web/machine/port.hpp"
#include "clients/web/machine/probing_run.hpp"
#include "clients/web/machine/session_lease.hpp"
#include "clients/web/machine/snapshot_taker.hpp"
#include "clients/web/machine/task_queue.hpp"

namespace lockstep::web {

class MachineLoop : public MachinePort {
public:
    static constexpr std::chrono::milliseconds kPublishPeriod{100};
    using Publish = std::function<void(const std::shared_ptr<const Snapshot>& snapshot)>;

    /// Calls `publish` in its thread, ten times a second. `writer`: the name of this server as a writer.
    MachineLoop(Session session, const std::string& writer, Publish publish);
    ~MachineLoop() override;

    void command(const Command& command, Done done) override;
    void jog(const JogOrder& order, Done done) override;
    void run(ReadyProgram&& program, Done done) override;
    void change_values(ValuesTask::Change change, Done done) override;
    void take_lease(Done done) override;
    void give_lease(Done done) override;
    void end_stream(const std::string& name) override;
    std::shared_ptr<const Snapshot> snapshot() const override;

private:
    /// Refuses with `done` if too many actions wait already.
    /// `is_stop`: it has a place even if too many others wait.
    void add(ActionQueue::Action action, const Done& done, bool is_stop = false);
    void work(const std::stop_token& stop);
    void start(std::unique_ptr<Task> task, const Done& done);
    bool is_sending() const;
    /// True while a command, a jog or a job of this server is under way.
    bool has_work() const;
    void run_first(const ReadyProgram& program, const Done& done);
    void run_task(const ReadyProgram& program, const Done& done);
    void run_next_part();
    bool is_own_job() const;

    void show();
    /// Updates the snapshot before `done`, so that a client that reads the state after its answer finds the effect
    /// there.
    Done shown(const Done& done);

    Session session_;
    SessionLease lease_;
    JogTurn jog_;
    Publish publish_;
    TaskQueue tasks_;
    SnapshotTaker snapshots_;
    std::optional<OwnJob> job_;
    std::optional<ProbingRun> probing_;  // of that job, if its program may go on behind a touch
    Measuring measuring_;
    std::chrono::nanoseconds published_{};

    ActionQueue actions_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Snapshot> snapshot_;
    std::jthread thread_;  // the last member: it uses the others
};

}  // namespace lockstep::web
