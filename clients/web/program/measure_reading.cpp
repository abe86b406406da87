#include "clients/web/program/measure_reading.hpp"

#include "clients/session/measuring/measuring_stream.hpp"

namespace lockstep::web {
namespace {

Problem not_measurable(const MeasureError& error) {
    return {.status = 422,
            .code = "not-measurable",
            .title = "this cannot be measured from here",
            .detail = error.option.empty() ? error.text : error.option + " " + error.text,
            .place = error.option.empty() ? "" : "/" + error.option,
            .remedy = "correct it, or move the probe"};
}

std::shared_ptr<const ProgramFacts> facts_named(const std::string& name) {
    return std::make_shared<const ProgramFacts>(ProgramFacts{.name = name, .block_lines = {}, .notes = {}});
}

std::expected<ReadyProgram, Problem> ready_touch(const ProbeOptions& options, MeasurePlan plan,
                                                 const MachineSetup& machine, const ProgramStart& start) {
    const auto probe = chosen_probe(machine, options.probe);
    auto program = probe_program(machine, start.place_mm, options);
    if (!program) { return std::unexpected(not_measurable({{}, program.error()})); }
    plan.program.probe = probe.value();
    return ReadyProgram{.head = program->head(),
                        .values = {.revision = start.values.revision, .after = {}},
                        .feed = feed_of(std::move(program->blocks)),
                        .facts = facts_named("probe"),
                        .measures = std::make_shared<const MeasurePlan>(std::move(plan))};
}

std::expected<ReadyProgram, Problem> ready_touches(const MeasureOptions& options, MeasurePlan plan,
                                                   const MachineSetup& machine, const ProgramStart& start) {
    auto program = measuring_program(machine, start.place_mm, options);
    if (!program) { return std::unexpected(not_measurable(program.error())); }
    auto stream = std::make_shared<ProgramStream>(
        measuring_stream(machine, start.place_mm, options.kind, *program, start.values.revision));
    plan.program = *std::move(program);
    return ready_stream(std::move(stream), facts_named(title_of(options.kind)),
                        std::make_shared<const MeasurePlan>(std::move(plan)));
}

}  // namespace

std::expected<ReadyProgram, Problem> ready_measurement(const MeasureOrder& order, const MachineSetup& machine,
                                                       const ProgramStart& start) {
    MeasurePlan plan{.order = order, .program = {}, .start_mm = start.place_mm};
    if (const auto* touch = std::get_if<ProbeOptions>(&order.what)) {
        return ready_touch(*touch, std::move(plan), machine, start);
    }
    return ready_touches(std::get<MeasureOptions>(order.what), std::move(plan), machine, start);
}

}  // namespace lockstep::web
