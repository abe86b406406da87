// What was asked of the machine and is not answered yet. Each is polled in the machine's thread and never waits.
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
    virtual ~Task() = default;
    /// True: it is over and was answered.
    virtual bool poll(Session& session, std::chrono::nanoseconds now) = 0;
    /// It uses the session's one sender of programs.
    virtual bool sends() const { return false; }
};

/// A command, repeated until the coordinator answers.
class CommandTask : public Task {
public:
    CommandTask(const Command& command, Done done) : command_(command), done_(std::move(done)) {}
    bool poll(Session& session, std::chrono::nanoseconds now) override;

private:
    Command command_;
    Done done_;
    std::optional<std::chrono::nanoseconds> begun_;
    std::chrono::nanoseconds repeated_{};
};

/// Sends a program's beginning, then runs it; the rest is sent while it runs.
class RunTask : public Task {
public:
    using Begun = std::function<void(std::uint64_t job)>;
    RunTask(ReadyProgram&& program, Begun begun, Done done)
        : program_(std::move(program)), begun_(std::move(begun)), done_(std::move(done)) {}
    bool poll(Session& session, std::chrono::nanoseconds now) override;
    bool sends() const override { return true; }

private:
    ReadyProgram program_;
    Begun begun_;
    Done done_;
    std::optional<std::chrono::nanoseconds> sent_;
    std::uint64_t id_ = 0;
    std::unique_ptr<CommandTask> command_;
};

/// Changes the values that outlive programs; answered when the coordinator has them on its disk.
class ValuesTask : public Task {
public:
    using Change = std::function<std::expected<gcode::KeptValues, Problem>(const gcode::KeptValues& values)>;
    ValuesTask(Change change, Done done) : change_(std::move(change)), done_(std::move(done)) {}
    bool poll(Session& session, std::chrono::nanoseconds now) override;
    bool sends() const override { return true; }

private:
    bool begin(Session& session, std::chrono::nanoseconds now);
    bool end(Outcome&& outcome);

    Change change_;
    Done done_;
    std::optional<std::chrono::nanoseconds> sent_;
    std::uint64_t revision_ = 0;  // of the change
};

}  // namespace lockstep::web
