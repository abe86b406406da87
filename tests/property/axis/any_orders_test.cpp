// An axis with its simulated device publishes, orders and records what any_orders.txt has recorded, whatever it is
// asked in whatever order. To write the file: LOCKSTEP_WRITE_HASHES=1 build/bin/property_axis
// --gtest_filter='AnswersOfAnAxis.StayAsRecorded'
#include <array>
#include <random>

#include "core/axis/health_meter.hpp"
#include "core/kinematics/motors.hpp"
#include "services/axis/axis_node.hpp"
#include "services/axis/window_port.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"
#include "tests/simulation/simtest/record/publication.hpp"
#include "tests/unit/allocations/quick_machine.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kAxes = 60;
constexpr Slot kFirstSlot = 1000;
constexpr Slot kSlotsOfRun = 3000;
constexpr std::int64_t kSlotTicks = 1000;
constexpr std::int64_t kGentle = 553'402'322'211;     // 3e-8 steps per tick^2; the axis allows 5e-8
constexpr std::int64_t kTooFast = 1'106'804'644'422;  // 6e-8

/// An axis, its owner, and the path of frames that the owner sends now and then.
class AskedAxis {
public:
    explicit AskedAxis(std::uint32_t number) : random_(number), machine_(draw_machine()) { node_.measure(meter_); }

    std::string result() {
        for (Slot now = kFirstSlot; now < kFirstSlot + kSlotsOfRun; ++now) { slot(now); }
        return text_.line(published_.value(), steps_, last_step_).text();
    }

private:
    bool one_of(std::uint64_t n) { return random_() % n == 0; }
    std::int64_t whole(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
    }

    MachineConfig draw_machine() {
        MachineConfig machine = quick_machine({"X"});
        AxisConfig& axis = machine.axes[0];
        axis.position_max_mm = 20;
        axis.homing.toward_min = !one_of(3);
        if (!axis.homing.toward_min) { axis.homing.switch_position_mm = 21; }
        axis.homing.way = one_of(2) ? HomingWay::InPlace : HomingWay::BySwitch;
        axis.plant.start_position_mm = static_cast<double>(whole(1, 19));
        if (one_of(3)) { axis.unhomed_jog_mm_s.reset(); }
        constexpr std::array kMethods{StepMethod::Ranade, StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lam};
        axis.method = kMethods[random_() % kMethods.size()];
        return machine;
    }

    AxisCommand draw_order(Slot now) {
        using enum AxisCommandKind;
        constexpr std::array kKinds{Home, Home, MoveOwn, MoveOwn, MoveOwn, Jog, Jog, Halt, Approach, Reset};
        AxisCommand order{.term = owner_, .sequence = ++sequence_, .kind = kKinds[random_() % kKinds.size()]};
        if (one_of(40)) { order.kind = StopNow; }
        if (state_.phase == AxisPhase::Fault && !one_of(3)) { order.kind = Reset; }
        if (!state_.homed && !one_of(12)) { order.kind = Home; }
        order.target_steps = one_of(3) ? state_.position.count() + whole(-3, 3) : whole(-100, 2100);
        if (one_of(3)) { order.ticks = Ticks{whole(1, 2'000'000)}; }
        order.speed_mm_s = static_cast<double>(whole(1, 60));
        order.until = Tick{(now + whole(0, 300)) * kSlotTicks};
        return order;
    }
    /// An order is repeated until it is done; that of a jog names a later time. Some are of another owner.
    std::vector<AxisCommand> orders(Slot now) {
        const bool is_done = state_.command_done >= order_.sequence;
        if (one_of(is_done ? 30 : state_.homed ? 200 : 3000)) { order_ = draw_order(now); }
        if (order_.sequence == 0 || (is_done && !one_of(20))) { return {}; }
        if (order_.kind == AxisCommandKind::Jog && one_of(10)) { order_.until = Tick{(now + 40) * kSlotTicks}; }
        AxisCommand given = order_;
        if (one_of(50)) { given.term.coordinator += 1; }
        return {given};
    }

