// Reads keys of a machine's file, and the devices in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/documents/machine_proto.hpp"

namespace lockstep {

/// Reads keys into the configuration; notes required keys that are missing.
class ProtoReader {
public:
    explicit ProtoReader(std::vector<Problem>& missing, std::optional<std::size_t> axis = {})
        : missing_(missing), axis_(axis) {}

    template <typename T>
    void require(bool present, const T& value, T& place, const std::string& key) {
        if (!present) { missing_.push_back({{axis_, key}, key + " is missing; it has no default"}); }
        place = value;
    }
    void refuse(const std::string& key, const std::string& why) { missing_.push_back({{axis_, key}, why}); }

private:
    std::vector<Problem>& missing_;
    std::optional<std::size_t> axis_;
};

DeviceName read_device(const std::string& text, const std::string& key, ProtoReader& reader);

/// Adds the boards, the outputs and the inputs to a draft that has its timing.
void read_devices(const proto::Machine& message, MachineDraft& draft);

}  // namespace lockstep
