// Requests to the machine that are not answered yet. Each is polled in the machine's thread and never waits. Deadlines
// count in OwnerWatch::running_time().
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "clients/session/session.hpp"
#include "clients/web/program/program_reading.hpp"
#include "clients/web/request/orders.hpp"

namespace lockstep::web {

class Task {
public:
    /// The lease that a task needs before it begins. Taken: even from another writer.
    enum class Lease : std::uint8_t { NotNeeded, Needed, Taken };

    Task(Lease lease, Done done) : lease_(lease), done_(std::move(done)) {}
    virtual ~Task() = default;
    /// Returns true if the task is over and was answered.
    virtual bool poll(Session& session) = 0;
    /// True if the task uses the session's one sender of programs.
    virtual bool sends() const { return false; }

    Lease lease() const { return lease_; }
    /// Answers the request. Always returns true.
    bool end(Outcome&& outcome);

private:
    Lease lease_;
    Done done_;
};

/// Waits until the machine names this server as its writer, or names it no longer.
class LeaseTask : public Task {
public:
    LeaseTask(bool takes, Done done) : Task(takes ? Lease::Taken : Lease::NotNeeded, std::move(done)), takes_(takes) {}
    bool poll(Session& session) override;

private:
    bool takes_;
    std::optional<std::chrono::nanoseconds> begun_;
};

/// A command, repeated until the coordinator answers.
class CommandTask : public Task {
public:
    CommandTask(const Command& command, Done done);
    bool poll(Session& session) override;

private:
    CommandTracker tracker_;
};

/// Sends a program's beginning, then runs it; the rest is sent while it runs.
class RunTask : public Task {
public:
    using Begun = std::function<void(std::uint64_t job)>;
    RunTask(ReadyProgram&& program, Begun begun, Done done)
        : Task(Lease::Needed, std::move(done)), program_(std::move(program)), begun_(std::move(begun)) {}
    bool poll(Session& session) override;
    bool sends() const override { return true; }

private:
    ReadyProgram program_;
    Begun begun_;
    std::uint64_t id_ = 0;  // 0: nothing is sent yet
    std::unique_ptr<CommandTask> command_;
};

/// Changes the values that outlive programs; answered when the coordinator has them on its disk.
class ValuesTask : public Task {
public:
    using Change = std::function<std::expected<gcode::KeptValues, Problem>(const gcode::KeptValues& values)>;
    ValuesTask(Change change, Done done) : Task(Lease::Needed, std::move(done)), change_(std::move(change)) {}
    bool poll(Session& session) override;
    bool sends() const override { return true; }

private:
    bool begin(Session& session);

    Change change_;
    std::optional<std::chrono::nanoseconds> sent_;
    std::uint64_t revision_ = 0;  // of the change
};

}  // namespace lockstep::web
