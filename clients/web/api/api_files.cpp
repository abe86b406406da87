// The requests for the loaded program, its path and the reports.
#include <fmt/format.h>

#include "clients/web/api/api.hpp"
#include "clients/web/request/body_reader.hpp"
#include "clients/web/state/limits.hpp"
#include "clients/web/state/state_document.hpp"
#include "core/number_text.hpp"
#include "core/parse_number.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kMostName_bytes = 200;

Problem nothing_loaded() {
    return {.status = 404,
            .code = "no-program",
            .title = "no program is loaded",
            .detail = "there is no program to show",
            .remedy = "load a program: POST /api/program"};
}

Problem desk_is_full() {
    return {.status = 409,
            .code = "busy",
            .title = "other programs are being checked",
            .detail = fmt::format("{} programs wait to be read", ProgramDesk::kMostTasks),
            .limit = std::to_string(ProgramDesk::kMostTasks),
            .remedy = "try again in a moment"};
}

bool is_no_text(const std::string* type) {
    return type != nullptr && (type->starts_with("image/") || type->starts_with("video/") ||
                               type->starts_with("audio/") || type->starts_with("multipart/"));
}

std::expected<std::size_t, Problem> most_points(const Request& request) {
    const auto found = request.query.find("points");
    if (found == request.query.end()) { return kMaxPathPoints; }
    const std::string& text = found->second;
    const auto points = parse_number<std::size_t>(text);
    if (points && *points >= 2 && *points <= kMaxPathPoints) { return *points; }
    return std::unexpected(
        wrong_value(400, "points", text.substr(0, 100), fmt::format("a whole number from 2 to {}", kMaxPathPoints)));
}

Response path_response(const LoadedProgram& program, std::size_t most) {
    const ReducedPath reduced = reduced_path(*program.path, most);
    return {.body = path_bytes(reduced.points),
            .headers = {{"Content-Type", "application/octet-stream"},
                        {"Lockstep-Program", std::to_string(program.facts->id)},
                        {"Lockstep-Points", std::to_string(reduced.points.size())},
                        {"Lockstep-All-Points", std::to_string(program.path->size())},
                        {"Lockstep-Tolerance", number_text(reduced.tolerance_mm)}}};
}

}  // namespace

void Api::load(Request&& request, const Answer& answer) {
    if (const std::string* type = request.header("content-type"); is_no_text(type)) {
        return answer(to_response({.status = 415,
                                   .code = "not-text",
                                   .title = "the body is not text",
                                   .detail = "Content-Type is '" + type->substr(0, 100) + "'",
                                   .place = "content-type",
                                   .value = type->substr(0, 100),
                                   .limit = "text/plain or application/octet-stream",
                                   .remedy = "choose the program's file"}));
    }
    const auto named = request.query.find("name");
    const std::string name = named == request.query.end() || named->second.empty() ? "program" : named->second;
    if (name.size() > kMostName_bytes) {
        return answer(to_response(wrong_value(400, "name", name.substr(0, 100), "at most 200 bytes")));
    }
    const auto text = std::make_shared<std::string>(std::move(request.body));
    const bool taken = parts_.desk.add([this, text, name, answer] {
        const ProgramStart start = checked_start(*parts_.port.snapshot(), parts_.machine);
        auto program = load_program(std::move(*text), name, parts_.desk.next_id(), parts_.machine, start);
        if (!program) { return answer(to_response(program.error())); }
        const Json facts = program_json(*program->facts);
        parts_.desk.load(*std::move(program));
        answer(json_response(facts));
    });
    if (!taken) { answer(to_response(desk_is_full())); }
}

void Api::show_program(Request&&, const Answer& answer) {
    const auto loaded = parts_.desk.loaded();
    if (!loaded) { return answer(to_response(nothing_loaded())); }
    answer({.body = loaded->text,
            .headers = {{"Content-Type", "text/plain; charset=utf-8"},
                        {"Lockstep-Program", std::to_string(loaded->facts->id)}}});
}

void Api::show_path(Request&& request, const Answer& answer) {
    const auto most = most_points(request);
    if (!most) { return answer(to_response(most.error())); }
    const auto loaded = parts_.desk.loaded();
    if (!loaded) { return answer(to_response(nothing_loaded())); }
    const bool taken = parts_.desk.add([loaded, most = *most, answer] { answer(path_response(*loaded, most)); });
    if (!taken) { answer(to_response(desk_is_full())); }
}

void Api::show_heights(Request&&, const Answer& answer) {
    const auto snapshot = parts_.port.snapshot();
    const auto& measurement = snapshot->measurement;
    if (!measurement || !measurement->result || measurement->result->measured.points().empty()) {
        Problem none = nothing_measured("the heights of a surface");
        none.status = 404;
        return answer(to_response(none));
    }
    answer({.body = csv_of(measurement->result->measured),
            .headers = {{"Content-Type", "text/csv; charset=utf-8"},
                        {"Content-Disposition", "attachment; filename=\"heights.csv\""},
                        {"Lockstep-Measurement", std::to_string(measurement->number)}}});
}

void Api::list_reports(Request&&, const Answer& answer) {
    const bool taken = parts_.desk.add([this, answer] { answer(json_response(parts_.reports.list())); });
    if (!taken) { answer(to_response(desk_is_full())); }
}

void Api::show_report(Request&& request, const Answer& answer) {
    const std::string name = request.path.substr(request.path.rfind('/') + 1);
    const bool taken = parts_.desk.add([this, name, answer] {
        auto response = parts_.reports.read(name);
        answer(response ? *std::move(response) : to_response(response.error()));
    });
    if (!taken) { answer(to_response(desk_is_full())); }
}

}  // namespace lockstep::web
