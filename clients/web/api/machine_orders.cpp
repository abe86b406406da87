#include "clients/web/api/machine_orders.hpp"

#include <fmt/format.h>

#include "clients/web/program/measure_reading.hpp"
#include "clients/web/program/values_edit.hpp"

namespace lockstep::web {
namespace {

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

}  // namespace

void MachineOrders::carry_out(const Order& order, const Done& done) {
    const auto change = [&](const auto& edit) {
        port_.change_values([edit](const gcode::KeptValues& values) { return edited(edit, values); }, done);
    };
    if (const auto* command = std::get_if<Command>(&order)) {
        port_.command(*command, [this, kind = command->kind, done](Outcome&& outcome) {
            if (outcome && kind == CommandKind::Reset) { mdi_.reset(); }
            done(std::move(outcome));
        });
    }
    if (const auto* jog = std::get_if<JogOrder>(&order)) { port_.jog(*jog, done); }
    if (const auto* program = std::get_if<RunOrder>(&order)) { run(*program, done); }
    if (const auto* line = std::get_if<MdiOrder>(&order)) { run_line(*line, done); }
    if (const auto* places = std::get_if<TouchOrder>(&order)) { touch(*places, done); }
    if (const auto* what = std::get_if<MeasureOrder>(&order)) { measure(*what, done); }
    if (const auto* where = std::get_if<KeepOrder>(&order)) { keep(*where, done); }
    if (const auto* offset = std::get_if<OffsetOrder>(&order)) { change(*offset); }
    if (const auto* tool = std::get_if<ToolOrder>(&order)) { change(*tool); }
    if (const auto* lease = std::get_if<LeaseOrder>(&order)) {
        lease->takes ? port_.take_lease(done) : port_.give_lease(done);
    }
}

void MachineOrders::run(const RunOrder& order, const Done& done) {
    const auto loaded = desk_.loaded();
    if (!loaded) { return done(std::unexpected(no_program())); }
    if (order.program && *order.program != loaded->facts->id) {
        return done(std::unexpected(other_program(*order.program, loaded->facts->id)));
    }
    const bool taken = desk_.add([this, loaded, done] {
        const auto start = real_start(*port_.snapshot(), machine_);
        if (!start) { return done(std::unexpected(start.error())); }
        run_ready(ready_program(*loaded, machine_, *start), done);
    });
    if (!taken) { done(std::unexpected(too_busy())); }
}

void MachineOrders::run_ready(std::expected<ReadyProgram, Problem> ready, const Done& done) {
    if (!ready) { return done(std::unexpected(ready.error())); }
    port_.run(*std::move(ready), [this, done](Outcome&& outcome) {
        if (outcome) { mdi_.end_program(); }
        done(std::move(outcome));
    });
}

void MachineOrders::measure(const MeasureOrder& order, const Done& done) {
    const bool taken = desk_.add([this, order, done] {
        const auto start = real_start(*port_.snapshot(), machine_);
        if (!start) { return done(std::unexpected(start.error())); }
        run_ready(ready_measurement(order, machine_, *start), done);
    });
    if (!taken) { done(std::unexpected(too_busy())); }
}

void MachineOrders::keep(const KeepOrder& order, const Done& done) {
    port_.change_values([this, order, measurement = port_.snapshot()->measurement](
                            const gcode::KeptValues& values) { return kept(order, machine_, measurement, values); },
                        done);
}

void MachineOrders::run_line(const MdiOrder& order, const Done& done) {
    const auto noted = [this, line = order.line, done](Outcome&& outcome) {
        mdi_.note(line, outcome.has_value());
        if (outcome) { outcome->modes = mdi_.modes().words; }
        done(std::move(outcome));
    };
    const bool taken = desk_.add([this, line = order.line, noted] {
        const auto snapshot = port_.snapshot();
        mdi_.see(*snapshot);
        const auto start = real_start(*snapshot, machine_);
        if (!start) { return noted(std::unexpected(start.error())); }
        auto program = mdi_.read(line, *start);
        if (!program) { return noted(std::unexpected(program.error())); }
        const auto answered = [this, noted](Outcome&& outcome) {
            mdi_.answer(outcome.has_value(), outcome ? outcome->job : std::nullopt);
            noted(std::move(outcome));
        };
        if (!*program) { return answered(Accepted{}); }
        port_.run(**std::move(program), answered);
    });
    if (!taken) { done(std::unexpected(too_busy())); }
}

void MachineOrders::touch(const TouchOrder& order, const Done& done) {
    const auto start = real_start(*port_.snapshot(), machine_);
    if (!start) { return done(std::unexpected(start.error())); }
    port_.change_values([this, order, place = start->place_mm](
                            const gcode::KeptValues& values) { return edited(order, values, machine_, place); },
                        done);
}

}  // namespace lockstep::web
