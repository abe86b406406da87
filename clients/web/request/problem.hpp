// Why a request is refused, as a problem of RFC 9457, with place, value, limit and remedy.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "clients/web/http/json_text.hpp"
#include "clients/web/http/message.hpp"
#include "core/faults.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep::web {

using Json = nlohmann::json;

struct Problem {
    int status = 400;
    std::string code;   // stable
    std::string title;  // a short sentence
    std::string detail;
    std::string place;  // a JSON pointer, a header or a parameter; empty if none
    std::optional<Json> value;
    std::string limit;
    std::string remedy;
    FaultCode fault = FaultCode::None;  // of a refusal by the machine
    Diagnostics errors;                 // of a program
};

/// 409, with the fault table's cause and remedy. Actions in the remedy are in braces: see openapi.yaml. `text`: the
/// coordinator's own text, with the values.
Problem refused(FaultCode fault, const std::string& text);
/// 503: no coordinator answers.
Problem unanswered(const std::string& why);

Json problem_json(const Problem& problem);
Response to_response(const Problem& problem);
Response json_response(const Json& body);

}  // namespace lockstep::web
