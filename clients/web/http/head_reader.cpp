#include "clients/web/http/head_reader.hpp"

#include <algorithm>
#include <cstring>

#include "clients/channel/peer.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kLineEnd = 2;  // CR LF

/// libmicrohttpd 0.9.75 accepts lines that end with LF alone, and appends a folded line to the name of its header. It
/// reports neither. But names and values stay where they were received, so their places show whether they follow each
/// other as they must.
struct HeadLines {
    Request& request;
    const char* end;  // of the line before, without its CR LF

    void take(std::string_view name, std::string_view value) {
        const char* const gap = name.data() + name.size() + 1;  // behind the colon
        const bool is_in_order = name.data() == end + kLineEnd && value.data() >= gap;
        request.has_plain_lines = request.has_plain_lines && is_in_order &&
                                  std::all_of(gap, value.data(), [](char c) { return c == ' ' || c == '\t'; });
        request.add_header(name, value);
        end = value.data() + value.size();
    }
};

MHD_Result take_header(void* lines, MHD_ValueKind, const char* name, std::size_t name_size, const char* value,
                       std::size_t value_size) {
    static_cast<HeadLines*>(lines)->take({name, name_size}, {value, value_size});
    return MHD_YES;
}

MHD_Result take_argument(void* query, MHD_ValueKind, const char* name, const char* value) {
    (*static_cast<std::map<std::string, std::string>*>(query))[name] = value == nullptr ? "" : value;
    return MHD_YES;
}

}  // namespace

void read_head(MHD_Connection* connection, const char* path, const char* method, const char* version,
               Request& request) {
    request.path = path;
    request.method = method;
    request.version = version;
    const auto* peer = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    if (peer != nullptr) { request.peer = peer_address(peer->client_addr); }
    MHD_get_connection_values(connection, MHD_GET_ARGUMENT_KIND, take_argument, &request.query);
    HeadLines lines{request, version + std::strlen(version)};
    MHD_get_connection_values_n(connection, MHD_HEADER_KIND, take_header, &lines);
    const auto* size = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_REQUEST_HEADER_SIZE);
    const bool ends_well = size != nullptr && lines.end + 2 * kLineEnd == method + size->header_size;
    request.has_plain_lines = request.has_plain_lines && ends_well;
}

}  // namespace lockstep::web
