#include "clients/grbl/machine_link.hpp"

#include <utility>

#include "clients/session/control/store_values.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/waits.hpp"
#include "core/coordinator/path/return_way.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::grbl {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kLeavePatience = 3s;

Answer answer_of(const Reply& reply) { return {reply.status == ReplyStatus::Accepted, reply.fault, reply.text}; }

Command command_of(const Request& request) {
    switch (request.kind) {
        case Request::Kind::Reset: return {.kind = CommandKind::Reset};
        case Request::Kind::Home: return {.kind = CommandKind::Home, .axes = request.axes};
        case Request::Kind::Override:
            return {.kind = CommandKind::Override,
                    .feed_percent = request.overrides.feed_percent,
                    .rapid_percent = request.overrides.rapid_percent};
        default: return {};
    }
}

}  // namespace

/// Holds, stops and jog cancels need no lease. If the coordinator is silent, the command itself reports that.
bool MachineLink::claim(const Request& request, Grbl& grbl) {
    using Kind = Request::Kind;
    if (request.kind == Kind::Hold || request.kind == Kind::Stop || request.kind == Kind::CancelJog) { return true; }
    use_lease(session_, {.has_work = true});
    if (session_.lease().is_held() || session_.is_silent()) { return true; }
    const auto reply = take_lease(session_, takes_over_);
    if (!reply || session_.lease().is_held()) { return true; }
    if (request.number != 0) { grbl.answer(request.number, answer_of(*reply)); }
    return false;
}

void MachineLink::carry_out(Request&& request, Grbl& grbl) {
    if (!claim(request, grbl)) { return; }
    switch (request.kind) {
        case Request::Kind::Hold: return lines_.hold();
        case Request::Kind::Resume: return lines_.resume();
        case Request::Kind::Stop: return lines_.stop(monotonic_now());
        case Request::Kind::Override: return send(command_of(request), 0);
        case Request::Kind::CancelJog: return jog_.release();
        case Request::Kind::Reset:
        case Request::Kind::Home: return send(command_of(request), request.number);
        case Request::Kind::SetValues: return set_values(request, grbl);
        case Request::Kind::KeepSettings:
        case Request::Kind::DropSettings:
            if (change_settings(request, grbl)) { grbl.answer(request.number, {.is_done = true}); }
            return;
        case Request::Kind::RunLine: lines_.take(request.number, std::move(request.line)); return pass_lines(grbl);
        case Request::Kind::Jog:
            jog_.press(request.jogs);
            new_jog_ = request.number;
            has_jog_ = true;
            return;
    }
}

void MachineLink::leave() {
    jog_.release();
    jog_.pass(monotonic_now() + 1ms);
    new_jog_.reset();
    has_jog_ = false;
    for (Open& open : open_) { open.number = 0; }
    lines_.leave();
}

bool MachineLink::is_stuck() const {
    const auto& state = session_.state();
    if (!state || session_.is_silent()) { return true; }
    const MachinePhase phase = state->state.phase;
    return phase == MachinePhase::Holding || phase == MachinePhase::Paused || phase == MachinePhase::Fault;
}

void MachineLink::release() {
    for (const nanoseconds begin = monotonic_now(); !lines_.has_left() && monotonic_now() - begin < kLeavePatience;) {
        session_.receive(5ms);
        lines_.pass(session_.state()->state, rests(), monotonic_now());
    }
    session_.upload().close();
    give_lease(session_);
}

void MachineLink::pass(nanoseconds time, Grbl& grbl) {
    jog_.pass(monotonic_now() + time);
    pass_lines(grbl);
    grbl.see(view());
    auto open = std::exchange(open_, {});
    for (Open& one : open) {
        if (!follow(one, grbl)) { open_.push_back(one); }
    }
    follow_jog(grbl);
    pass_lease(grbl);
}

/// If another writer takes the machine over, the machine runs the sender's lines that it has, and the other lines are
/// dropped.
void MachineLink::pass_lease(Grbl& grbl) {
    const bool has_work = !open_.empty() || has_jog_ || !lines_.is_idle();
    if (has_work && session_.lease().state() == LeaseKeeper::State::Lost) {
        lines_.leave();
        grbl.abort(session_.lease().answer()->text);
    }
    use_lease(session_, {.has_work = has_work});
}

