// A machine that only notes what it is asked for.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "clients/web/machine/port.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {

class NotingPort : public MachinePort {
public:
    void command(const Command& command, Done done) override {
        const std::lock_guard lock(mutex);
        asked.push_back("command " + std::to_string(static_cast<int>(command.kind)));
        done(Accepted{});
    }
    void jog(const JogOrder& order, Done done) override {
        asked.push_back("jog " + order.stream);
        done(Accepted{.jogging = true});
    }
    void run(ReadyProgram&&, Done done) override { done(Accepted{.job = 1}); }
    void change_values(ValuesTask::Change, Done done) override {
        asked.emplace_back("values");
        done(Accepted{});
    }
    void take_lease(Done done) override {
        asked.emplace_back("take");
        done(Accepted{});
    }
    void give_lease(Done done) override {
        asked.emplace_back("give");
        done(std::unexpected(unanswered("nobody")));
    }
    void end_stream(const std::string& name) override { asked.push_back("end " + name.substr(name.find('-'))); }
    std::shared_ptr<const Snapshot> snapshot() const override {
        return std::make_shared<const Snapshot>(snapshot_at_rest());
    }

    std::mutex mutex;  // protects asked from the calls of command()
    std::vector<std::string> asked;
};

}  // namespace lockstep::web
