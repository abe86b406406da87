#include "tests/simulation/simtest/record/publication.hpp"

#include <cmath>
#include <concepts>
#include <optional>
#include <ranges>
#include <string>

namespace lockstep::simtest {
namespace {

/// FNV-1a over whole words.
struct Hash {
    std::uint64_t& value;

    template <typename... Parts>
    void of(const Parts&... parts) {
        (add(parts), ...);
    }

    /// What only machines with inputs or outputs have. The hashes of other machines stay those of before.
    template <typename... Parts>
    void add_if(bool has_it, const Parts&... parts) {
        if (has_it) { of(parts...); }
    }

    template <typename Number>
    requires std::integral<Number> || std::is_enum_v<Number>
    void add(Number number) { value = (value ^ static_cast<std::uint64_t>(number)) * 0x100000001b3U; }
    template <typename Of>
    void add(Index<Of> index) {
        add(index.number());
    }
    template <typename AnIndex>
    void add(IndexSet<AnIndex> set) {
        add(set.bits());
    }
    /// To a millionth: the last bits may depend on the compiler.
    void add(double number) { add(std::llround(number * 1e6)); }
    void add(Tick tick) { add(tick.value); }
    void add(Ticks ticks) { add(ticks.value); }
    void add(Velocity velocity) { add(velocity.raw); }
    void add(Position at) { of(at.count(), at.phase()); }
    void add(const std::string& text) {
        add(text.size());
        for (const char c : text) { add(c); }
    }
    template <typename Value>
    void add(const std::optional<Value>& maybe) {
        add(maybe.has_value());
        if (maybe) { add(*maybe); }
    }
    template <std::ranges::input_range List>
    void add(const List& list) {
        add(std::ranges::distance(list));
        for (const auto& one : list) { add(one); }
    }