bool MachineLink::follow(Open& open, Grbl& grbl) {
    if (open.job != 0) { return has_ended(open, grbl); }
    const CommandStep step = session_.follow(open.tracker);
    if (!is_over(step)) { return false; }
    const auto& reply = open.tracker.reply();
    const bool is_accepted = reply && reply->status == ReplyStatus::Accepted;
    if (is_accepted && open.tracker.command().kind == CommandKind::Home) {
        open.job = reply->job;
        return false;
    }
    grbl.answer(open.number, reply ? answer_of(*reply) : Answer{.text = CommandTracker::kNoAnswer});
    return true;
}

bool MachineLink::has_ended(const Open& open, Grbl& grbl) const {
    const auto& state = session_.state();
    const bool is_over =
        state && (state->state.job > open.job || (state->state.job == open.job && state->state.outcome));
    if (!is_over || !rests()) { return false; }
    const bool is_done = state->state.job == open.job && state->state.outcome == JobOutcome::Done;
    grbl.answer(open.number, {is_done, state->state.fault, is_done ? "" : "homing did not complete"});
    return true;
}

void MachineLink::follow_jog(Grbl& grbl) {
    const Reply* reply = jog_.reply();
    if (!has_jog_ || (reply == nullptr && !jog_.is_unanswered())) { return; }
    const Answer answer = reply != nullptr ? answer_of(*reply) : Answer{.text = CommandTracker::kNoAnswer};
    if (const auto number = std::exchange(new_jog_, std::nullopt)) { grbl.answer(*number, answer); }
    const auto& state = session_.state();
    const bool is_refused = !answer.is_done;
    const bool is_ending = jog_.is_over() || !jog_.is_pressed();
    const bool has_ended = is_ending && rests() && state && state->state.phase != MachinePhase::Jogging;
    if (!is_refused && !has_ended) { return; }
    has_jog_ = false;
    jog_.release();
    grbl.end_jog();
}

bool MachineLink::change_settings(const Request& request, Grbl& grbl) {
    const bool keeps = request.kind == Request::Kind::KeepSettings;
    const auto changed = keeps ? settings_.keep(request.settings) : settings_.drop();
    if (!changed) { grbl.answer(request.number, {.text = changed.error().text, .error = changed.error().error}); }
    grbl.see_next(settings_.next());
    return changed.has_value();
}

void MachineLink::set_values(const Request& request, Grbl& grbl) {
    if (request.drops_settings && !change_settings(request, grbl)) { return; }
    const auto before = await_values(session_);
    if (!before) { return grbl.answer(request.number, {.text = before.error().errors.front().message}); }
    RevisedValues values = *before;
    const auto stored = store_values(session_, values, request.values);
    if (stored) { values_ = request.values; }
    grbl.see(view());
    grbl.answer(request.number,
                stored ? Answer{.is_done = true} : Answer{.text = stored.error().errors.front().message});
}

/// Whether every axis is at rest, according to its latest report.
bool MachineLink::rests() const {
    for (const AxisIndex i : axis_indices(session_.config().axes.size())) {
        if (!session_.received().axis(i) || !session_.received().axis(i)->state.at_rest) { return false; }
    }
    return true;
}

void MachineLink::pass_lines(Grbl& grbl) {
    if (!session_.state()) { return; }
    lines_.pass(session_.state()->state, rests(), monotonic_now());
    if (const auto why = lines_.take_loss()) { grbl.abort(*why); }
    for (const LineRunner::Answered& answered : lines_.take_answers()) {
        grbl.answer(answered.request, answered.answer);
    }
}

MachineView MachineLink::view() {
    const auto& state = session_.state();
    if (!state) { return {}; }
    std::vector<const AxisState*> axes;
    std::vector<double> speeds;
    bool is_received = !session_.is_silent();
    for (const AxisIndex i : axis_indices(session_.config().axes.size())) {
        const auto& axis = session_.received().axis(i);
        axes.push_back(axis ? &axis->state : nullptr);
        speeds.push_back(session_.received().axis_speed(i));
        is_received = is_received && session_.received().axis_present(i);
    }
    MachineView view = view_of(session_.config(), state->state, axes, speeds);
    view.closed_inputs = letters_of_inputs(session_.config(), [this](MotorIndex motor) {
        return session_.received().motor(motor) ? session_.received().motor(motor)->state.inputs : 0;
    });
    view.accessories = letters_of_outputs(session_.config(), view.devices, [this](MotorIndex motor) {
        return session_.received().motor(motor) ? &session_.received().motor(motor)->state : nullptr;
    });
    view.is_received = is_received;
    if (const auto way = way_back(session_)) { view.way_back = text_of_way(*way); }
    if (const auto values = session_.values().newest()) { values_ = values->values; }
    view.values = values_;
    lines_.report(state->state, view);
    return view;
}

}  // namespace lockstep::grbl
