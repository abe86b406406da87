// A sender of grbl's protocol and a machine in virtual time.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "clients/grbl/lines/line_runner.hpp"
#include "clients/grbl/protocol/grbl.hpp"
#include "clients/session/upload/program_upload.hpp"
#include "services/coordinator/program_inbox.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep::grbl {

/// The messages of a client over the virtual network.
class VirtualPort : public MachinePort {
public:
    VirtualPort(VirtualMachine& machine, Identity client) : machine_(machine), client_(client) {}

    ProgramSender& open(const ProgramHead& head) override { return upload_.open(head); }
    void close() override { upload_.close(); }
    bool is_overdue() override { return upload_.is_overdue({.is_silent = is_silent}, now()); }
    CommandStep follow(CommandTracker& tracker) override {
        if (!tracker.is_numbered()) { tracker.number(client_, ++sequence_, 0); }
        const OwnerSight owner{.owner = machine_.state()->term};
        const CommandStep step = tracker.pass(reply_to(tracker.command()), owner, now());
        if (step == CommandStep::Send) { machine_.send(tracker.command()); }
        return step;
    }

    /// Sends the parts of the program that are due, and takes the replies.
    void pump() {
        for (; seen_ < machine_.replies().size(); ++seen_) {
            Reply reply = machine_.replies()[seen_];
            const auto chunk = chunks_.find(reply.sequence);
            if (loses_parts || chunk == chunks_.end() || reply.client == client_) { continue; }
            reply.client = client_;
            reply.sequence = chunk->second;
            (void)upload_.take_answer(reply, now());
        }
        for (const ProgramChunk& chunk : upload_.due(now())) {
            if (loses_parts) { continue; }
            auto part = inbox_.read(chunk);
            ASSERT_TRUE(part);
            chunks_[machine_.send(*std::move(part))] = chunk.sequence;
        }
    }

    bool loses_parts = false;  // the coordinator takes no part of a program
    bool is_silent = false;    // the client receives no state of the coordinator

private:
    std::chrono::nanoseconds now() const { return std::chrono::nanoseconds{machine_.now().value * 1000}; }
    const Reply* reply_to(const Command& command) const {
        for (const Reply& reply : machine_.replies()) {
            if (reply.client == client_ && reply.sequence == command.sequence) { return &reply; }
        }
        return nullptr;
    }

    VirtualMachine& machine_;
    Identity client_;
    std::uint64_t sequence_ = 0;
    ProgramUpload upload_{client_};
    ProgramInbox inbox_;
    std::map<std::uint64_t, std::uint64_t> chunks_;  // the program's numbers by the network's numbers
    std::size_t seen_ = 0;                           // replies
};

/// Joins the protocol, its lines and the port as lockstep-grbl does.
class VirtualSender {
public:
    explicit VirtualSender(VirtualMachine& machine, Identity client = 70, bool is_to_switch_off = false)
        : machine_(machine), port_(machine, client), lines_(machine.machine(), port_), grbl_(machine.machine(), "1") {
        if (is_to_switch_off) { grbl_.switch_off_at_rest(); }
        pass();
        grbl_.greet();
    }

    void send(const std::string& bytes) { grbl_.receive(bytes); }
    VirtualPort& port() { return port_; }
    void pass() {
        const std::chrono::nanoseconds now{machine_.now().value * 1000};
        port_.pump();
        carry_out();
        lines_.pass(*machine_.state(), rests(), now);
        if (const auto why = lines_.take_loss()) { grbl_.abort(*why); }
        answer();
        see();
        carry_out();
        text_ += grbl_.take_output();
    }
    /// The answers since the last call.
    std::string take_text() { return std::exchange(text_, {}); }
    const std::string& text() const { return text_; }
    gcode::KeptValues values;  // the machine's offsets and tools

    /// The sender's process ends.
    void leave() {
        grbl_.leave();
        lines_.leave();
    }

private:
    void see() {
        MachineView view = view_of(machine_.machine(), *machine_.state(), axes(), speeds());
        view.values = values;
        lines_.report(*machine_.state(), view);
        grbl_.see(view);
    }
    std::vector<const AxisState*> axes() const {
        std::vector<const AxisState*> axes;
        for (const auto& axis : machine_.axis_states()) { axes.push_back(axis ? &*axis : nullptr); }
        return axes;
    }
    std::vector<double> speeds() const {
        std::vector<double> speeds;
        for (const AxisState* axis : axes()) { speeds.push_back(axis ? axis->velocity.steps_per_tick() : 0); }
        return speeds;
    }
    bool rests() const {
        return std::ranges::all_of(axes(), [](const AxisState* axis) { return axis != nullptr && axis->at_rest; });
    }
    void answer() {
        for (const auto& answered : lines_.take_answers()) { grbl_.answer(answered.request, answered.answer); }
    }
    void carry_out() {
        const std::chrono::nanoseconds now{machine_.now().value * 1000};
        for (auto requests = grbl_.take_requests(); !requests.empty(); requests = grbl_.take_requests()) {
            for (Request& request : requests) { carry_out(request, now); }
        }
    }
    void carry_out(Request& request, std::chrono::nanoseconds now) {
        switch (request.kind) {
            case Request::Kind::Hold: return lines_.hold();
            case Request::Kind::Resume: return lines_.resume();
            case Request::Kind::Stop: return lines_.stop(now);
            case Request::Kind::Override: (void)machine_.set_overrides(request.overrides); return;
            case Request::Kind::SetValues:
                values = request.values;
                see();
                break;
            case Request::Kind::Reset: (void)machine_.command(CommandKind::Reset); break;
            case Request::Kind::RunLine:
                lines_.take(request.number, std::move(request.line));
                lines_.pass(*machine_.state(), rests(), now);
                return answer();
            default: break;
        }
        grbl_.answer(request.number, {.is_done = true});
    }

    VirtualMachine& machine_;
    VirtualPort port_;
    LineRunner lines_;
    Grbl grbl_;
    std::string text_;
};

}  // namespace lockstep::grbl
