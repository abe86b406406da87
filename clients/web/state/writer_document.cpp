#include "clients/web/state/writer_document.hpp"

#include "clients/text/format.hpp"

namespace lockstep::web {

nlohmann::json writer_json(const Writer& writer) {
    return {{"name", writer.name},
            {"host", writer.host},
            {"since", utc_text(writer.since)},
            {"is_this_server", writer.is_this_server}};
}

}  // namespace lockstep::web
