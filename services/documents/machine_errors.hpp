// Everything that is wrong with a machine's configuration as written, each with its place in the text.
#pragma once

#include <string>

#include "services/documents/machine_proto.hpp"
#include "services/documents/text_source.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// In the order of the text. The machine is `document` itself, or a block of it: then `block` is its key followed by a
/// point, "machine.".
Diagnostics machine_errors(const MachineDraft& draft, const TextSource& source,
                           const google::protobuf::Descriptor& document, const std::string& block = {});

}  // namespace lockstep
