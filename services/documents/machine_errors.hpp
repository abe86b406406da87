// Everything that is wrong with a machine as it was written down, each with its place in the text.
#pragma once

#include <string>

#include "services/documents/machine_proto.hpp"
#include "services/documents/text_source.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// In the order of the text. The machine is `document` itself, or a block of it: `block` is then its key with a point
/// behind it, "machine.".
Diagnostics machine_errors(const MachineDraft& draft, const TextSource& source,
                           const google::protobuf::Descriptor& document, const std::string& block = {});

}  // namespace lockstep
