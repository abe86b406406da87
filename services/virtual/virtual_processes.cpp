#include "services/virtual/virtual_processes.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {

VirtualProcesses::VirtualProcesses(const Surroundings& around, Tick now)
    : around_(around),
      schedule_(around.post.processes(), {around.options.machine.slot_ticks().value / around.options.loops_per_slot}),
      axes_(motor_count(around.options.machine)),
      coordinators_(around.options.machine, around.options.coordinators, around.options.on_takeover,
                    around.options.make_rows),
      stalls_(around.post.processes()) {
    for (std::size_t i = 0; i < stalls_.size(); ++i) { start(i, now); }
    schedule_.start_all(now, around.options.seed);
}

void VirtualProcesses::start(std::size_t process, Tick now, bool other_config) {
    const VirtualOptions& options = around_.options;
    const std::uint64_t config_hash = options.config_hash + (other_config ? 1 : 0);
    if (around_.post.is_coordinator(process)) {
        const Identity identity = static_cast<Identity>(around_.clocks.machine(now).value) + process;
        FlightLog* const flight = options.flight ? &options.flight(process) : nullptr;
        coordinators_.start(number_of(process), identity, config_hash, flight);
    } else {
        start_axis(MotorIndex{process}, config_hash);
    }
    stalls_[process] = {};
    schedule_.start(process, now);
}

void VirtualProcesses::start_axis(MotorIndex motor, std::uint64_t config_hash) {
    Axis& it = axes_[motor];
    const AxisNode::Setup setup{motor, around_.options.machine, axis_identities_++, config_hash, it.kept};
    around_.clock_mail.begin(motor, setup.identity);
    it.node.emplace(setup, [this, motor](Tick) { return around_.devices.open(motor); });
    it.node->pass_channels([this, motor](const ChannelEvent& event) {
        for (VirtualObserver* observer : around_.observers) { observer->on_channel(motor, event); }
    });
    if (!around_.options.flight) { return; }
    it.flight.emplace(motor, around_.options.machine, around_.options.flight(motor));
    it.node->note_in(*it.flight);
}

void VirtualProcesses::end(std::size_t process) {
    schedule_.end(process);
    stalls_[process] = {};
    around_.post.is_coordinator(process) ? coordinators_.end(number_of(process)) : axes_[process].node.reset();
}

std::optional<std::size_t> VirtualProcesses::owner() const {
    const auto owner = coordinators_.owner();
    return owner ? std::optional(axes_.size() + *owner) : std::nullopt;
}

/// A process that stalls in a loop has decided but not acted. It acts when it continues.
bool VirtualProcesses::run_loop(std::size_t process, Tick now) {
    schedule_.run(process);
    Stall& stall = stalls_[process];
    if (stall.decided.index() != 0) {
        const auto decided = std::exchange(stall.decided, std::monostate{});
        return std::visit([&](const auto& out) { return carry_out(process, out, now); }, decided);
    }
    return around_.post.is_coordinator(process) ? act(process, decide_coordinator(process, now), now)
                                                : act(process, decide_axis(MotorIndex{process}, now), now);
}

template <typename Outputs>
bool VirtualProcesses::act(std::size_t process, const Outputs& out, Tick now) {
    Stall& stall = stalls_[process];
    if (stall.until <= now) { return carry_out(process, out, now); }
    stall.decided = out;
    schedule_.delay(process, stall.until);
    return false;
}

const AxisOutputs& VirtualProcesses::decide_axis(MotorIndex i, Tick now) {
    const Mail& mail = around_.post.collect(now, i);
    const auto on_step = [&](StepEdge step) {
        for (VirtualObserver* observer : around_.observers) { observer->on_step(i, step); }
    };
    AxisNode& node = *axes_[i].node;
    const std::vector<ClockExchange> exchanges = around_.clock_mail.take_exchanges(i);
    around_.devices.advance(i, now);
    const AxisOutputs& out =
        node.decide(around_.clocks.process(i, now),
                    {mail.frames, mail.axes, mail.machine, mail.axis_commands, mail.commands, exchanges}, on_step);
    for (VirtualObserver* observer : around_.observers) { observer->on_axis(i, now, out, node); }
    return out;
}

bool VirtualProcesses::carry_out(std::size_t process, const AxisOutputs& out, Tick now) {
    const MotorIndex i{process};
    around_.devices.advance(i, now);
    axes_[i].node->carry_out(out);
    around_.devices.advance(i, now);  // the device carries out its orders
    around_.clock_mail.ask(i, now);
    if (out.rests && around_.options.keeps_positions) { axes_[i].kept = *out.rests; }
    if (out.state) { around_.post.multicast(now, i, *out.state); }
    return axes_[i].node->must_restart();
}

CoordinatorOutputs VirtualProcesses::decide_coordinator(std::size_t process, Tick now) {
    const Mail& mail = around_.post.collect(now, process);
    const CoordinatorInputs in{around_.clocks.machine(now), mail.axes, mail.machine, mail.commands, mail.parts};
    CoordinatorOutputs out = coordinators_.step(number_of(process), in);
    for (const TakenPart& taken : out.taken) { note_part(process, taken, mail.parts, now); }
    for (VirtualObserver* observer : around_.observers) { observer->on_coordinator(process, now, out); }
    return out;
}

void VirtualProcesses::note_part(std::size_t process, const TakenPart& taken, const std::vector<ProgramPart>& parts,
                                 Tick now) {
    const auto part = std::ranges::find_if(parts, [&](const ProgramPart& received) {
        return received.program == taken.program && received.index == taken.index && !received.is_question;
    });
    for (VirtualObserver* observer : around_.observers) { observer->on_part(process, now, *part); }
}

bool VirtualProcesses::carry_out(std::size_t process, const CoordinatorOutputs& out, Tick now) {
    if (out.state) { around_.post.multicast(now, process, *out.state); }
    for (const Frame& frame : out.frames) { around_.post.send_to_axes(now, process, frame); }
    for (const AxisCommand& command : out.axis_commands) { around_.post.send(now, process, command.axis, command); }
    for (const Reply& reply : out.replies) { around_.post.send(now, process, around_.post.client(), reply); }
    return false;
}

}  // namespace lockstep
