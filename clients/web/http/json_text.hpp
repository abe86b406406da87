// JSON in one line. Invalid UTF-8 is replaced.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lockstep::web {

inline std::string dumped(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace lockstep::web
