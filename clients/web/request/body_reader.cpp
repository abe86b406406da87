#include "clients/web/request/body_reader.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/number_text.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kMostRepeated = 300;  // bytes of a client's text in an answer

Problem not_json(const std::string& why, const std::string& limit) {
    return {.status = 400,
            .code = "bad-json",
            .title = "the body is not valid for this request",
            .detail = why.substr(0, kMostRepeated),
            .limit = limit,
            .remedy = "send a JSON object as openapi.yaml describes it"};
}

/// Finds members that are given twice, which a parser silently accepts, and too deep nesting.
class Strict {
public:
    bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
        using Event = Json::parse_event_t;
        if (event == Event::object_start) { names_.emplace_back(); }
        if (event == Event::object_end) { names_.pop_back(); }
        if (event == Event::key && !names_.back().insert(parsed.get<std::string>()).second && why.empty()) {
            why = "the member '" + parsed.get<std::string>() + "' is given twice";
        }
        if (depth > kMostDepth && why.empty()) { why = "it is nested too deep"; }
        return true;
    }
    std::string why;

private:
    std::vector<std::set<std::string>> names_;
};

/// Refuses deep nesting before parsing: the parser itself does not recurse, but the destructor of its result does.
bool nests_too_deep(std::string_view text) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') { ++i; }
        if (c == '"') { in_string = !in_string; }
        if (in_string) { continue; }
        if (c == '{' || c == '[') { ++depth; }
        if (c == '}' || c == ']') { --depth; }
        if (depth > kMostDepth) { return true; }
    }
    return false;
}

std::string between(double least, double most) {
    return fmt::format("a number from {} to {}", number_text(least), number_text(most));
}

}  // namespace

std::expected<Json, Problem> read_object(std::string_view text) {
    if (text.empty()) { return Json::object(); }
    const std::string depth = fmt::format("at most {} objects and lists within each other", kMostDepth);
    if (nests_too_deep(text)) { return std::unexpected(not_json("it is nested too deep", depth)); }
    Strict strict;
    Json json;
    try {
        json = Json::parse(
            text, [&](int level, Json::parse_event_t event, Json& parsed) { return strict(level, event, parsed); });
    } catch (const Json::exception& error) { return std::unexpected(not_json(error.what(), "JSON in UTF-8")); }
    if (!strict.why.empty()) { return std::unexpected(not_json(strict.why, "each member once")); }
    if (!json.is_object()) {
        return std::unexpected(not_json("it is " + std::string(json.type_name()), "an object: {...}"));
    }
    return json;
}

std::optional<Problem> refuse_other_type(const Request& request) {
    const std::string* header = request.header("content-type");
    const std::string type = header == nullptr ? "" : header->substr(0, 100);
    if (request.body.empty() || type.starts_with("application/json")) { return std::nullopt; }
    return Problem{.status = 415,
                   .code = "not-json",
                   .title = "the body is not JSON",
                   .detail = "Content-Type is '" + type + "'",
                   .place = "content-type",
                   .value = type,
                   .limit = "application/json",
                   .remedy = "send JSON with this type"};
}

Problem wrong_value(int status, const std::string& place, const Json& value, const std::string& limit) {
    return {.status = status,
            .code = status == 422 ? "out-of-range" : "bad-value",
            .title = status == 422 ? "a value is out of its range" : "a value has the wrong type",
            .detail = fmt::format("{} is {}; it must be {}", place, dumped(value).substr(0, 100), limit),
            .place = place,
            .value = dumped(value).size() > 200 ? Json(dumped(value).substr(0, 200)) : value,
            .limit = limit,
            .remedy = "correct it and send it again"};
}

BodyReader::BodyReader(const Json& object, std::string place, std::optional<Problem>& problem)
    : object_(object), place_(std::move(place)), problem_(problem) {}

void BodyReader::refuse(Problem problem) {
    if (!problem_) { problem_ = std::move(problem); }
}

const Json* BodyReader::find(const std::string& name) {
    known_.insert(name);
    const auto found = object_.find(name);
    return found == object_.end() ? nullptr : &*found;
}

void BodyReader::require(const std::string& name) {
    if (find(name) != nullptr) { return; }
    refuse({.status = 400,
            .code = "missing-value",
            .title = "a value is missing",
            .detail = place_of(name) + " is missing",
            .place = place_of(name),
            .limit = "this value is required",
            .remedy = "add it and send it again"});
}

std::optional<double> BodyReader::number(const std::string& name, double least, double most) {
    const Json* found = find(name);
    if (found == nullptr) { return std::nullopt; }
    const bool is_number = found->is_number();
    const double value = is_number ? found->get<double>() : 0;
    if (is_number && value >= least && value <= most) { return value; }
    refuse(wrong_value(is_number ? 422 : 400, place_of(name), *found, between(least, most)));
    return std::nullopt;
}

std::optional<std::int64_t> BodyReader::integer(const std::string& name, std::int64_t least, std::int64_t most) {
    const auto value = number(name, static_cast<double>(least), static_cast<double>(most));
    if (!value) { return std::nullopt; }
    if (*value == std::floor(*value)) { return static_cast<std::int64_t>(*value); }
    refuse(wrong_value(400, place_of(name), *find(name), "a whole number"));
    return std::nullopt;
}

std::optional<std::string> BodyReader::text(const std::string& name, std::size_t longest) {
    const Json* found = find(name);
    if (found == nullptr) { return std::nullopt; }
    const bool is_text = found->is_string();
    if (is_text && found->get_ref<const std::string&>().size() <= longest) { return found->get<std::string>(); }
    refuse(
        wrong_value(is_text ? 422 : 400, place_of(name), *found, fmt::format("a text of at most {} bytes", longest)));
    return std::nullopt;
}

std::optional<bool> BodyReader::flag(const std::string& name) {
    const Json* found = find(name);
    if (found == nullptr) { return std::nullopt; }
    if (found->is_boolean()) { return found->get<bool>(); }
    refuse(wrong_value(400, place_of(name), *found, "true or false"));
    return std::nullopt;
}

const Json* BodyReader::list(const std::string& name, std::size_t longest) {
    const Json* found = find(name);
    if (found == nullptr || (found->is_array() && found->size() <= longest)) { return found; }
    refuse(wrong_value(found->is_array() ? 422 : 400, place_of(name), *found,
                       fmt::format("a list of at most {} members", longest)));
    return nullptr;
}

const Json* BodyReader::object(const std::string& name) {
    const Json* found = find(name);
    if (found == nullptr || found->is_object()) { return found; }
    refuse(wrong_value(400, place_of(name), *found, "an object"));
    return nullptr;
}

void BodyReader::finish() {
    for (const auto& [name, value] : object_.items()) {
        if (known_.contains(name)) { continue; }
        const std::string place = place_of(name.substr(0, kMostRepeated));
        refuse({.status = 400,
                .code = "unknown-member",
                .title = "a member is not known",
                .detail = place + " is not known",
                .place = place,
                .limit = known_.empty() ? "no members" : fmt::format("{}", fmt::join(known_, ", ")),
                .remedy = "remove it, or correct its name"});
    }
}

}  // namespace lockstep::web
