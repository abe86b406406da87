// The page's files, which are part of the program.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "clients/web/http/message.hpp"

namespace lockstep::web {

struct Asset {
    std::string_view path;  // "/index.html"
    std::string_view bytes;
    std::string_view type;
    std::string_view etag;      // with its quotes
    bool is_immutable = false;  // its name changes with its content
};

/// The files of the directory that was built for the page. Defined in a generated source.
std::span<const Asset> embedded_assets();

/// "/" is the page. Returns nullopt if there is no such file.
std::optional<Response> asset_response(std::span<const Asset> assets, const Request& request);

}  // namespace lockstep::web
