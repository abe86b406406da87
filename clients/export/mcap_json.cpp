#include "clients/export/mcap_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace lockstep::exporting {
namespace {

const char* type_of(const Value& value) {
    constexpr const char* kTypes[] = {"number", "integer", "string"};
    return kTypes[value.index()];
}

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : printable(std::string(text))) {
        if (c == '"' || c == '\\') { out.push_back('\\'); }
        out.push_back(c);
    }
    return out + '"';
}

void append(const Value& value, std::string& out) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        out += json_text(*text);
    } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        fmt::format_to(std::back_inserter(out), "{}", *whole);
    } else {
        fmt::format_to(std::back_inserter(out), "{}", std::get<double>(value));
    }
}

bool is_representable(const Value& value) {
    const auto* number = std::get_if<double>(&value);
    return number == nullptr || std::isfinite(*number);
}

}  // namespace

std::string printable(std::string text) {
    for (char& c : text) { c = c >= ' ' && c <= '~' ? c : '?'; }
    return text;
}

std::string json_schema_of(const Sample& sample) {
    std::string properties;
    for (const auto& [name, value] : sample.signals) {
        properties += fmt::format(R"({}"{}":{{"type":"{}"}})", properties.empty() ? "" : ",", name, type_of(value));
    }
    return R"({"type":"object","properties":{)" + properties + "}}";
}

std::string json_of(const Sample& sample) {
    std::string out = "{";
    for (const auto& [name, value] : sample.signals) {
        if (!is_representable(value)) { continue; }
        fmt::format_to(std::back_inserter(out), R"({}"{}":)", out.size() == 1 ? "" : ",", name);
        append(value, out);
    }
    return out + '}';
}

}  // namespace lockstep::exporting
