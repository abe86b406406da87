#include "clients/scenario/runner/act_executor.hpp"

#include <algorithm>

#include "clients/session/command_effect.hpp"
#include "clients/session/waits.hpp"
#include "core/number_text.hpp"
#include "services/files/text_file.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {
namespace {

using namespace std::chrono_literals;
using Done = std::expected<void, std::string>;

constexpr double kAll = 100;  // percent
constexpr auto kStopPatience = 500ms;

/// The acts that undo an act.
std::vector<Asked::Act> undo_of(const Asked::Act& act) {
    std::vector<Asked::Act> acts(1);
    if (act.has_pause()) { acts[0].set_unpause(act.pause()); }
    if (act.has_cut()) { acts[0].set_heal(act.cut().process()); }
    if (!act.has_lose()) { return acts; }
    acts.clear();
    for (const std::string& process : act.lose().process()) { acts.emplace_back().set_heal(process); }
    if (acts.empty()) { acts.emplace_back().set_heal("all"); }
    return acts;
}

std::string failure_text(const Failure& failure) { return failure.errors.front().message; }

}  // namespace

Done ActExecutor::execute(const Asked::Act& act) {
    const Done done = apply(act);
    if (!done || !act.has_for_s()) { return done; }
    const auto at = monotonic_now() +
                    std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(act.for_s()));
    for (const Asked::Act& undo : undo_of(act)) { undoing_.push_back({at, undo}); }
    return done;
}

std::optional<Asked::Act> ActExecutor::take_due() {
    const auto now = monotonic_now();
    const auto due = std::ranges::find_if(undoing_, [&](const Undo& undo) { return undo.at <= now; });
    if (due == undoing_.end()) { return std::nullopt; }
    Asked::Act act = due->act;
    undoing_.erase(due);
    return act;
}

Done ActExecutor::apply(const Asked::Act& act) {
    using Act = Asked::Act;
    switch (act.what_case()) {
        case Act::kKill: return processes_.kill(act.kill());
        case Act::kRestart: return processes_.restart(act.restart());
        case Act::kPause: return processes_.pause(act.pause());
        case Act::kUnpause: return processes_.unpause(act.unpause());
        case Act::kCut: return network_.lose(act.cut().process(), kAll, act.cut().way());
        case Act::kLose: return lose(act.lose());
        case Act::kHeal: return act.heal() == "all" ? network_.heal_all() : network_.heal(act.heal());
        case Act::kCommand: return command(act.command());
        case Act::kOverride: {
            const auto& turn = act.override();
            return ask({.kind = CommandKind::Override,
                        .feed_percent = turn.has_feed() ? std::optional(turn.feed()) : std::nullopt,
                        .rapid_percent = turn.has_rapid() ? std::optional(turn.rapid()) : std::nullopt});
        }
        case Act::kCloseInput: return set_input(act.close_input(), true);
        case Act::kOpenInput: return set_input(act.open_input(), false);
        case Act::kPush: return push(act.push());
        case Act::WHAT_NOT_SET: break;
    }
    return std::unexpected("the act is empty");
}

Done ActExecutor::set_input(const std::string& name, bool closed) {
    const auto& inputs = session_.config().inputs;
    if (std::ranges::find(inputs, name, &InputConfig::name) == inputs.end()) {
        return std::unexpected("the machine has no input " + name + "; name an input of its file");
    }
    closed ? void(closed_.insert(name)) : void(closed_.erase(name));
    std::string text;
    for (const std::string& one : closed_) { text += one + "\n"; }
    if (const auto written = write_text_file(files_.closed_inputs, text); !written) {
        return std::unexpected(written.error());
    }
    return {};
}

Done ActExecutor::push(const Asked::Push& push) {
    pushed_mm_[push.motor()] += push.mm();
    std::string text;
    for (const auto& [motor, mm] : pushed_mm_) { text += motor + " " + number_text(mm) + "\n"; }
    if (const auto written = write_text_file(files_.pushes, text); !written) {
        return std::unexpected(written.error());
    }
    return {};
}

Done ActExecutor::lose(const Asked::Loss& loss) {
    const auto all = network_.linked();
    const auto way = loss.has_way() ? loss.way() : Asked::HEARS;
    const std::vector<std::string> named{loss.process().begin(), loss.process().end()};
    for (const std::string& process : named.empty() ? all : named) {
        if (const Done lost = network_.lose(process, loss.percent(), way); !lost) { return lost; }
    }
    return {};
}

Done ActExecutor::command(Asked::Command asked_command) {
    switch (asked_command) {
        case Asked::HOLD: return ask({.kind = CommandKind::Hold});
        case Asked::RESUME: return ask({.kind = CommandKind::Resume});
        case Asked::STOP: return ask({.kind = CommandKind::Stop});
        case Asked::RESET: return reset();
        case Asked::EMERGENCY_STOP: return stop_at_once();
        default: return std::unexpected("the command is empty");
    }
}

/// Returns once the machine is Idle.
Done ActExecutor::reset() {
    if (const Done asked = ask({.kind = CommandKind::Reset}); !asked) { return asked; }
    const auto phase = await_effect(session_, CommandKind::Reset);
    if (!phase) { return std::unexpected(phase.error()); }
    return {};
}

/// The axes receive the command directly, whether a coordinator answers or not.
Done ActExecutor::stop_at_once() {
    const auto reply = send_command(session_, {.kind = CommandKind::EmergencyStop}, nullptr, kStopPatience);
    if (!reply || reply->status == ReplyStatus::Accepted) { return {}; }
    return std::unexpected("refused: " + reply->text);
}

Done ActExecutor::ask(const Command& command) {
    const auto reply = send_command(session_, command);
    if (!reply) { return std::unexpected(failure_text(reply.error())); }
    if (reply->status == ReplyStatus::Accepted) { return {}; }
    return std::unexpected("refused: " + reply->text);
}

}  // namespace lockstep::scenario
