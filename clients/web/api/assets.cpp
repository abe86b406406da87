#include "clients/web/api/assets.hpp"

#include <algorithm>
#include <string>

namespace lockstep::web {
namespace {

constexpr std::string_view kPlainPage =
    "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Lockstep</title>\n"
    "<p>This build of lockstep-web has no page. Its interface is described in clients/web/openapi.yaml.</p>\n</html>\n";

/// Allows only the page's own files, no script or style within the page, and no frame around it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; font-src 'self'; connect-src "
    "'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

std::optional<Response> asset_response(std::span<const Asset> assets, const Request& request) {
    const std::string_view path = request.path == "/" ? std::string_view("/index.html") : request.path;
    const auto found = std::ranges::find(assets, path, &Asset::path);
    const bool is_missing = found == assets.end();
    if (is_missing && path != "/index.html") { return std::nullopt; }
    const Asset plain{path, kPlainPage, "text/html; charset=utf-8", "\"plain\""};
    const Asset& asset = is_missing ? plain : *found;
    const std::string* known = request.header("if-none-match");
    const bool is_known = known != nullptr && *known == asset.etag;
    return Response{
        .status = is_known ? 304 : 200,
        .body = is_known ? std::string_view{} : asset.bytes,
        .headers = {{"Content-Type", std::string(asset.type)},
                    {"ETag", std::string(asset.etag)},
                    {"Cache-Control", asset.is_immutable ? "public, max-age=31536000, immutable" : "no-cache"},
                    {"Content-Security-Policy", kPolicy}}};
}

}  // namespace lockstep::web
