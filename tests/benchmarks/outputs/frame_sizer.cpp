#include "tests/benchmarks/outputs/frame_sizer.hpp"

#include <dds/ddsi/ddsi_serdata.h>

#include <stdexcept>
#include <utility>

namespace lockstep {

std::expected<FrameSizer, std::string> FrameSizer::open() {
    auto participant = Participant::open({.interface = "lo"}, "benchmark");
    if (!participant) { return std::unexpected(participant.error()); }
    return FrameSizer(std::move(*participant));
}

FrameSizer::FrameSizer(Participant participant)
    : participant_(std::move(participant)),
      topic_(dds_create_topic(participant_.handle(), Topic<Frame>::kSpec.type, Topic<Frame>::kSpec.name, nullptr,
                              nullptr)),
      writer_(dds_create_writer(participant_.handle(), topic_.handle(), nullptr, nullptr)),
      reader_(dds_create_reader(participant_.handle(), topic_.handle(), nullptr, nullptr)) {}

std::size_t FrameSizer::bytes(const Frame& frame) {
    to_wire(frame, message_);
    const lockstep_wire_Setpoint* sample = &message_;
    ddsi_serdata* encoded = nullptr;
    dds_sample_info_t info;
    const bool is_there = dds_write(writer_.handle(), sample) == DDS_RETCODE_OK &&
                          dds_takecdr(reader_.handle(), &encoded, 1, &info, DDS_ANY_STATE) == 1;
    if (!is_there) { throw std::runtime_error("DDS does not deliver a frame within the process"); }
    const std::size_t size = ddsi_serdata_size(encoded);
    ddsi_serdata_unref(encoded);
    return size;
}

}  // namespace lockstep
