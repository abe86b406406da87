// A whole machine in one process in virtual time: the same coordinator, axis controllers, drivers and devices as live,
// connected by a simulated network. The same options and faults give the same run, bit for bit.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "services/virtual/clock_mail.hpp"
#include "services/virtual/fault_schedule.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/virtual_client.hpp"
#include "services/virtual/virtual_devices.hpp"
#include "services/virtual/virtual_options.hpp"
#include "services/virtual/virtual_post.hpp"
#include "services/virtual/virtual_processes.hpp"

namespace lockstep {

class VirtualMachine {
public:
    explicit VirtualMachine(const VirtualOptions& options);
    VirtualMachine(const VirtualMachine&) = delete;
    VirtualMachine& operator=(const VirtualMachine&) = delete;

    void observe(VirtualObserver& observer) { observers_.push_back(&observer); }

    /// Adds a fault. One with a beginning in the past begins at once. Crashes of one process must not overlap.
    void schedule(const VirtualFault& fault) { faults_.add(fault, now_); }
    /// Removes the faults that have not begun.
    void withdraw_faults() { faults_.withdraw(now_); }
    /// Whether a fault has yet to begin or end.
    bool faults_pending() const { return !faults_.empty(); }

    /// Advances to the next clock message, loop of a process, or beginning or end of a fault.
    void advance();
    /// Advances until done() returns true or `limit` has passed. Returns whether done() returned true.
    bool advance_until(const std::function<bool()>& done, Ticks limit);

    /// Sends a command over the network as a client. Returns its sequence number.
    std::uint64_t command(CommandKind kind, AxisSet axes = {}, std::uint64_t program = 0,
                          std::optional<Ticks> ticks = {});
    std::uint64_t set_overrides(const Overrides& overrides);
    /// Sends the command unchanged, such as one of another client or a renewed one.
    void send(const Command& command) { post_.multicast(now_, post_.client(), command); }
    /// Sends the last command again with the same sequence number, like a client that receives no reply.
    void repeat_command();
    /// Sends a part of a program over the network. Returns its sequence number.
    std::uint64_t send(ProgramPart part);
    /// Gives every running coordinator a complete program, without the network.
    void give_program(std::uint64_t id, const Program& program) { processes_.coordinators().give_program(id, program); }
    const std::vector<Reply>& replies() const { return client_.replies(); }
    /// The reply to a command; null if none has come yet.
    const Reply* reply_to(std::uint64_t sequence) const { return client_.reply_to(sequence); }
    /// Removes a reply, so that replies() does not grow without bound.
    void forget_reply(std::uint64_t sequence) { client_.forget_reply(sequence); }

    /// The process number of the coordinator that owns the machine. If several claim it, the one with the highest term.
    std::optional<std::size_t> owner() const { return processes_.owner(); }

    Tick now() const { return now_; }
    const MachineSetup& machine() const { return options_.machine; }
    /// The newest state that the client has received.
    const std::optional<MachineState>& state() const { return client_.state(); }
    const std::vector<std::optional<AxisState>>& axis_states() const { return client_.axis_states(); }
    /// The present reading of the clock of an axis's device.
    Tick device_time(std::size_t i) const { return clocks_.device(MotorIndex{i}, now_); }
    /// An axis's device, which outlives its processes.
    SimulatedDevice& device(std::size_t i) { return devices_[MotorIndex{i}]; }
    /// A person closes or opens an input of the machine, by its number in the machine's file.
    void set_input(std::size_t input, bool closed) { devices_.set_input(input, closed, now_); }
    const SimulatedDevice& device(std::size_t i) const { return devices_[MotorIndex{i}]; }
    const RegisterWindow& registers(std::size_t i) const { return devices_.registers(MotorIndex{i}); }
    const AlterationCounts& alterations() const { return post_.alterations(); }

private:
    void take_edge(const FaultSchedule::Edge& edge);
    void begin(const VirtualFault& fault);
    void end(const VirtualFault& fault);
    void restart(const VirtualFault& crash);
    std::uint64_t ask(const Command& command);

    VirtualOptions options_;
    Tick now_;
    MachineClocks clocks_;
    VirtualDevices devices_;
    VirtualPost post_;
    VirtualClient client_;
    ClockMail clock_mail_;
    FaultSchedule faults_;
    std::vector<VirtualObserver*> observers_;
    VirtualProcesses processes_;
};

}  // namespace lockstep
