#include "services/security/expiry_watch.hpp"

#include "services/security/admission.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {

std::optional<std::string> ExpiryWatch::due(std::chrono::sys_seconds now) {
    if (now < until_ - kNearEnd) { return std::nullopt; }
    const bool has_ended = now >= until_;
    const bool is_said = said_ && (has_ended ? *said_ >= until_ : now - *said_ < std::chrono::days(1));
    if (is_said) { return std::nullopt; }
    said_ = now;
    const std::string keys =
        "the keys of " + member_ + (has_ended ? " expired on " : " expire on ") + time_text(until_);
    const std::string effect = has_ended ? ": DDS has cut this process off from the machine; "
                                         : ": DDS then cuts this process off from the machine; ";
    return keys + effect + "run lockstep keys make --force, give every host its files, then lockstep down and up";
}

}  // namespace lockstep
