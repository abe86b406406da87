// Measures the reactions of a machine of real processes that is up and homed. Prints, for each time, after how many
// milliseconds axis 0 begins to brake and rests, according to the states that it publishes.
//
// usage: lockstep-reactions-live MACHINE.textproto hold|stop|feed|own|kill TIMES [PID]
#include <signal.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "services/documents/machine_file.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr double kSpeed_mm_s = 100;

struct Reaction {
    double brakes_ms = 0;
    double rests_ms = 0;
};

class LiveMachine {
public:
    explicit LiveMachine(Session session) : session_(std::move(session)) { await_axes(session_); }

    /// Moves from one end of the travel to the other. Returns when the speed is steady.
    bool move(CommandKind kind) {
        const AxisConfig& axis = session_.config().axes[0];
        const double here = static_cast<double>(state().position.count()) / axis.steps_per_mm;
        const double to = here > 100 ? axis.position_min_mm + 5 : axis.position_max_mm - 5;
        const bool own = kind == CommandKind::MoveOwn;
        const auto program = send_program(session_, {.name = "line",
                                                     .axes = {axis.name},
                                                     .start_mm = {here},
                                                     .blocks = {{1, ProgramMove{{to}, own ? 0 : kSpeed_mm_s, own}}}});
        return program && does({.kind = kind, .program = *program}) && until([&] { return is_steady(); });
    }
    bool does(const Command& command) {
        const auto reply = send_command(session_, command);
        return reply && reply->status == ReplyStatus::Accepted;
    }
    /// The reaction to `event`; nullopt if there is none in 20 s, or if the machine braked before it because this host
    /// stalled. The begin of braking is computed from the first slower state and the axis's deceleration.
    template <typename Event>
    std::optional<Reaction> after(const Event& event) {
        const double before = speed();
        const auto begun = monotonic_now();
        event();
        if (!until([&] { return speed() < 0.98 * before; })) { return {}; }
        const AxisConfig& axis = session_.config().axes[0];
        const double slowing_s = (before - speed()) / axis.max_decel_mm_s2;
        const Reaction brakes{(seconds(state().tick) - slowing_s - seconds(begun)) * 1e3};
        if (brakes.brakes_ms < 0) { return {}; }
        (void)until([&] { return state().at_rest || speed() == 0; });
        return Reaction{brakes.brakes_ms, (seconds(state().tick) - seconds(begun)) * 1e3};
    }
    bool ready() {
        return until([&] { return session_.state()->state.phase == MachinePhase::Idle && state().at_rest; });
    }
    void pass(std::chrono::nanoseconds time) {
        for (const auto end = monotonic_now() + time; monotonic_now() < end;) { session_.receive(5ms); }
    }

private:
    const AxisState& state() const { return session_.received().axis(AxisIndex{0})->state; }
    double speed() const {
        const double per_tick = std::abs(state().velocity.steps_per_tick());
        return per_tick * session_.config().ticks_per_second() / session_.config().axes[0].steps_per_mm;
    }
    bool is_steady() {
        const double before = speed();
        pass(30ms);
        return before > 20 && std::abs(speed() - before) < 0.1;
    }
    double seconds(Tick tick) const { return static_cast<double>(tick.value) / session_.config().ticks_per_second(); }
    static double seconds(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }
    template <typename Done>
    bool until(const Done& done) {
        for (const auto end = monotonic_now() + 20s; monotonic_now() < end;) {
            session_.receive(2ms);
            if (done()) { return true; }
        }
        return false;
    }

    Session session_;
};

int measure(LiveMachine& machine, const std::string& event, int times, int pid) {
    for (int i = 0; i < times; ++i) {
        if (!machine.ready() || !machine.move(event == "own" ? CommandKind::MoveOwn : CommandKind::Run)) { return 1; }
        machine.pass(std::chrono::milliseconds(100 + i * 17 % 60));
        const auto found = machine.after([&] {
            if (event == "kill") { (void)::kill(pid, SIGKILL); }
            if (event == "hold") { (void)machine.does({.kind = CommandKind::Hold}); }
            if (event == "stop" || event == "own") { (void)machine.does({.kind = CommandKind::Stop}); }
            if (event == "feed") { (void)machine.does({.kind = CommandKind::Override, .feed_percent = 10}); }
        });
        if (found) { std::printf("%.1f %.1f\n", found->brakes_ms, found->rests_ms); }
        if (event == "kill") { return 0; }
        if (event == "hold" || event == "feed") { (void)machine.does({.kind = CommandKind::Stop}); }
        if (event == "feed") {
            (void)(machine.ready() && machine.does({.kind = CommandKind::Override, .feed_percent = 100}));
        }
    }
    return 0;
}

int main_of(char** words, int pid) {
    const auto config = load_machine_file(words[1]);
    if (!config) { return 2; }
    auto session = Session::open({words[1], *config, config_hash(*config)}, Purpose::Command);
    if (!session) { return 3; }
    LiveMachine machine(std::move(*session));
    return measure(machine, words[2], std::atoi(words[3]), pid);
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: lockstep-reactions-live MACHINE.textproto hold|stop|feed|own|kill TIMES [PID]\n");
        return 2;
    }
    return lockstep::main_of(argv, argc > 4 ? std::atoi(argv[4]) : 0);
}
