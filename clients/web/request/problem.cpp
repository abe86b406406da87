#include "clients/web/request/problem.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kMostErrors = 20;

void add_text(Json& json, const char* name, const std::string& text) {
    if (!text.empty()) { json[name] = text; }
}

}  // namespace

Problem refused(FaultCode fault, const std::string& text) {
    const FaultText* known = find_fault(fault);
    const bool is_held = fault == FaultCode::WriterHeld;
    return {.status = 409,
            .code = std::string(name_of(fault)),
            .title = known == nullptr ? "the machine refuses the command" : std::string(known->cause),
            .detail = text.empty() && known != nullptr ? std::string(known->cause) : text,
            .limit = is_held ? "one writer at a time; every client may hold, stop and estop" : "",
            .remedy = known == nullptr ? "" : remedy_text(*known, words_to_fill_in),
            .fault = fault};
}

Problem unanswered(const std::string& why) {
    return {.status = 503,
            .code = "unreachable",
            .title = "no coordinator of the machine answers",
            .detail = why,
            .remedy = "check whether the machine is up: lockstep status"};
}

Json problem_json(const Problem& problem) {
    Json json{{"type", "about:blank"},
              {"title", problem.title},
              {"status", problem.status},
              {"code", problem.code},
              {"detail", problem.detail}};
    if (problem.fault != FaultCode::None) { json["number"] = static_cast<int>(problem.fault); }
    add_text(json, "place", problem.place);
    if (problem.value) { json["value"] = *problem.value; }
    add_text(json, "limit", problem.limit);
    add_text(json, "remedy", problem.remedy);
    for (const Diagnostic& error : problem.errors) {
        if (json["errors"].size() == kMostErrors) { break; }
        json["errors"].push_back({{"line", error.line}, {"column", error.column}, {"message", error.message}});
    }
    return json;
}

Response to_response(const Problem& problem) {
    return {.status = problem.status,
            .body = dumped(problem_json(problem)) + "\n",
            .headers = {{"Content-Type", "application/problem+json"}}};
}

Response json_response(const Json& body) {
    return {.body = dumped(body) + "\n", .headers = {{"Content-Type", "application/json"}}};
}

}  // namespace lockstep::web
