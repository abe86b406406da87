#include "clients/lockstep/jog/jog_screen.hpp"

#include "clients/lockstep/job/hang_up.hpp"
#include "clients/lockstep/jog/jog_keys.hpp"
#include "clients/lockstep/status/screen.hpp"
#include "clients/session/control/jog_link.hpp"
#include "clients/text/format.hpp"
#include "core/protocol/names.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kReadPeriod = 5ms;
constexpr nanoseconds kJogRedrawPeriod = 100ms;

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string line_of(const Session& session, const JogKeys& keys, AxisIndex axis) {
    const AxisConfig& config = session.config().axes[axis];
    const auto& received = session.received().axis(axis);
    if (!received) { return padded("  " + config.name, 8) + "not received\n"; }
    const AxisState& state = received->state;
    const std::string place = fixed(to_mm(config, static_cast<double>(state.position.count())), 3);
    const std::string homed = state.homed               ? ""
                              : config.unhomed_jog_mm_s ? "not homed: slow, no soft limits"
                                                        : "not homed";
    return padded("  " + config.name, 8) + padded(place + " mm", 16) + padded(std::string(JogKeys::keys_of(axis)), 22) +
           padded(fixed(keys.speed_mm_s(axis), 2) + " mm/s", 16) + homed + "\n";
}

std::string screen_text(const Session& session, const JogKeys& keys, const std::string& note) {
    std::string text = session.config().name;
    if (session.state()) { text += ": " + std::string(name_of(session.state()->state.phase)); }
    text += "\n\n";
    for (const AxisIndex i : axis_indices(session.config().axes.size())) { text += line_of(session, keys, i); }
    text += keys.makes_steps() ? "\nEach press of a key is one step; space ends it.\n"
                               : "\nHold a key to jog; an axis brakes 150 ms after the last repetition of its key.\n";
    text += "+ and - change the speed, space releases all, q quits.\n";
    return text + (note.empty() ? "" : "\n" + note + "\n");
}

/// Why the latest jog was refused, or that the coordinator is silent; else empty.
std::string note_of(const Session& session, const JogLink& link) {
    if (session.is_silent()) { return "the coordinator is silent"; }
    const Reply* reply = link.reply();
    return reply != nullptr && reply->status == ReplyStatus::Refused ? "refused: " + reply->text : "";
}

/// A step goes its whole distance, although its key is released. The next one begins when it is complete.
void follow(JogKeys& keys, JogLink& link, nanoseconds now) {
    if (!keys.makes_steps()) { return link.press(keys.jogs(now)); }
    if (keys.take_stop()) { link.release(); }
    const Reply* reply = link.reply();
    const bool is_refused = reply != nullptr && reply->status == ReplyStatus::Refused;
    if (link.is_pressed() && !link.is_over() && !is_refused) { return; }
    if (const auto step = keys.take_step()) {
        link.release();
        link.press({*step});
    }
}

}  // namespace

/// If a loop comes late, the keys that it reads were typed long ago, so those of axes count as released; q still quits.
ExitCode jog_by_keys(Session& session, std::optional<double> step_mm, Output&) {
    const StopSignal stop;
    const HangUp hang_up;
    JogKeys keys(session.config(), step_mm);
    JogLink link(session);
    Screen screen;
    nanoseconds drawn{};
    std::string note;
    for (nanoseconds last = monotonic_now(); !stop.requested() && !hang_up.came() && !keys.must_quit();) {
        const nanoseconds now = monotonic_now();
        const std::string typed = screen.typed();
        keys.take(typed, now);
        if (now - last > JogKeys::kHold) { keys.release_all(); }
        last = now;
        follow(keys, link, now);
        if (const std::string newest = note_of(session, link); link.is_pressed() || !newest.empty()) { note = newest; }
        if (now - drawn >= kJogRedrawPeriod) {
            drawn = now;
            screen.draw(screen_text(session, keys, note));
        }
        link.pass(now + kReadPeriod);
    }
    link.release();
    link.pass(monotonic_now() + 50ms);
    return kExitDone;
}

}  // namespace lockstep