    /// A first frame, the ones that follow it, and the last one: forth or back at constant acceleration.
    void begin_path(Slot now) {
        epoch_ = first_epoch(owner_) + ++epochs_;
        at_ = rest_position(state_.position.count(), false);
        start_ = Tick{(now + 13) * kSlotTicks};
        frames_left_ = whole(2, 8);
        speed_.raw = 0;
        number_ = 0;
        acceleration_.raw = one_of(6) ? kTooFast : kGentle;
    }
    Piece piece_of(Ticks ticks, bool rises) {
        Piece piece{ticks, speed_, acceleration_};
        if (!rises) { piece.acceleration.raw = -acceleration_.raw; }
        speed_.raw += piece.acceleration.raw * ticks.value;
        return piece;
    }
    std::vector<Frame> frames(Slot now) {
        const bool may_begin = state_.at_rest && state_.homed && state_.phase == AxisPhase::Standby;
        if (frames_left_ == 0 && may_begin && one_of(40)) { begin_path(now); }
        if (frames_left_ == 0 || start_ - Tick{now * kSlotTicks} > Ticks{13 * kSlotTicks}) { return {}; }
        const Ticks ticks{5 * kSlotTicks};
        Frame frame{.term = owner_, .epoch = epoch_, .number = ++number_, .start = start_, .ticks = ticks};
        frame.last = --frames_left_ == 0;
        AxisTrack track{at_, {}, {}};
        if (frame.last) {
            const Ticks left{acceleration_.raw == 0 ? 1 : speed_.raw / acceleration_.raw};
            if (left.value > 0) { track.body.append(piece_of(left, false)); }
            frame.ticks = left;
        } else {
            track.body.append(piece_of(ticks, true));
            const Velocity kept = speed_;
            const Ticks rest{speed_.raw / acceleration_.raw};
            track.tail.append(piece_of(rest, false));
            speed_ = kept;
        }
        for (const Piece& piece : track.body) { at_ = at_ + piece.covered(); }
        start_ = start_ + frame.ticks;
        if (one_of(60)) { track.from = track.from + Displacement{1}; }
        frame.axes.push_back(track);
        return {frame};
    }

    /// The owner is silent at times; sometimes another coordinator claims the machine.
    std::vector<MachineState> owner(Slot now) {
        if (silent_until_ > now) { return {}; }
        if (one_of(800)) { silent_until_ = now + whole(1, 20); }
        if (one_of(1500)) { owner_.number += 1000; }
        MachineState state{.term = owner_, .stamp = now, .phase = MachinePhase::Idle, .epoch = epoch_};
        state.sent = number_;
        if (one_of(120) && number_ > 0) { state.veto = number_ + static_cast<FrameNumber>(whole(0, 1)); }
        return {state};
    }
    std::vector<Command> requests() {
        if (!one_of(900)) { return {}; }
        return {Command{.client = 3, .sequence = ++sequence_, .kind = CommandKind::EmergencyStop}};
    }

    void slot(Slot now) {
        const auto sent = frames(now);
        const auto received = owner(now);
        const auto ordered = orders(now);
        const auto asked = requests();
        const Tick own{now * kSlotTicks + whole(0, 400)};
        const AxisOutputs& out = node_.step(own, {sent, {}, received, ordered, asked, {}}, on_step_);
        published_.on_axis(MotorIndex{0}, own, out, node_);
        if (out.state) { state_ = *out.state; }
        const auto health = meter_.report(Ticks{3}, {});
        if (!health) { return; }
        for (const Extremes& of : {health->step_lateness, health->step_interval, health->setpoint_slack}) {
            text_.line(of.count, of.least, of.most);
        }
        text_.line(health->least_free_segments, health->least_free_captures, health->setpoint_age,
                   health->refused.frames, health->refused.commands);
    }

    std::mt19937_64 random_;
    MachineConfig machine_;
    Term owner_{1, 5};
    AxisNode node_{{MotorIndex{0}, machine_, 7, 1},
                   [this](Tick now) { return simulated_port(machine_, motors_of(machine_)[0], now); }};
    HealthMeter meter_{MotorIndex{0}, 7, 1000};
    AxisState state_;
    AxisCommand order_;
    std::uint64_t sequence_ = 0;
    Slot silent_until_ = 0;
    // The path.
    Epoch epoch_ = 0;
    Epoch epochs_ = 0;
    FrameNumber number_ = 0;
    std::int64_t frames_left_ = 0;
    Position at_;
    Tick start_;
    Velocity speed_;
    Acceleration acceleration_;
    // The result.
    simtest::PublicationHash published_;
    RecordedText text_;
    std::int64_t steps_ = 0;
    Tick last_step_;
    AxisNode::OnStep on_step_ = [this](StepEdge step) {
        ++steps_;
        last_step_ = step.tick;
    };
};

TEST(AnswersOfAnAxis, StayAsRecorded) {
    expect_recorded("tests/property/axis/any_orders.txt", kAxes,
                    [](std::uint32_t number) { return AskedAxis(number).result(); });
}

}  // namespace
}  // namespace lockstep
