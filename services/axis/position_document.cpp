#include "services/axis/position_document.hpp"

#include <google/protobuf/stubs/logging.h>

#include "idl/proto/position.pb.h"
#include "services/documents/fnv.hpp"
#include "services/documents/text/text_source.hpp"

namespace lockstep {
namespace {

std::uint64_t checksum_of(proto::KeptPosition message) {
    message.clear_checksum();
    return fnv1a(message.SerializeAsString());
}

}  // namespace

std::string position_text(const KeptPosition& kept) {
    proto::KeptPosition message;
    message.set_machine(kept.scale.machine);
    message.set_axis(kept.scale.axis);
    message.set_steps_per_mm(kept.scale.steps_per_mm);
    message.set_switch_position_mm(kept.scale.switch_position_mm);
    message.set_toward_min(kept.scale.toward_min);
    message.set_backlash_steps(kept.scale.backlash_steps);
    message.set_power_up(kept.power_up);
    message.set_run(kept.run);
    message.set_count(kept.position.count());
    message.set_phase(kept.position.phase());
    message.set_zero_count(kept.zero_count);
    message.set_encoder_zero(kept.encoder_zero);
    message.set_play_steps(kept.play_steps);
    message.set_checksum(checksum_of(message));
    std::string text;
    google::protobuf::TextFormat::PrintToString(message, &text);
    return text;
}

std::expected<KeptPosition, std::string> position_from_text(std::string_view text) {
    const google::protobuf::LogSilencer what_is_wrong_is_the_answer;
    proto::KeptPosition message;
    TextSource source;
    if (const Diagnostics errors = source.parse(text, message); !errors.empty()) {
        return std::unexpected(to_text("position", errors.front()));
    }
    if (message.checksum() != checksum_of(message)) {
        return std::unexpected(std::string("its checksum does not match its content: it is damaged or was edited"));
    }
    return KeptPosition{.scale = {message.machine(), message.axis(), message.steps_per_mm(),
                                  message.switch_position_mm(), message.toward_min(), message.backlash_steps()},
                        .power_up = message.power_up(),
                        .run = message.run(),
                        .position = Position::from_count(message.count(), message.phase()),
                        .zero_count = message.zero_count(),
                        .encoder_zero = message.encoder_zero(),
                        .play_steps = message.play_steps()};
}

}  // namespace lockstep
