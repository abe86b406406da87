// Refuses a request whose head can be read in more than one way, so that nothing before or behind this server can
// understand another request than the one that it carries out.
#pragma once

#include <optional>

#include "clients/web/request/problem.hpp"

namespace lockstep::web {

/// Fails with 400, with the header or the part of the request line as the place; with 505 for another version of HTTP.
std::optional<Problem> refuse_head(const Request& request);

}  // namespace lockstep::web
