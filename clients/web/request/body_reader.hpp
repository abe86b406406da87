// Reads the members of a client's JSON object, and keeps the first problem. Pure.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "clients/web/request/problem.hpp"

namespace lockstep::web {

/// Parses an object; an empty text counts as {}. Fails if it is not JSON, nests more than kMostDepth deep, names a
/// member twice, or is not an object.
std::expected<Json, Problem> read_object(std::string_view text);
inline constexpr int kMostDepth = 8;

/// Refuses (415) a request with a body that is not declared as JSON.
std::optional<Problem> refuse_other_type(const Request& request);

/// The Problem of a value that is out of its range (422) or of another kind (400).
Problem wrong_value(int status, const std::string& place, const Json& value, const std::string& limit);

class BodyReader {
public:
    /// `place`: a JSON pointer to the object. `problem` keeps the first problem; several readers may share it.
    BodyReader(const Json& object, std::string place, std::optional<Problem>& problem);

    // These return nullopt if the member is absent or wrong.
    std::optional<double> number(const std::string& name, double least, double most);
    std::optional<std::int64_t> integer(const std::string& name, std::int64_t least, std::int64_t most);
    std::optional<std::string> text(const std::string& name, std::size_t longest);
    std::optional<bool> flag(const std::string& name);
    /// Returns null if the member is absent or wrong.
    const Json* list(const std::string& name, std::size_t longest);
    const Json* object(const std::string& name);

    std::string place_of(const std::string& name) const { return place_ + "/" + name; }
    void require(const std::string& name);
    void refuse(Problem problem);
    /// Refuses members that were not read.
    void finish();

private:
    const Json* find(const std::string& name);

    const Json& object_;
    std::string place_;
    std::optional<Problem>& problem_;
    std::set<std::string> known_;
};

}  // namespace lockstep::web
