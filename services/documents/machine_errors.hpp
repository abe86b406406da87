// Finds all errors of a machine's configuration, each with its place in the text.
#pragma once

#include <string>

#include "services/documents/machine_proto.hpp"
#include "services/documents/text/text_source.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// Returns the errors in the order of the text. The machine is `document` itself or a block of it. For a block, `block`
/// is its key followed by a point, such as "machine.".
Diagnostics machine_errors(const MachineDraft& draft, const TextSource& source,
                           const google::protobuf::Descriptor& document, const std::string& block = {});

}  // namespace lockstep
