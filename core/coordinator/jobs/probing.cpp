#include "core/coordinator/jobs/probing.hpp"

#include <algorithm>

#include "core/check.hpp"
#include "core/coordinator/epoch/touch_place.hpp"
#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/backlash.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {
namespace {

/// The positions of the motors' slides. All motors must rest.
MotorPositions positions_of(const LoopView& loop) {
    MotorPositions at;
    for (const MotorIndex m : motor_indices(loop.axes.size())) { at.append(slide_of(*loop.axes.state(m))); }
    return at;
}

/// Those that do not touch by the newest states.
TouchInputs untouched(const TouchInputs& inputs, const LoopView& loop) {
    TouchInputs left{.any_of = {}, .opens = inputs.opens, .ceases = inputs.ceases};
    for (const TouchInput& input : inputs.any_of) {
        const auto& state = loop.axes.state(input.motor);
        if (!state || !inputs.is_touched(input, state->inputs)) { left.any_of.append(input); }
    }
    return left;
}

/// The first input that touches; `untouched`: those that do not.
std::optional<TouchInput> touching(const TouchInputs& inputs, const TouchInputs& untouched) {
    for (const TouchInput& input : inputs.any_of) {
        if (std::ranges::find(untouched.any_of, input) == untouched.any_of.end()) { return input; }
    }
    return std::nullopt;
}

/// Within so many slots every change of the probe's inputs is known.
Slot slots_until_all_known(const Probe& probe, const MachineConfig& machine) {
    Slot slots = 0;
    for (const InputConfig* const input : inputs_of_probe(machine.inputs, probe.input)) {
        slots = std::max(slots, slots_until_known(*input, machine));
    }
    return slots;
}

}  // namespace

std::optional<Probed> Probing::end_at_begin(const PathTask& task, const TouchInputs& inputs, bool moves,
                                            const LoopView& loop) {
    awaited_ = untouched(inputs, loop);
    std::optional<FirstTouch> touch;
    const bool waits_for_all = inputs.opens && !inputs.ceases;  // inputs that see one switch are all closed before
    const bool touches = waits_for_all ? awaited_.empty() : awaited_ != inputs;
    if (touches) { touch = {loop.now, *touching(inputs, awaited_)}; }
    if (!touch && moves) { return std::nullopt; }
    note(task, touch, positions_of(loop), loop);
    if (!task.probe->must_touch) { return Probed{}; }
    return Probed{touch ? FaultCode::ProbeTouchedEarly : FaultCode::ProbeNotTouched};
}

/// On a straight move each motor goes on in one direction, also while it takes up its backlash.
MotorPositions Probing::slides_at(MotorPositions at, const LoopView& loop) const {
    for (std::size_t m = 0; m < plays_.size(); ++m) {
        Play play(loop.kinematics.motors()[m].backlash);
        play.set(plays_[m]);
        play.follow(at[m].count() - begun_at_[m].count());
        at[m] = at[m] - Displacement::steps(play.steps());
    }
    return at;
}

bool Probing::may_touch_yet(const PathTask& task, const EpochEnd& end, const EpochRunner& runner,
                            const LoopView& loop) {
    const bool is_asked = task.probe && !runner.touch().empty() && end.rests_on_path();
    rested_ = is_asked ? std::optional(rested_.value_or(loop.slot)) : std::nullopt;
    if (!is_asked || !lacks_states(*task.probe, runner, loop)) { rested_.reset(); }
    return waits();
}

/// A touch before the one that is known, or before the rest, may be of any input whose state is not known since then.
bool Probing::lacks_states(const Probe& probe, const EpochRunner& runner, const LoopView& loop) const {
    const auto& inputs = runner.touch().any_of;
    const auto touch = runner.first_touch(loop.axes.views());
    if (touch && inputs.size() == 1) { return false; }
    const Slot since = touch ? rules::slot_of(touch->tick, loop.machine.slot_ticks()) : *rested_;
    const Slot known = since + slots_until_all_known(probe, loop.machine);
    return std::ranges::any_of(inputs, [&](const TouchInput& input) {
        return loop.axes.is_present(input.motor, loop.slot) && loop.axes.state(input.motor)->stamp < known;
    });
}

void Probing::check_place(EpochEnd& end, const EpochRunner& runner, const LoopView& loop) {
    const auto touch = end.rests_on_path() ? runner.first_touch(loop.axes.views()) : std::nullopt;
    const auto begin = runner.made().start();
    if (!touch || !begin) { return; }
    const RunFrames ran{*begin, [&](Tick tick) { return runner.positions_at(tick, end.ran); }};
    const auto off = off_touch(loop.machine, runner.touch(), touch->tick, ran, end.positions);
    if (!off) { return; }
    end.kind = EpochEnd::Kind::OffTouch;
    end.motor = off->motor;
}

std::optional<Probed> Probing::end(const PathTask& task, const EpochEnd& end, const EpochRunner& runner,
                                   const LoopView& loop) {
    const auto touch = runner.first_touch(loop.axes.views());
    if (!touch && end.kind != EpochEnd::Kind::Complete) { return std::nullopt; }
    note(task, touch, slides_at(touch ? runner.positions_at(touch->tick, end.ran) : end.positions, loop), loop);
    if (!task.probe->must_touch) { return Probed{}; }
    if (!touch) { return Probed{FaultCode::ProbeNotTouched}; }
    const bool is_early = !runner.made().start() || touch->tick <= *runner.made().start();
    return Probed{is_early ? FaultCode::ProbeTouchedEarly : FaultCode::None};
}

void Probing::note(const PathTask& task, const std::optional<FirstTouch>& touch, const MotorPositions& at,
                   const LoopView& loop) {
    result_ = ProbeResult{.job = task.job.number, .input = {}, .tick = {}, .places_mm = {}};
    if (touch) {
        const TouchInput& input = touch->input;
        result_->input = input_at(loop.machine, motor_name(loop.machine, input.motor), input.channel);
        check(result_->input.has_value(), "the inputs of an epoch are those of the machine");
        result_->tick = touch->tick;
    }
    for (const AxisIndex i : axis_indices(loop.machine.axes.size())) {
        result_->places_mm.append(loop.kinematics.axis_steps(i, at) / loop.machine.axes[i].steps_per_mm);
    }
}

}  // namespace lockstep
