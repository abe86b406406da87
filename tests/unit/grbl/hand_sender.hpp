// The test acts as sender and as machine.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "clients/grbl/protocol/grbl.hpp"
#include "tests/unit/grbl/mill.hpp"

namespace lockstep::grbl {

using Kind = Request::Kind;

class Sender : public testing::Test {
protected:
    Sender() {
        view.is_received = true;
        view.phase = MachinePhase::Idle;
        view.axes = {{10, true}, {20, true}, {30, true}};
        grbl.see(view);
        grbl.greet();
        (void)grbl.take_output();
    }
    /// Sends the bytes and returns the lines of the answer.
    std::vector<std::string> send(std::string_view bytes) {
        grbl.receive(bytes);
        return lines();
    }
    std::vector<std::string> lines() {
        std::vector<std::string> found;
        const std::string output = grbl.take_output();
        for (std::size_t at = 0; at < output.size();) {
            const std::size_t end = output.find("\r\n", at);
            EXPECT_NE(end, std::string::npos) << "every line has its end";
            found.push_back(output.substr(at, end - at));
            at = end + 2;
        }
        return found;
    }
    std::vector<Kind> asked() {
        std::vector<Kind> kinds;
        requests = grbl.take_requests();
        for (const Request& request : requests) { kinds.push_back(request.kind); }
        return kinds;
    }
    void change(MachinePhase phase, FaultCode fault = FaultCode::None) {
        view.phase = phase;
        view.fault = fault;
        grbl.see(view);
    }
    std::string status() {
        const auto found = send("?");
        return found.empty() ? "" : found.back();
    }

    /// Configures a machine that accepts the words for devices.
    void assign_devices() {
        MachineSetup machine = mill();
        machine.unassigned = {
            .spindle = WordRule::Ignore, .outputs = WordRule::Ignore, .tool_change = ToolChange::GoOn};
        std::destroy_at(&grbl);
        std::construct_at(&grbl, machine, "1.0");
        grbl.see(view);
    }
    /// Runs a line until the machine rests.
    void run(const std::string& line) {
        (void)send(line + "\n");
        for (const Kind kind : asked()) {
            if (kind == Kind::RunLine) { grbl.answer(requests.back().number, {.is_done = true}); }
        }
        grbl.see(view);
        (void)lines();
    }

    MachineView view;
    Grbl grbl{mill(), "1.0"};
    std::vector<Request> requests;
};

}  // namespace lockstep::grbl
