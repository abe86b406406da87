// The machine as the server's thread sees it. No call waits; each `done` is called once, from any thread.
#pragma once

#include <memory>
#include <string>

#include "clients/web/machine/task.hpp"
#include "clients/web/program/program_reading.hpp"
#include "clients/web/request/orders.hpp"
#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

class MachinePort {
public:
    virtual ~MachinePort() = default;
    virtual void command(const Command& command, Done done) = 0;
    virtual void jog(const JogOrder& order, Done done) = 0;
    virtual void run(ReadyProgram&& program, Done done) = 0;
    virtual void change_values(ValuesTask::Change change, Done done) = 0;
    /// Takes the lease from another writer, too.
    virtual void take_lease(Done done) = 0;
    virtual void give_lease(Done done) = 0;
    /// The event stream of that name has ended; a jog that named it ends, too.
    virtual void end_stream(const std::string& name) = 0;
    /// The newest snapshot; never null.
    virtual std::shared_ptr<const Snapshot> snapshot() const = 0;
};

}  // namespace lockstep::web