    void add(const Term& term) { of(term.number, term.coordinator); }
    void add(const Piece& piece) { of(piece.ticks, piece.velocity, piece.acceleration.raw); }
    void add(const AxisTrack& track) { of(track.from, track.body, track.tail); }
    void add(const PathPlace& place) { of(place.block, static_cast<std::int64_t>(place.along.raw >> 32)); }
    void add(const Overrides& overrides) { of(overrides.feed_percent, overrides.rapid_percent); }
    void add(const TouchInputs& touch) {
        add(!touch.empty());
        for (const TouchInput& input : touch.any_of) { of(input.motor, input.channel, touch.opens); }
        add_if(touch.ceases, touch.ceases);
    }
    void add(const MotorOutputs& of_motor) { of(of_motor.motor, of_motor.track.body, of_motor.track.tail); }
    void add(const Frame& f) {
        of(f.term, f.epoch, f.number, f.start, f.ticks, f.last, f.axes);
        add_if(!f.touch.empty() || !f.outputs.empty(), f.touch, f.outputs);
    }
    void add(const Switches& s) { of(s.limit_min, s.limit_max, s.home); }
    void add(const AxisState& s) {
        of(s.identity, s.axis, s.stamp, s.epoch, s.held, s.veto, s.ran, s.at_rest, s.homed, s.phase, s.fault,
           s.position, s.velocity, s.tick, s.following_error_steps, s.command_done, s.command_fault, s.config_hash,
           s.refused_frames, s.clock_error, s.term, s.hears_owner, s.unproved, s.switches);
        add_if(s.touch.has_value(), s.touch);
        add_if(s.ceased, s.ceased);
        add_if(s.play_steps != 0, s.play_steps);
        add_if(s.corrected_steps != 0, s.corrected_steps);
        add_if(s.outputs != 0 || s.pulses_left != 0 || s.analog != AnalogLevels{}, s.outputs, s.pulses_left, s.analog);
    }
    void add(const EpochTouch& touch) { of(touch.epoch, touch.tick); }
    void add(const AxisCommand& c) {
        of(c.term, c.sequence, c.axis, c.kind, c.target_steps, c.ticks, c.speed_mm_s, c.until);
    }
    void add(const ProgramDevices& d) { of(d.spindle, d.spindle_rpm, d.mist, d.flood, d.tool, d.outputs); }
    void add(const HeldLease& lease) { of(lease.writer.id, lease.writer.name, lease.writer.host, lease.since); }
    void add(const MachinePause& pause) { of(pause.why.reason, pause.why.tool, pause.why.text, pause.place); }
    void add(const FrameRest& rest) { of(rest.frame, rest.place, rest.last, rest.digest); }
    void add(const ProbeResult& p) { of(p.job, p.touched(), p.tick, p.places_mm); }
    void add(const MachineState& s) {
        of(s.term, s.stamp, s.tick, s.phase, s.fault, s.fault_motor, s.epoch, s.sent, s.veto, s.job, s.outcome,
           s.job_begun, s.line, s.job_fault, s.lacks_blocks, s.progress, s.remaining_s, s.overrides, s.motors_present,
           s.config_hash, s.devices, s.lease, s.pause, s.job_kind, s.program, s.leg_from, s.events_from, s.rests);
        add_if(s.probe.has_value(), s.probe);
    }
    void add(const ProgramEvent& event) { of(event.kind, event.index, event.value); }
    void add(const PublishedEvent& e) {
        of(e.term, e.sequence, e.job, e.epoch, e.tick, e.at_rest, e.is_of_program, e.block, e.line, e.event);
    }
    void add(const Reply& r) { of(r.client, r.sequence, r.status, r.fault, r.job, r.text, r.parts, r.free_blocks); }
    void add(const TakenPart& part) { of(part.program, part.index); }
    void add(const JobEvent& e) {
        of(e.kind, e.job, e.job_kind, e.outcome, e.program != nullptr, e.program_id, e.epoch, e.start, e.place,
           e.overrides, e.behind, e.start_counts);
    }
    void add(const CoordinatorNotice& n) { of(n.kind, n.fault, n.number, n.doubt); }
    void add(const EpochOutcome& outcome) { of(outcome.kind, outcome.intent); }
    void add(const FailedCheck& c) { of(c.too_late, c.held, c.lacking, c.no_coordinator); }
    void add(const AxisNotice& n) { of(n.kind, n.fault, n.number, n.check); }
    void add(const ExecutedTrack& t) {
        of(t.epoch, t.frame, t.tail, t.start, t.from, t.pieces, t.cut, t.stop_count, t.zero_count, t.commanded_start,
           t.commanded_ticks, t.clock_error);
    }
    void add(const DeviceOrder& order) {
        add(order.index());
        std::visit([this](const auto& one) { add_order(one); }, order);
    }
    void add_order(const device::BeginRun& run) { of(run.run, run.trigger, run.own); }
    void add_order(const device::LoadFrame& load) { of(load.number, load.start, load.last, load.track); }
    void add_order(const device::Arm& arm) { add(arm.number); }
    void add_order(const device::Veto& veto) { add(veto.number); }
    void add_order(const device::StopNow&) {}
    void add_order(const device::LoadOutputs& load) { of(load.number, load.track.body, load.track.tail); }
    void add_order(const device::ChangeOutputs& change) { of(change.digital, change.analog); }
    void add(const OutputChange& change) {
        of(change.at, change.what.index());
        std::visit([this](const auto& one) { add(one); }, change.what);
    }
    void add(const SetDigital& digital) { of(digital.levels, digital.mask); }
    void add(const RampAnalog& analog) { of(analog.channel, analog.value, analog.slope); }
    void add(const ComparePosition& compare) { of(compare.next, compare.every, compare.pulses); }
};

}  // namespace

void PublicationHash::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode&) {
    if (!out.state && out.orders.empty() && out.tracks.empty() && out.notices.empty()) { return; }
    Hash{hash_}.of(axis, now, out.state, out.orders, out.tracks, out.notices, out.device_changed);
}

void PublicationHash::on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) {
    Hash hash{hash_};
    if (out.state) { hash.of(process, now, *out.state); }
    hash.of(out.frames, out.axis_commands, out.replies, out.taken, out.jobs, out.events, out.notices, out.epoch_end,
            out.must_quit);
    for (const std::size_t row : out.transitions) {  // not the row's number, which changes with the table
        hash.of(kMachineTransitions[row].from, kMachineTransitions[row].event);
    }
}

}  // namespace lockstep::simtest
