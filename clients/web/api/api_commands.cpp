// The commands, including those that run programs.
#include <fmt/format.h>

#include "clients/web/api/api.hpp"
#include "clients/web/program/values_edit.hpp"
#include "clients/web/request/body_reader.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kMaxKey_bytes = 64;

Problem replayed(const std::string& key) {
    return {.status = 409,
            .code = "replayed",
            .title = "this command was already sent",
            .detail =
                "a command with this Idempotency-Key arrived within the last ten minutes; it is not carried out again",
            .place = "idempotency-key",
            .value = key,
            .limit = "a new key for each command",
            .remedy = "read the state for the result of the first command"};
}

Problem too_busy() {
    return {.status = 429,
            .code = "too-many-commands",
            .title = "too many programs wait",
            .detail = fmt::format("{} programs wait to be read", ProgramDesk::kMostTasks),
            .limit = std::to_string(ProgramDesk::kMostTasks),
            .remedy = "wait for their answers"};
}

Problem no_program() {
    return {.status = 409,
            .code = "no-program",
            .title = "no program is loaded",
            .detail = "there is no program to run",
            .remedy = "load a program: POST /api/program"};
}

Problem other_program(std::uint64_t wanted, std::uint64_t loaded) {
    return {.status = 409,
            .code = "other-program",
            .title = "another program is loaded",
            .detail = fmt::format("program {} is loaded", loaded),
            .place = "/program",
            .value = wanted,
            .limit = std::to_string(loaded),
            .remedy = "check the loaded program, then run it"};
}

Problem closed_stream(const std::string& name) {
    return {.status = 409,
            .code = "stream-closed",
            .title = "the jog names no open event stream",
            .detail = "the event stream '" + name + "' is not open",
            .place = "/stream",
            .value = name,
            .limit = "the name that the first event of an open stream of GET /api/events gives",
            .remedy = "open an event stream and name it, or leave the name out"};
}

}  // namespace

void Api::take_command(Request&& request, const Answer& answer) {
    if (const auto other = refuse_other_type(request)) { return answer(to_response(*other)); }
    const std::string verb = request.path.substr(request.path.rfind('/') + 1);
    const auto order = read_order(verb, request.body, parts_.machine);
    if (!order) { return answer(to_response(order.error())); }
    const auto* jog = std::get_if<JogOrder>(&*order);
    if (jog != nullptr && !jog->jogs.empty() && !jog->stream.empty() && !is_open(jog->stream)) {
        return answer(to_response(closed_stream(jog->stream)));
    }
    if (const std::string* key = request.header("idempotency-key")) {
        if (key->empty() || key->size() > kMaxKey_bytes) {
            return answer(to_response(wrong_value(400, "idempotency-key", key->substr(0, 100), "1 to 64 characters")));
        }
        if (!replays_.use(*key, monotonic_now())) { return answer(to_response(replayed(*key))); }
    }
    carry_out(*order, [answer](Outcome&& outcome) {
        answer(outcome ? json_response(accepted_json(*outcome)) : to_response(outcome.error()));
    });
}

void Api::carry_out(const Order& order, const Done& done) {
    const auto change = [&](const auto& edit) {
        parts_.port.change_values([edit](const gcode::KeptValues& values) { return edited(edit, values); }, done);
    };
    if (const auto* command = std::get_if<Command>(&order)) {
        parts_.port.command(*command, [this, kind = command->kind, done](Outcome&& outcome) {
            if (outcome && kind == CommandKind::Reset) { mdi_.reset(); }
            done(std::move(outcome));
        });
    }
    if (const auto* jog = std::get_if<JogOrder>(&order)) { parts_.port.jog(*jog, done); }
    if (const auto* program = std::get_if<RunOrder>(&order)) { run(*program, done); }
    if (const auto* line = std::get_if<MdiOrder>(&order)) { run_line(*line, done); }
    if (const auto* places = std::get_if<TouchOrder>(&order)) { touch(*places, done); }
    if (const auto* offset = std::get_if<OffsetOrder>(&order)) { change(*offset); }
    if (const auto* tool = std::get_if<ToolOrder>(&order)) { change(*tool); }
    if (const auto* lease = std::get_if<LeaseOrder>(&order)) {
        lease->takes ? parts_.port.take_lease(done) : parts_.port.give_lease(done);
    }
}

void Api::run(const RunOrder& order, const Done& done) {
    const auto loaded = parts_.desk.loaded();
    if (!loaded) { return done(std::unexpected(no_program())); }
    if (order.program && *order.program != loaded->facts->id) {
        return done(std::unexpected(other_program(*order.program, loaded->facts->id)));
    }
    const bool taken = parts_.desk.add([this, loaded, done] {
        const auto start = real_start(*parts_.port.snapshot(), parts_.machine);
        if (!start) { return done(std::unexpected(start.error())); }
        auto ready = ready_program(*loaded, parts_.machine, *start);
        if (!ready) { return done(std::unexpected(ready.error())); }
        parts_.port.run(*std::move(ready), [this, done](Outcome&& outcome) {
            if (outcome) { mdi_.end_program(); }
            done(std::move(outcome));
        });
    });
    if (!taken) { done(std::unexpected(too_busy())); }
}

void Api::run_line(const MdiOrder& order, const Done& done) {
    const auto noted = [this, line = order.line, done](Outcome&& outcome) {
        mdi_.note(line, outcome.has_value());
        if (outcome) { outcome->modes = mdi_.modes().words; }
        done(std::move(outcome));
    };
    const bool taken = parts_.desk.add([this, line = order.line, noted] {
        const auto snapshot = parts_.port.snapshot();
        mdi_.see(*snapshot);
        const auto start = real_start(*snapshot, parts_.machine);
        if (!start) { return noted(std::unexpected(start.error())); }
        auto program = mdi_.read(line, *start);
        if (!program) { return noted(std::unexpected(program.error())); }
        const auto answered = [this, noted](Outcome&& outcome) {
            mdi_.answer(outcome.has_value(), outcome ? outcome->job : std::nullopt);
            noted(std::move(outcome));
        };
        if (!*program) { return answered(Accepted{}); }
        parts_.port.run(**std::move(program), answered);
    });
    if (!taken) { done(std::unexpected(too_busy())); }
}

void Api::touch(const TouchOrder& order, const Done& done) {
    const auto start = real_start(*parts_.port.snapshot(), parts_.machine);
    if (!start) { return done(std::unexpected(start.error())); }
    parts_.port.change_values(
        [this, order, place = start->place_mm](const gcode::KeptValues& values) {
            return edited(order, values, parts_.machine, place);
        },
        done);
}

}  // namespace lockstep::web
