// Reads the head of a request out of libmicrohttpd.
#pragma once

#include <microhttpd.h>

#include "clients/web/http/message.hpp"

namespace lockstep::web {

/// Sets all members of the request that its head defines, except its target. `path`, `method` and `version` are those
/// that libmicrohttpd passes to its handler.
void read_head(MHD_Connection* connection, const char* path, const char* method, const char* version, Request& request);

}  // namespace lockstep::web
